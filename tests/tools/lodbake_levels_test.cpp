#include "tests/tools/baked_oak.h"

#include <sstream>

#include <nlohmann/json.hpp>

namespace copse {
namespace {

class LodbakeLevels : public BakedOak {
 protected:
  struct Distances {
    double near = -1, far = -1;
    std::vector<double> levels;
  };
  // Of the file that was baked with these options, which must do.
  Distances distances(const std::vector<std::string>& arguments, std::string* warnings = nullptr) const {
    const Outcome o = bake(arguments);
    EXPECT_EQ(o.status, 0) << o.err;
    if (warnings != nullptr) *warnings = o.err;
    const auto levels = nlohmann::json::parse(run_process({"treedump", out_, "--json"}).out)["levels"];
    Distances out{levels["near"], levels["far"], {}};
    for (const auto& level : levels["discrete"]) out.levels.push_back(level["distance"]);
    return out;
  }
};

// The bands of 003's hysteresis do not meet.
void expect_apart(const std::vector<double>& levels, double hysteresis) {
  for (std::size_t i = 1; i < levels.size(); ++i)
    EXPECT_GT(levels[i] * (1 - hysteresis), levels[i - 1] * (1 + hysteresis)) << i;
}

TEST_F(LodbakeLevels, WhatWasNotNamedFollowsANamedNear) {
  const Distances plain = distances({}), named = distances({"--near", "50"});
  EXPECT_EQ(named.near, 50);
  EXPECT_EQ(named.levels[0], 50);
  EXPECT_NEAR(named.levels[1] / named.levels[0], plain.levels[1] / plain.levels[0], 1e-4);
  EXPECT_EQ(named.far, named.levels[1]);
  expect_apart(distances({"--near", "1e9", "--discrete", "0.8,0.5"}).levels, 0.1);
}

TEST_F(LodbakeLevels, WhatWasNotNamedGivesWayToANamedFar) {
  const Distances plain = distances({}), near = distances({"--far", "0.5"}),
                  far = distances({"--far", "1e4"});
  EXPECT_EQ(near.far, 0.5);
  EXPECT_EQ(near.levels[1], 0.5);
  expect_apart(near.levels, 0.1);
  EXPECT_LE(near.near, near.levels[0]);
  EXPECT_EQ(far.levels[0], plain.levels[0]) << "nothing is in its way";
  EXPECT_EQ(far.levels[1], 1e4);
}

TEST_F(LodbakeLevels, LevelsBetweenTwoNamedDistancesReachFromOneToTheOther) {
  const Distances d = distances({"--near", "10", "--far", "1000", "--discrete", "0.6,0.4,0.2,0.1"});
  EXPECT_EQ(d.levels[0], 10);
  EXPECT_EQ(d.levels[3], 1000);
  expect_apart(d.levels, 0.1);
  const Distances tight = distances({"--near", "10", "--far", "20", "--discrete", "0.6,0.4,0.2,0.1"});
  expect_apart(tight.levels, 0.1);
}

TEST_F(LodbakeLevels, AWideHysteresisMovesDefaultsApartAndSaysSo) {
  std::string warnings;
  expect_apart(distances({"--hysteresis", "20"}, &warnings).levels, 0.2);
  EXPECT_NE(warnings.find("level 2 begins at"), std::string::npos) << warnings;
  expect_apart(distances({"--hysteresis", "45", "--discrete", "0.8,0.5"}, &warnings).levels, 0.45);
  expect_apart(distances({"--discrete-error", "0.05,0.06"}, &warnings).levels, 0.1);
  expect_apart(distances({"--discrete", "0.9,0.85"}, &warnings).levels, 0.1);
}

TEST_F(LodbakeLevels, OfTwoLevelsMediumAndFarAreTheBorders) {
  const Distances d = distances({"--medium", "60", "--far", "600"});
  EXPECT_EQ(d.levels, (std::vector<double>{60, 600}));
}

TEST_F(LodbakeLevels, OneLevelBeginsAtFarAndContinuousDetailAtNear) {
  const Distances d = distances({"--discrete", "0.5", "--near", "10", "--far", "100", "--continuous"});
  EXPECT_EQ(d.near, 10);
  EXPECT_EQ(d.far, 100);
  EXPECT_EQ(d.levels, std::vector<double>{100});
  EXPECT_EQ(distances({"--discrete", "0.5", "--near", "10"}).levels, std::vector<double>{10});
  EXPECT_EQ(distances({"--discrete", "0.5", "--far", "100"}).levels, std::vector<double>{100});
  EXPECT_EQ(distances({"--discrete", "0.5", "--near", "0"}).levels, std::vector<double>{0}) << "everywhere";
}

// x, y and z of every vertex as z, x and y.
std::string laid_down(const std::string& obj) {
  std::istringstream lines(obj);
  std::string out;
  for (std::string line; std::getline(lines, line); out += line + "\n") {
    if (!line.starts_with("v ")) continue;
    std::istringstream numbers(line.substr(2));
    std::string x, y, z;
    numbers >> x >> y >> z;
    line = "v " + z + " " + x + " " + y;
  }
  return out;
}

TEST_F(LodbakeLevels, ATreeThatLiesBeginsItsLevelsWhereOneThatStandsDoes) {
  const Distances standing = distances({});
  write_text(folder_.path() / "log.obj", laid_down(read_text(folder_.path() / "oak.obj")));
  ASSERT_EQ(run_process({"treeprep", folder_.file("log.obj"), "-o", tree_, "-q"}).status, 0);
  const Distances lying = distances({});
  EXPECT_NEAR(lying.near / standing.near, 1, 0.02);
  EXPECT_NEAR(lying.levels[0] / standing.levels[0], 1, 0.05);
}

}  // namespace
}  // namespace copse
