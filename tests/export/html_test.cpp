#include "lib/formats/export/html.h"

#include "lib/formats/export/html_chart.h"
#include "lib/formats/export/html_text.h"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace copse {
namespace {

constexpr const char* k_nasty = "<script src='x'>&\"\n\x01\xff</td>";

Report rich_report() {
  Report r;
  r.tool = "treeprep";
  r.version = "0.1.0";
  r.inputs = {{"oak.glb", 1000, "xxh3:1"}};
  r.outputs = {{"out/oak.stree", 250, "xxh3:2"}};
  r.options = {{"skeleton", "auto"}};
  r.seconds = 2;
  r.peak_bytes = 5'000'000;
  r.stages = {{"read", 0.5, 20000, "triangles"}, {"recover", 1.5, 10, "rings"}};
  r.errors = {{"radius-centre", 0.25, "m", 0.5, 0.375, {}, "input mesh"}};
  r.curves = {{"a", "seconds", "error", {{"one", 0.001, 1}, {"two", 1, 0.5}}},
              {"b", "seconds", "error", {{"", 0.01, 2}, {"", 0.1, 1}, {"", 10, 0.1}}},
              {"c", "frame", "ms", {{"", 0, 16}, {"", 1, 17}}}};
  r.tables = {{"Components", {"class", "count"}, {{"trunk", "12"}, {"leaf", "5"}}}};
  r.pictures = {{"Front", "the skeleton", "<svg viewBox='0 0 1 1'><path d='M0 0'/></svg>"}};
  r.warnings = {"dropped 3 faces"};
  return r;
}

// The first tag that is not closed in order; empty when all are.
std::string unbalanced(const std::string& html) {
  std::vector<std::string> open;
  for (std::size_t at = html.find('<'); at != std::string::npos; at = html.find('<', at + 1)) {
    const std::size_t end = html.find('>', at);
    if (end == std::string::npos) return "a tag never ends";
    const bool closing = html[at + 1] == '/', single = html[end - 1] == '/';
    const std::size_t begin = at + 1 + (closing ? 1 : 0);
    const std::string name = html.substr(begin, html.find_first_of(" />", begin) - begin);
    if (single || name == "meta" || name == "br" || name == "!DOCTYPE") continue;
    if (!closing) {
      open.push_back(name);
    } else if (open.empty() || open.back() != name) {
      return name + " is closed out of order";
    } else {
      open.pop_back();
    }
  }
  return open.empty() ? "" : open.back() + " stays open";
}

// The values of an attribute, in order.
std::vector<double> attributes(const std::string& svg, const std::string& name) {
  std::vector<double> values;
  const std::string start = name + "='";
  for (std::size_t at = svg.find(start); at != std::string::npos; at = svg.find(start, at + 1)) {
    values.push_back(std::stod(svg.substr(at + start.size())));
  }
  return values;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

TEST(Html, ClosesEveryTagInOrder) {
  EXPECT_EQ(unbalanced(to_html(rich_report())), "");
  EXPECT_EQ(unbalanced(to_html(Report{})), "");
}

TEST(Html, ShowsEveryPartOfAReport) {
  const std::string html = to_html(rich_report());
  for (const char* part :
       {"<title>oak.glb · treeprep</title>", "made oak.stree", "5 MB", "25 % of the input",
        "20\u202f000 triangles", "40 k", "radius-centre", "0.375", "input mesh", "dropped 3 faces",
        "Components", "the skeleton", "<code>auto</code>", "xxh3:2", "copse.report/1"}) {
    EXPECT_NE(html.find(part), std::string::npos) << part;
  }
}

TEST(Html, OnlyOneOutputThatHoldsItsInputIsAShareOfIt) {
  Report r = rich_report();
  r.outputs.front().path = "forest.eco";  // names its trees
  EXPECT_EQ(to_html(r).find(" % of the input"), std::string::npos);
  r = rich_report();
  r.outputs.push_back({"oak.png", 10, "xxh3:3"});
  EXPECT_EQ(to_html(r).find(" % of the input"), std::string::npos);
}

TEST(Html, DrawingThePageIsNoPartOfTheTimeNorOfTheRate) {
  Report r = rich_report();
  r.seconds = 4;
  r.stages.push_back({"draw", 3, 0, ""});
  const std::string html = to_html(r);
  EXPECT_NE(html.find("<dt>time</dt><dd>1 s</dd><dd>and 3 s to draw this page</dd>"), std::string::npos);
  EXPECT_NE(html.find("<dd>20 k a second</dd>"), std::string::npos);
  // Nor of the timeline: the other stages' bars and shares are those of the second of work.
  r.stages.pop_back();
  r.seconds = 1;
  const std::string undrawn = to_html(r);
  const auto bars = [](const std::string& page) { return count(page, "class=\"lane\""); };
  EXPECT_EQ(bars(html), bars(undrawn));
  const std::size_t first = undrawn.find("class=\"lane\"");
  ASSERT_NE(first, std::string::npos);
  EXPECT_NE(html.find(undrawn.substr(first, 80)), std::string::npos);
}

TEST(Html, APartThatIsEmptyHasNoHeading) {
  Report empty;
  empty.tool = "treedump";
  const std::string html = to_html(empty);
  for (const char* heading : {"Warnings", "Stages", "Errors", "Curves", "Pictures", "Options", "Files"}) {
    EXPECT_EQ(html.find(std::string(heading) + "</h2>"), std::string::npos) << heading;
  }
  EXPECT_NE(html.find("<h1>treedump</h1>"), std::string::npos);
}

TEST(Html, NeedsNothingFromOutsideAndRunsNothing) {
  const std::string html = to_html(rich_report());
  for (const char* reference :
       {"<script", "src=", "href=", "url(", "@import", "<link", "<iframe", "https:"}) {
    EXPECT_EQ(html.find(reference), std::string::npos) << reference;
  }
  EXPECT_EQ(count(html, "http:"), count(html, "http://www.w3.org/2000/svg"));  // a name, not a reference
}

TEST(Html, EscapesWhateverComesFromOutside) {
  const std::string x = k_nasty;
  Report r;
  r.tool = r.version = x;
  r.inputs = r.outputs = {{x, 1, x}};
  r.options = {{x, x}};
  r.stages = {{x, 1, 1, x}};
  r.errors = {{x, 1, x, 1, 1, 1, x}};
  r.curves = {{x, x, x, {{x, 1, 2}, {x, 3, 4}}}, {x, x + "2", x, {{"", 1, 2}, {"", 3, 4}}}};
  r.tables = {{x, {x}, {{x}}}};
  r.pictures = {{x, x, "<svg></svg>"}};
  r.warnings = {x};
  const std::string html = to_html(r);
  EXPECT_EQ(html.find("<script"), std::string::npos);
  EXPECT_EQ(html.find('\x01'), std::string::npos);
  EXPECT_EQ(html.find('\xff'), std::string::npos);
  EXPECT_EQ(unbalanced(html), "");
}

TEST(Html, CurvesOverTheSameAxesShareAChart) {
  const std::string html = to_html(rich_report());
  EXPECT_EQ(count(html, "class='chart'"), 2u);
  EXPECT_EQ(count(html, "<details>"), 2u);
}

TEST(Html, NumbersThatAreNotFiniteDoNotBreakThePage) {
  Report r = rich_report();
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  r.curves = {{"a", "x", "y", {{"", nan, 1}, {"", 1, infinity}}},
              {"b", "p", "q", {{"", 1, 1}, {"", nan, 1}, {"", 2, 1}}}};
  r.errors[0].value = nan;
  r.errors[0].max = infinity;
  r.seconds = nan;
  r.stages[0].seconds = nan;
  const std::string html = to_html(r);
  EXPECT_EQ(html.find("nan"), std::string::npos);
  EXPECT_EQ(html.find("inf"), std::string::npos);
  EXPECT_EQ(unbalanced(html), "");
  EXPECT_NE(html.find("no point of these curves is finite"), std::string::npos);
}

std::string chart_of(std::vector<CurvePoint> points) {
  const std::vector<Curve> curves{{"a", "x", "y", std::move(points)}};
  return chart_svg(curves, "c");
}

TEST(Chart, WideRangesGetALogarithmicAxis) {
  const std::string svg = chart_of({{"", 0.001, 5}, {"", 10, 6}});
  EXPECT_NE(svg.find("x (log)"), std::string::npos);
  EXPECT_EQ(svg.find("y (log)"), std::string::npos);
  // A zero has no logarithm.
  EXPECT_EQ(chart_of({{"", 0, 5}, {"", 10, 6}}).find("(log)"), std::string::npos);
}

TEST(Chart, DrawsLinesAndLabelledPointsDifferently) {
  EXPECT_NE(chart_of({{"", 1, 5}, {"", 2, 6}}).find("class='line'"), std::string::npos);
  const std::string scatter = chart_of({{"obb", 1, 5}, {"sphere", 2, 6}});
  EXPECT_EQ(scatter.find("class='line'"), std::string::npos);
  EXPECT_NE(scatter.find(">sphere</text>"), std::string::npos);
}

TEST(Chart, JoinsTheBestSoFarOfTrialsAndLabelsNoOther) {
  const std::vector<Curve> curves{
      {"obb", "s", "excess", {{"slow", 3, 1}, {"bad", 2, 9}, {"quick", 1, 5}}, true}};
  const std::string svg = chart_svg(curves, "c");
  const std::size_t at = svg.find("class='line' d='M");
  ASSERT_NE(at, std::string::npos) << svg;
  const std::string path = svg.substr(at, svg.find('>', at) - at);
  EXPECT_EQ(std::count(path.begin(), path.end(), 'L'), 1) << path;
  EXPECT_NE(svg.find(">quick</text>"), std::string::npos);
  EXPECT_EQ(svg.find(">bad</text>"), std::string::npos);
}

TEST(Chart, StaysInsideItsFrameForAnyRange) {
  const double huge = std::numeric_limits<double>::max(), tiny = std::numeric_limits<double>::denorm_min();
  const std::vector<std::vector<CurvePoint>> cases{{{"", 0, 0}},
                                                   {{"", 5, 5}, {"", 5, 5}},
                                                   {{"", -huge, huge}, {"", huge, -huge}},
                                                   {{"", tiny, tiny}, {"", huge, huge}},
                                                   {{"", 1e7, 1e7}, {"", 1e7 + 1, 1e7 + 1e-3}},
                                                   {{"", -3, -2}, {"", -1, 4}}};
  for (const auto& points : cases) {
    const std::string svg = chart_of(points);
    const std::vector<double> x = attributes(svg, "cx"), y = attributes(svg, "cy");
    EXPECT_EQ(x.size(), points.size());
    for (const double value : x) EXPECT_TRUE(value >= 0 && value <= 940) << svg;
    for (const double value : y) EXPECT_TRUE(value >= 0 && value <= 390) << svg;
    EXPECT_LT(svg.size(), 20000u);
    EXPECT_EQ(unbalanced(svg), "");
  }
}

TEST(Chart, TicksThatLieCloseTogetherStayDistinct) {
  const std::string svg = chart_of({{"", 1e6, 0}, {"", 1e6 + 4, 1}});
  EXPECT_NE(svg.find("1\u202f000\u202f001<"), std::string::npos) << svg;
  EXPECT_NE(svg.find("1\u202f000\u202f002<"), std::string::npos);
}

TEST(HtmlText, NumbersReadWell) {
  EXPECT_EQ(show_number(0), "0");
  EXPECT_EQ(show_number(-1.5), "\u22121.5");
  EXPECT_EQ(show_number(999.96), "1\u202f000");
  EXPECT_EQ(show_number(1234567), "1\u202f234\u202f567");
  EXPECT_EQ(show_number(0.00012345), "0.000123");
  EXPECT_EQ(show_number(3.2e-7), "3.2·10⁻⁷");
  EXPECT_EQ(show_number(1e-9), "10⁻⁹");
  EXPECT_EQ(show_seconds(0.0123), "12.3 ms");
  EXPECT_EQ(show_seconds(250), "4 min 10 s");
  EXPECT_EQ(show_bytes(999), "999 B");
  EXPECT_EQ(show_bytes(999999), "1 MB");
  EXPECT_EQ(show_rate(2.5e6), "2.5 M");
}

}  // namespace
}  // namespace copse
