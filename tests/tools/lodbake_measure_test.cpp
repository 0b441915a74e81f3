#include "tests/tools/baked_oak.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <string>

#include <nlohmann/json.hpp>

namespace copse {
namespace {

using Json = nlohmann::json;
using Row = std::map<std::string, std::string>;

class LodbakeMeasure : public BakedOak {
 protected:
  std::string report_file() const { return folder_.file("r.json"); }
  Json read_report() const { return Json::parse(read_text(report_file())); }
  // Of a run that must do.
  Json report(std::vector<std::string> arguments) const {
    arguments.insert(arguments.end(), {"--report", report_file()});
    const Outcome o = bake(arguments);
    EXPECT_EQ(o.status, 0) << o.err;
    return read_report();
  }
};

std::vector<Row> rows_of(const Json& report, const std::string& table) {
  std::vector<Row> out;
  for (const auto& t : report["tables"]) {
    if (t["name"] != table) continue;
    for (const auto& row : t["rows"]) {
      Row named;
      for (std::size_t c = 0; c < row.size(); ++c) named[t["columns"][c]] = row[c];
      out.push_back(std::move(named));
    }
  }
  return out;
}

double number(const Row& row, const std::string& column) {
  return row.contains(column) ? std::stod(row.at(column)) : std::nan("");
}

TEST_F(LodbakeMeasure, EveryLevelHasItsFigures) {
  const std::string page = folder_.file("r.html");
  const Json r =
      report({"--discrete", "0.5,0.1", "--measure", "--views", "12", "--impostor", "16", "--html", page});
  const std::vector<Row> quality = rows_of(r, "quality"), surface = rows_of(r, "surface"),
                         cost = rows_of(r, "cost");
  ASSERT_EQ(quality.size(), 3u);
  ASSERT_EQ(surface.size(), 3u);
  ASSERT_EQ(cost.size(), 3u);
  for (const char* column : {"Area", "Leaf area", "Coverage", "Coverage, least", "Coverage, most",
                             "Silhouette IoU", "IoU, least", "SSIM"})
    EXPECT_EQ(quality[0].at(column), "1.000") << column;
  EXPECT_EQ(quality[0].at("RMSE"), "0.0000");
  EXPECT_EQ(quality[0].at("Pixels"), "512");
  // The sphere round the tree, where the longest side of its box takes up 1024 sqrt(share) pixels.
  const double across = number(quality[2], "Pixels"), side = 1024 * std::sqrt(number(quality[2], "Share"));
  EXPECT_GE(across, std::floor(side));
  EXPECT_LE(across, std::ceil(side * std::sqrt(3)));
  EXPECT_EQ(surface[0].at("Level to source (m)"), "0") << "not what rounding leaves";
  EXPECT_EQ(surface[0].at("Lost branch length"), "0.000");
  for (std::size_t i = 1; i < 3; ++i) {
    EXPECT_LE(number(quality[i], "Coverage, least"), number(quality[i], "Coverage"));
    EXPECT_GE(number(quality[i], "Coverage, most"), number(quality[i], "Coverage"));
    EXPECT_LE(number(quality[i], "IoU, least"), number(quality[i], "Silhouette IoU"));
    EXPECT_GT(number(quality[i], "Leaf area"), 0);
    EXPECT_GE(number(surface[i], "Source to level, largest (m)"), number(surface[i], "Source to level (m)"));
    EXPECT_GT(number(cost[i], "Bytes"), 0);
  }
  std::map<std::string, std::size_t> curves;
  for (const auto& c : r["curves"]) curves[c["name"]] = c["points"].size();
  EXPECT_EQ(curves["where each level begins"], 3u);
  const std::string html = read_text(page);
  for (const char* text : {"data:image/png;base64", ">Full detail<", ">Impostor, from ", " triangles (",
                           "coverage 0.", "silhouette 0.", "RMSE 0."})
    EXPECT_NE(html.find(text), std::string::npos) << text;
}

TEST_F(LodbakeMeasure, LeafAreaIsThatOfTheLeavesAlone) {
  // Half of the leaves' triangles gone with nothing grown is .5, whatever the trunk has.
  const Json r = report({"--discrete", "0.3", "--measure", "--views", "12"});
  const std::vector<Row> quality = rows_of(r, "quality"), levels = rows_of(r, "levels");
  ASSERT_EQ(quality.size(), 2u);
  EXPECT_NE(quality[1].at("Area"), quality[1].at("Leaf area"));
  write_text(folder_.path() / "bare.obj", little_tree_obj(40, 12, 0));
  ASSERT_EQ(run_process({"treeprep", folder_.file("bare.obj"), "-o", tree_, "-q"}).status, 0);
  EXPECT_EQ(
      rows_of(report({"--discrete", "0.3", "--measure", "--views", "12"}), "quality")[1].at("Leaf area"),
      "-");
}

TEST_F(LodbakeMeasure, ALevelThatErrsTooMuchIsNotWrittenButTheReportSaysByHowMuch) {
  const std::string page = folder_.file("r.html");
  const Outcome o =
      bake({"--discrete", "0.1,0.02", "--max-error", "0.0001", "--report", report_file(), "--html", page});
  EXPECT_EQ(o.status, 4);
  EXPECT_EQ(line_count(o.err), 1u);
  EXPECT_NE(o.err.find("level 1 ("), std::string::npos) << o.err;
  EXPECT_NE(o.err.find("level 2 ("), std::string::npos) << "every one of them: " << o.err;
  EXPECT_FALSE(std::filesystem::exists(out_));
  const std::vector<Row> surface = rows_of(read_report(), "surface");
  ASSERT_EQ(surface.size(), 3u);
  EXPECT_NE(read_text(page).find("nothing was written"), std::string::npos);
  // The number that is compared is in the table: a hair more does.
  double worst = 0;
  for (const Row& row : surface)
    worst = std::max(
        {worst, number(row, "Level to source, largest (m)"), number(row, "Source to level, largest (m)")});
  EXPECT_EQ(bake({"--discrete", "0.1,0.02", "--max-error", std::to_string(worst * 1.001)}).status, 0);
  EXPECT_EQ(bake({"--discrete", "0.1,0.02", "--max-error", std::to_string(worst * 0.998)}).status, 4);
}

TEST_F(LodbakeMeasure, RowsOfASweepAreWhatTheToolMakesOfTheseOptions) {
  const Json swept = report({"--sweep", "--views", "12"});
  std::map<std::string, Row> at_half;
  for (Row& row : rows_of(swept, "sweep"))
    if (row["Share"] == "0.5") at_half[row["Method"]] = row;
  const std::map<std::string, std::vector<std::string>> options{
      {"copse", {}},
      {"copse, even", {"--divide", "even"}},
      {"copse, trunk by edges", {"--trunk", "edges"}},
      {"copse, leaves pruned", {"--foliage", "prune"}},
      {"copse, leaves fast", {"--quality", "fast"}}};
  for (const auto& [name, given] : options) {
    std::vector<std::string> arguments{"--discrete", "0.5", "--measure", "--views", "12"};
    arguments.insert(arguments.end(), given.begin(), given.end());
    const Row row = rows_of(report(arguments), "quality")[1];
    ASSERT_TRUE(at_half.contains(name)) << name;
    for (const char* column :
         {"Triangles", "Area", "Leaf area", "Coverage", "Silhouette IoU", "RMSE", "SSIM", "Hull growth"})
      EXPECT_EQ(at_half[name].at(column), row.at(column)) << name << ": " << column;
  }
  const Json pruned = report({"--sweep", "--views", "12", "--foliage", "prune", "--divide", "even"});
  std::map<std::string, int> names;
  for (Row& row : rows_of(pruned, "sweep")) ++names[row["Method"]];
  EXPECT_EQ(names["copse, leaves collapsed"], 5) << "what was asked for is `copse`, the other is named";
  EXPECT_EQ(names["copse, by pictures"], 5);
  EXPECT_EQ(names.count("copse, leaves pruned"), 0u);
}

// Leaves that a simplifier halves without any harm: flat squares of 4 x 4 quads, `count` of them round the
// top.
std::string flat_leaves(int count, double height) {
  std::string obj = "o leaves\nusemtl leaf\n";
  for (int l = 0; l < count; ++l) {
    const double a = 2.4 * l, x = 2 * std::cos(a), z = 2 * std::sin(a), y = height - 0.15 * l;
    for (int i = 0; i < 25; ++i)
      obj += "v " + std::to_string(x + 0.2 * (i % 5)) + " " + std::to_string(y + 0.2 * (i / 5)) + " " +
             std::to_string(z) + "\n";
    for (int i = 0; i < 16; ++i) {
      const int corner = i / 4 * 5 + i % 4 - 25;
      const auto v = [&](int more) { return std::to_string(corner + more) + "/" + std::to_string(1) + " "; };
      obj += "f " + v(0) + v(1) + v(6) + "\nf " + v(0) + v(6) + v(5) + "\n";
    }
  }
  return obj;
}

TEST_F(LodbakeMeasure, ASweepComparesAllMethodsAtTheSameCountsAndPeersKeepTheirMaterials) {
  write_text(folder_.path() / "none.mtl", "newmtl bark\nKd 0 0 0\nnewmtl leaf\nKd 0 0.9 0\n");
  write_text(folder_.path() / "flat.obj", little_tree_obj(8, 6, 0, flat_leaves(20, 5)));
  ASSERT_EQ(run_process({"treeprep", folder_.file("flat.obj"), "-o", tree_, "-q"}).status, 0);
  const auto json = report({"--sweep", "--views", "12", "--divide", "even"});
  const double full = 8 * 2 * 5 + 20 * 32;
  std::map<std::string, int> ours;
  for (const auto& table : json["tables"]) {
    if (table["name"] != "sweep" && table["name"] != "last geometric level") continue;
    const auto column = [&](const char* name) {
      return std::find(table["columns"].begin(), table["columns"].end(), name) - table["columns"].begin();
    };
    for (const auto& row : table["rows"]) {
      const std::string method = row[column("Method")];
      const auto number = [&](const char* name) { return std::stod(row[column(name)].get<std::string>()); };
      const double target = table["name"] == "sweep" ? std::floor(number("Share") * full) : 200;
      if (method == "copse") {
        ++ours[table["name"]];
        EXPECT_LE(number("Triangles"), target);
        EXPECT_NEAR(number("Leaf area"), 1, 0.06);
      }
      if (method.starts_with("meshoptimizer") && number("Share") == 0.5) {
        EXPECT_LE(number("Triangles"), target);
        EXPECT_GT(number("Leaf area"), 0.9);
        // Painted with another material, whatever is left of leaves or trunk would be wrong all over.
        EXPECT_LT(number("RMSE"), 0.03) << method;
      }
    }
  }
  EXPECT_EQ(ours["sweep"], 5);
  EXPECT_EQ(ours["last geometric level"], 1);
}

}  // namespace
}  // namespace copse
