#include "lib/analysis/volumes/check_certificates.h"

#include "lib/analysis/round/minimal_sphere.h"
#include "lib/analysis/tree/tree_parts.h"
#include "tests/formats/tree_maker.h"

#include <numeric>

#include <gtest/gtest.h>

namespace copse {
namespace {

struct Stored {
  std::vector<VolumeSet> sets;
  std::vector<VolumeRecord> records;
  std::vector<float> numbers;
  std::vector<VolumeNode> nodes;

  void ball(VolumePart part, std::uint32_t index, const std::vector<Double3>& points) {
    const StoredSphere s = stored_minimal_sphere(points);
    sets.push_back(
        {.part = part, .index = index, .first = static_cast<std::uint32_t>(records.size()), .count = 1});
    VolumeRecord r{.kind = VolumeKind::sphere,
                   .flags = VolumeRecord::certified,
                   .first = static_cast<std::uint32_t>(numbers.size()),
                   .count = 4};
    r.method = {'m'};
    records.push_back(r);
    numbers.insert(numbers.end(), {s.centre.x, s.centre.y, s.centre.z, s.radius});
  }
  TreeVolumes volumes() const { return {sets, records, numbers, nodes}; }
};

std::vector<Double3> points_of(TreeParts& parts, VolumePart part, std::uint32_t index) {
  std::vector<Double3> out;
  for (const std::uint32_t p : parts.part(part, index).points) out.push_back(parts.points()[p]);
  return out;
}

// A ball round the whole, each group, and a node above all groups.
Stored stored_for(const Tree& tree) {
  TreeParts parts(tree);
  Stored s;
  s.ball(VolumePart::whole, k_none, parts.points());
  std::vector<Double3> all;
  const std::uint32_t groups = parts.count(VolumePart::group);
  for (std::uint32_t g = 0; g < groups; ++g) {
    const auto points = points_of(parts, VolumePart::group, g);
    s.ball(VolumePart::group, g, points);
    all.insert(all.end(), points.begin(), points.end());
  }
  s.ball(VolumePart::node, 0, all);
  s.nodes.push_back({groups + 1, k_none, groups + 1});
  for (std::uint32_t g = 0; g < groups; ++g) s.nodes.push_back({g + 2, g, g + 1});
  return s;
}

TEST(CheckCertificates, ANodeHoldsTheSetsOfTheBottomBelowIt) {
  //                                    0: root      1: bottom   2: inner     3: bottom    4: bottom
  const std::vector<VolumeNode> nodes{{.skip = 5, .set = 10},
                                      {.skip = 2, .set = 11},
                                      {.skip = 5, .set = 12},
                                      {.skip = 4, .set = 13},
                                      {.skip = 5, .set = 14}};
  using Sets = std::vector<std::uint32_t>;
  EXPECT_EQ(sets_below(nodes, 0), (Sets{11, 13, 14}));
  EXPECT_EQ(sets_below(nodes, 2), (Sets{13, 14}));
  EXPECT_EQ(sets_below(nodes, 3), (Sets{13}));
}

TEST(CheckCertificates, VolumesThatHoldTheirVerticesPass) {
  const Tree tree = make_tree({.leaves = 20, .groups = 5}, 1);
  const auto failures = check_certificates(tree, stored_for(tree).volumes());
  EXPECT_TRUE(failures.empty()) << failures.front();
}

TEST(CheckCertificates, ARadiusThatIsALittleTooSmallIsFoundInEverySet) {
  const Tree tree = make_tree({.leaves = 20, .groups = 5}, 1);
  for (std::size_t i = 0; i < 7; ++i) {
    Stored s = stored_for(tree);
    s.numbers[4 * i + 3] = s.numbers[4 * i + 3] * 0.9999f;
    const auto failures = check_certificates(tree, s.volumes());
    ASSERT_EQ(failures.size(), 1u) << i;
    EXPECT_EQ(failures[0].find("VOLU[" + std::to_string(i) + "]: sphere (m) of "), 0u) << failures[0];
    s.records[i].flags = 0;  // what is not called certified is not judged
    EXPECT_TRUE(check_certificates(tree, s.volumes()).empty());
  }
}

TEST(CheckCertificates, AnEnvelopeMustHoldWhatSwaysByItsAngle) {
  const Tree tree = make_tree({.radii = 20, .leaves = 20, .groups = 5}, 1);
  Stored s = stored_for(tree);  // balls round what is at rest
  s.sets[2].motion = VolumeMotion::envelope, s.sets[2].sway = 10;
  s.sets.back().motion = VolumeMotion::envelope, s.sets.back().sway = 10;  // of the node
  const auto failures = check_certificates(tree, s.volumes());
  ASSERT_EQ(failures.size(), 2u);
  EXPECT_NE(failures[0].find("of group 1 envelope leaves"), std::string::npos) << failures[0];
  EXPECT_NE(failures[1].find("of node 0 envelope leaves"), std::string::npos) << failures[1];
  for (const std::size_t i : {2u, 6u}) s.numbers[4 * i + 3] = 1e6f;  // wide enough for any sway
  EXPECT_TRUE(check_certificates(tree, s.volumes()).empty());
}

TEST(CheckCertificates, AnEnvelopeOfUnknownMotionMustHoldWhatIsAtRest) {
  const Tree tree = make_tree({}, 1);
  Stored s = stored_for(tree);
  s.sets[0].motion = VolumeMotion::envelope;
  EXPECT_TRUE(check_certificates(tree, s.volumes()).empty());
  s.numbers[3] = 0;
  EXPECT_EQ(check_certificates(tree, s.volumes()).size(), 1u);
}

TEST(CheckCertificates, CellsAreJudgedByTheirLeaves) {
  const Tree tree = make_tree({.leaves = 20, .groups = 5}, 1);
  FoliageCells cells;
  std::vector<FoliageCell> cut(2);
  cut[0].count = 8, cut[1].first = 8, cut[1].count = 12;
  std::vector<std::uint32_t> order(20);
  std::iota(order.rbegin(), order.rend(), 0u);
  cells.cells = cut, cells.order = order;
  TreeParts parts(tree, &cells);
  Stored s;
  for (const std::uint32_t c : {0u, 1u}) s.ball(VolumePart::cell, c, points_of(parts, VolumePart::cell, c));
  EXPECT_TRUE(check_certificates(tree, s.volumes(), cells).empty());
  std::swap(s.sets[0].index, s.sets[1].index);
  EXPECT_FALSE(check_certificates(tree, s.volumes(), cells).empty());
  EXPECT_EQ(check_certificates(tree, s.volumes()).at(0), "VSET[0]: the tree has no cell 1");
}

}  // namespace
}  // namespace copse
