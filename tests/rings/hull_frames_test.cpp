#include "lib/analysis/rings/hull_frames.h"

#include "lib/analysis/surface/surface.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <gtest/gtest.h>

namespace copse {
namespace {

double noise(double reach) {
  return 1e-6 + 1e-4 * reach;
}

// Squares along lines, as a skin modifier lays them: mitred at bends, without twist.
struct Skin {
  std::vector<Double3> positions;
  FrameGraph graph;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  std::vector<Double3> centres;  // one a node
  std::vector<double> reaches;

  std::uint32_t node(const Double3& centre, double reach) {
    centres.push_back(centre);
    reaches.push_back(reach);
    graph.corners.push_back({k_none, k_none, k_none, k_none});
    graph.is_regular.push_back(0);
    return static_cast<std::uint32_t>(centres.size() - 1);
  }
  void join(std::uint32_t a, std::uint32_t b) { pairs.emplace_back(a, b), pairs.emplace_back(b, a); }

  // The rings of a limb from a fork outward through points; the first of them are the nodes that come back.
  std::vector<std::uint32_t> limb(std::uint32_t fork, const std::vector<Double3>& points, double reach,
                                  double slope) {
    std::vector<std::uint32_t> nodes;
    Double3 in = normalized(points[0] - centres[fork]), u = normalized(cross(in, {0.3, 0.2, 1}));
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Double3 out = i + 1 < points.size() ? normalized(points[i + 1] - points[i]) : in;
      const Double3 half = normalized(in + out), a = turned(u, in, half), b = cross(half, a);
      nodes.push_back(node(points[i], reach));
      for (std::size_t k = 0; k < 4; ++k) {
        const Double3 to = (k % 2 == 0 ? a : b) * reach;
        graph.corners[nodes[i]][k] = static_cast<std::uint32_t>(positions.size());
        positions.push_back(k < 2 ? points[i] + to : points[i] - to);
      }
      graph.is_regular[nodes[i]] = 1;
      join(i == 0 ? fork : nodes[i - 1], nodes[i]);
      u = turned(u, in, out);
      in = out;
      reach *= slope;
    }
    return nodes;
  }
  static Double3 turned(const Double3& x, const Double3& from, const Double3& to) {
    const Double3 axis = cross(from, to);
    return x * dot(from, to) + cross(axis, x) + axis * (dot(axis, x) / (1 + dot(from, to)));
  }

  // The nearest corners of two rings become one, in their middle, as often as said.
  void merge(std::uint32_t a, std::uint32_t b, int times) {
    for (int i = 0; i < times; ++i) {
      std::uint32_t *x = nullptr, *y = nullptr;
      for (std::uint32_t& v : graph.corners[a]) {
        for (std::uint32_t& w : graph.corners[b]) {
          if (v != w && is_free(v) && is_free(w) && (x == nullptr || between(v, w) < between(*x, *y)))
            x = &v, y = &w;
        }
      }
      positions[*x] = (positions[*x] + positions[*y]) / 2.0;
      *y = *x;
    }
    graph.is_regular[a] = graph.is_regular[b] = 0;
  }
  bool is_free(std::uint32_t v) const {
    int uses = 0;
    for (const FrameGraph::Corners& c : graph.corners) uses += static_cast<int>(std::ranges::count(c, v));
    return uses == 1;
  }
  double between(std::uint32_t v, std::uint32_t w) const { return distance(positions[v], positions[w]); }

