#include "lib/formats/printable.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

TEST(Printable, ANameIsOneLineAndNoCommandToATerminal) {
  EXPECT_EQ(printable("oak\nbark"), "oak\\nbark");
  EXPECT_EQ(printable("\x1b[2J\r\t\x7f"), "\\x1b[2J\\x0d\\x09\\x7f");
  EXPECT_EQ(printable("a\xc2\x9b"
                      "2Jb"),
            "a\\x9b2Jb");
  EXPECT_EQ(printable(std::string_view("a\0b", 3)), "a\\x00b");
}

TEST(Printable, AllElseStays) {
  for (const char* text : {"", "oak bark", "Eiche \xc3\xa4\xc2\xa0\xe6\xa8\xb9", "\xff\xc2", "back\\slash"})
    EXPECT_EQ(printable(text), text);
}

TEST(Printable, OfSeveralLinesTheBreaksStay) {
  EXPECT_EQ(printable_lines("a\tb\nc\x1b\n"), "a\tb\nc\\x1b\n");
}

}  // namespace
}  // namespace copse
