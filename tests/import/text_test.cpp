#include "lib/formats/import/text.h"

#include "lib/formats/import/lines.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace copse {
namespace {

Scan scan(const std::string& text, double& value) {
  const char* p = text.data();
  return scan_double(p, text.data() + text.size(), value);
}

std::vector<std::string> lines_of(std::string_view text, bool joined) {
  std::vector<std::string> out;
  Lines lines(text, joined);
  for (std::string_view line; lines.next(line);)
    out.push_back(std::to_string(lines.number()) + ":" + std::string(line));
  return out;
}

TEST(Text, NumbersAreReadAsCWritesThem) {
  double v = 0;
  EXPECT_EQ(scan("1.5", v), Scan::good);
  EXPECT_EQ(v, 1.5);
  EXPECT_EQ(scan("  +2e-3 tail", v), Scan::good);
  EXPECT_EQ(v, 0.002);
  EXPECT_EQ(scan("-.5E+1", v), Scan::good);
  EXPECT_EQ(v, -5);
  EXPECT_EQ(scan("7.", v), Scan::good);
  EXPECT_EQ(v, 7);
  EXPECT_EQ(scan("0.1", v), Scan::good);
  EXPECT_EQ(v, 0.1);
  EXPECT_EQ(scan("4.9e-324", v), Scan::good);
  EXPECT_EQ(v, 4.9e-324);
}

TEST(Text, WhatIsNoNumberIsBad) {
  double v = 0;
  for (const char* text : {"x", "1x", "1,5", "--1", "+-1", "0x10", ".", "1.2.3", "1e"})
    EXPECT_EQ(scan(text, v), Scan::bad) << text;
  EXPECT_EQ(scan("   ", v), Scan::none);
}

TEST(Text, InfinitiesAndNanAreToldApartFromGarbage) {
  double v = 0;
  for (const char* text :
       {"nan", "-NaN", "inf", "-inf", "+Infinity", "1e999", "-1e400", "1.#QNAN", "-1.#IND", "1.#INF"})
    EXPECT_EQ(scan(text, v), Scan::not_finite) << text;
}

TEST(Text, NumbersTooSmallForADoubleAreZero) {
  double v = 1;
  for (const std::string& text : {std::string("1e-999"), "-0." + std::string(400, '0') + "1",
                                  std::string("12e-99999999999999999999")}) {
    v = 1;
    EXPECT_EQ(scan(text, v), Scan::good) << text;
    EXPECT_EQ(v, 0) << text;
  }
  EXPECT_EQ(scan("1" + std::string(400, '0'), v), Scan::not_finite);
  EXPECT_EQ(scan("1e99999999999999999999", v), Scan::not_finite);
}

TEST(Text, LinesEndInLfCrLfOrCr) {
  EXPECT_EQ(lines_of("a\nb", false), (std::vector<std::string>{"1:a", "2:b"}));
  EXPECT_EQ(lines_of("a\r\n\r\nb\r\n", false), (std::vector<std::string>{"1:a", "2:", "3:b"}));
  EXPECT_EQ(lines_of("a\rb\r", false), (std::vector<std::string>{"1:a", "2:b"}));
  EXPECT_EQ(lines_of("\xef\xbb\xbfv", false), (std::vector<std::string>{"1:v"}));
}

TEST(Text, ABackslashJoinsLinesAndKeepsTheirNumbers) {
  EXPECT_EQ(lines_of("a\\\nb\\\r\nc\nd", true), (std::vector<std::string>{"1:a b c", "4:d"}));
  EXPECT_EQ(lines_of("a\\", true), (std::vector<std::string>{"1:a "}));
  EXPECT_EQ(lines_of("# path\\\nv", true), (std::vector<std::string>{"1:# path\\", "2:v"}))
      << "comments do not join";
  EXPECT_EQ(lines_of("a\\\nb", false), (std::vector<std::string>{"1:a\\", "2:b"}));
}

TEST(Text, NamesThatAreNotUtf8AreTakenAsLatin1) {
  EXPECT_EQ(to_utf8("birk\xc3\xa9"), "birk\xc3\xa9");
  EXPECT_EQ(to_utf8("birk\xe9"), "birk\xc3\xa9");
  EXPECT_EQ(to_utf8("\xf0\x9f\x8c\xb3"), "\xf0\x9f\x8c\xb3");
  EXPECT_EQ(to_utf8("\xc0\x80"), "\xc3\x80\xc2\x80") << "overlong";
  EXPECT_EQ(to_utf8("\xed\xa0\x80"), "\xc3\xad\xc2\xa0\xc2\x80") << "a surrogate";
}

TEST(Text, QuotesStayShortAndPrintable) {
  EXPECT_EQ(in_quotes("a\nb"), "'a?b'");
  EXPECT_EQ(in_quotes(std::string(50, 'x')), "'" + std::string(40, 'x') + "...'");
}

}  // namespace
}  // namespace copse