  std::vector<Frame> solve() {
    std::ranges::sort(pairs);
    graph.neighbours = make_lists(pairs, graph.corners.size());
    return solve_hull_frames(positions, graph, noise);
  }
  void expect_found(const std::vector<Frame>& frames, std::uint32_t fork) const {
    EXPECT_TRUE(frames[fork].is_solved);
    EXPECT_LT(distance(frames[fork].centre, centres[fork]), 1e-3);
    for (const std::uint32_t n : graph.neighbours[fork]) {
      if (frames[n].is_face) continue;
      EXPECT_LT(distance(frames[n].centre, centres[n]), 1e-4) << n;
      EXPECT_NEAR(frames[n].reach, reaches[n], 1e-4) << n;
    }
  }
};

// A fork whose limbs all bend at once where their first ring is, and two of whose rings lost two corners.
struct Bent : Skin {
  std::uint32_t fork = node({1, 2, 3}, 0);
  std::vector<std::uint32_t> below = limb(fork, {{1.1, 0.6, 3}, {1, -1, 3.2}, {1, -3, 3.2}}, 1.2, 1.02);
  std::vector<std::uint32_t> left = limb(fork, {{0.2, 3.2, 3.1}, {-1.5, 4.6, 3}, {-3, 6, 3}}, 1, 0.95);
  std::vector<std::uint32_t> right = limb(fork, {{1.9, 3.3, 2.8}, {2.6, 5, 2.2}, {3, 7, 2}}, 0.9, 0.93);
};

TEST(HullFrames, AreWhereMergedCornersAndHalvedBendsSay) {
  Bent skin;
  skin.merge(skin.left[0], skin.right[0], 2);
  skin.expect_found(skin.solve(), skin.fork);
}

TEST(HullFrames, AreFoundWhereARingMergedWithBothOthers) {
  Bent skin;
  skin.merge(skin.left[0], skin.right[0], 1);
  skin.merge(skin.left[0], skin.below[0], 1);
  skin.expect_found(skin.solve(), skin.fork);
}

TEST(HullFrames, TellForksBetweenWhichAllRingsMoved) {
  Skin skin;
  const std::uint32_t a = skin.node({0, 0, 0}, 0), b = skin.node({0.4, 3, 0}, 0);
  const auto below = skin.limb(a, {{0, -1, 0}, {0, -2.5, 0.2}, {0, -4, 0.2}}, 1, 1.1);
  const auto beside = skin.limb(a, {{1, 0.8, 0.1}, {2.5, 1.2, 0.1}, {4, 2, 0}}, 0.8, 0.9);
  const auto way = skin.limb(a, {{0.4 / 3, 1, 0}, {0.8 / 3, 2, 0}}, 0.9, 0.95);
  const auto left = skin.limb(b, {{-0.5, 4, 0}, {-1.5, 5.5, 0.4}, {-2, 7, 0.4}}, 0.7, 0.9);
  const auto right = skin.limb(b, {{1.2, 4, 0.2}, {2, 5.4, 0}, {3, 7, 0}}, 0.7, 0.9);
  skin.join(way[1], b);
  skin.merge(way[0], beside[0], 2);
  skin.merge(way[1], right[0], 1);
  skin.merge(left[0], right[0], 1);
  const std::vector<Frame> frames = skin.solve();
  skin.expect_found(frames, a);
  skin.expect_found(frames, b);
}

// A ring that was hung on a face of the hull: the face comes first, and two of the ring's corners are there
// twice.
TEST(HullFrames, LeaveOutTheFaceThatARingWasHungOn) {
  Bent skin;
  const std::uint32_t face = skin.node({}, 0);
  std::erase_if(skin.pairs, [&](const auto& p) {
    return p == std::pair(skin.fork, skin.right[0]) || p == std::pair(skin.right[0], skin.fork);
  });
  skin.join(skin.fork, face);
  skin.join(face, skin.right[0]);
  for (std::size_t k = 0; k < 4; ++k) {
    const Double3 at = skin.positions[skin.graph.corners[skin.right[0]][k]];
    skin.graph.corners[face][k] = static_cast<std::uint32_t>(skin.positions.size());
    skin.positions.push_back(k < 2 ? at : at + Double3{0.5, -0.3, 0.2});
  }
  const std::vector<Frame> frames = skin.solve();
  EXPECT_TRUE(frames[face].is_face);
  EXPECT_EQ(std::ranges::count(frames, true, &Frame::is_face), 1);
  skin.expect_found(frames, skin.fork);
}

TEST(HullFrames, AreNotClaimedWhereTheyContradictOneAnother) {
  Bent skin;
  skin.merge(skin.left[0], skin.right[0], 2);
  skin.positions[skin.graph.corners[skin.right[0]][0]] += Double3{0.1, 0.05, -0.1};
  skin.positions[skin.graph.corners[skin.right[0]][2]] += Double3{0.1, 0.05, 0.1};
  EXPECT_FALSE(skin.solve()[skin.fork].is_solved);
}

TEST(HullFrames, AreNoneWhereMostRingsAreNoSquares) {
  Bent skin;
  std::ranges::fill(skin.graph.is_regular, 0);
  for (const Frame& f : skin.solve()) EXPECT_FALSE(f.is_solved);
  EXPECT_TRUE(solve_hull_frames({}, {}, noise).empty());
}

}  // namespace
}  // namespace copse
