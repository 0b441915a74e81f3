// A tree of leaves alone: square cards of two triangles at places drawn from a stream of its own.
#pragma once

#include "lib/formats/random.h"
#include "lib/formats/tree/tree.h"

#include <cmath>
#include <vector>

namespace copse {

struct LeafyTree {
  std::uint32_t leaves = 200, groups = 8;
  double half = 0.1;   // of a card's side
  double radius = 2;   // of the ball in which they are
  bool alpha = false;  // their texture has alpha
  std::uint64_t seed = 1;

  Tree make() const {
    Tree tree;
    std::vector<Float3> vertices, centres;
    std::vector<CornerTriangle> triangles;
    const Random root(seed);
    for (std::uint32_t l = 0; l < leaves; ++l) {
      Random draw = root.fork(l);
      const Double3 c = in_ball(draw), u = normalized(in_ball(draw)),
                    v = normalized(cross(u, normalized(in_ball(draw))));
      add_card(c, u * half, v * half, vertices, triangles);
      centres.push_back(to_float(c));
    }
    finish(tree, std::move(vertices), std::move(triangles), std::move(centres));
    return tree;
  }

  // One card round `c`, with texture coordinates 0..1: the first four of the tree's.
  static void add_card(const Double3& c, const Double3& u, const Double3& v, std::vector<Float3>& vertices,
                       std::vector<CornerTriangle>& triangles) {
    const auto base = static_cast<std::uint32_t>(vertices.size());
    for (const Double3& p : {c - u - v, c + u - v, c + u + v, c - u + v}) vertices.push_back(to_float(p));
    for (const auto& t : {std::array<std::uint32_t, 3>{0, 1, 2}, {0, 2, 3}}) {
      CornerTriangle corner;
      for (int i = 0; i < 3; ++i) corner.vertex[i] = base + t[i], corner.texcoord[i] = t[i];
      triangles.push_back(corner);
    }
  }

  void finish(Tree& tree, std::vector<Float3> vertices, std::vector<CornerTriangle> triangles,
              std::vector<Float3> centres) const {
    tree.header.leaf_factor = 2;
    tree.materials.resize(1);
    tree.materials[0].alpha_coverage = alpha ? 0.5f : 1;
    tree.leaves.material = 0;
    std::vector<std::uint32_t> order(centres.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    std::vector<LeafGroup> list;
    for (std::uint32_t g = 0; g < groups; ++g) {
      const auto n = static_cast<std::uint32_t>(order.size());
      const std::uint32_t first = g * n / groups, last = (g + 1) * n / groups;
      if (last > first) list.push_back({{}, 1, 0, first, last - first});
    }
    tree.leaves.vertices = std::move(vertices), tree.leaves.triangles = std::move(triangles);
    tree.leaves.centres = std::move(centres), tree.leaves.order = std::move(order);
    tree.leaves.texcoords = std::vector<Float2>{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    tree.leaves.groups = std::move(list);
  }

 private:
  Double3 in_ball(Random& draw) const {
    for (;;) {
      const Double3 p{draw.uniform(-1, 1), draw.uniform(-1, 1), draw.uniform(-1, 1)};
      if (dot(p, p) <= 1 && dot(p, p) > 1e-6) return p * radius;
    }
  }
};

}  // namespace copse
