// Hand-made tubes with their hierarchy, for the tests of this room.
#pragma once

#include "lib/analysis/rings/hierarchy.h"
#include "lib/analysis/surface/trunk_mesh.h"
#include "lib/formats/mesh.h"

#include <cmath>
#include <numbers>

namespace copse {

struct Tube {
  Mesh mesh;
  TrunkMesh trunk;
  Hierarchy hierarchy;

  // A ring of k vertices of `radius` round `centre`; its index.
  std::uint32_t add_ring(const Double3& centre, double radius, int k, std::uint32_t parent,
                         bool joint = false) {
    const auto index = static_cast<std::uint32_t>(hierarchy.radii.size());
    for (int i = 0; i < k; ++i) {
      const double a = 2 * std::numbers::pi * i / k;
      hierarchy.ring_vertices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
      mesh.positions.push_back(centre + Double3{radius * std::cos(a), 0, radius * std::sin(a)});
    }
    hierarchy.first_vertex.push_back(static_cast<std::uint32_t>(hierarchy.ring_vertices.size()));
    hierarchy.radii.push_back({centre, 2 * radius, parent, joint});
    if (parent != k_none && !joint) add_band(parent, index, k);
    return index;
  }

  void add_triangle(const Triangle& t, std::uint32_t segment, std::uint32_t part = 0) {
    mesh.triangles.push_back(t);
    mesh.part_of.push_back(part);
    hierarchy.segment_of.push_back(segment);
  }

  void add_band(std::uint32_t parent, std::uint32_t child, int k) {
    const std::uint32_t p = hierarchy.first_vertex[parent], c = hierarchy.first_vertex[child];
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(k); ++i) {
      const std::uint32_t j = (i + 1) % static_cast<std::uint32_t>(k);
      add_triangle({p + i, c + i, p + j}, child);
      add_triangle({p + j, c + i, c + j}, child);
    }
  }

  // Call when all rings are there.
  void finish() {
    if (mesh.parts.empty()) mesh.parts.resize(1);
    trunk.positions = mesh.positions;
    trunk.triangles = mesh.triangles;
    trunk.piece.assign(mesh.triangles.size(), 0);
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) trunk.source.push_back(t);
  }
};

// A trunk of three rings; a thin branch of two rings leaves the middle one.
inline Tube forked_tube(int k = 4) {
  Tube tube;
  const std::uint32_t root = tube.add_ring({0, -1, 0}, 2, k, k_none);
  const std::uint32_t middle = tube.add_ring({0, 4, 0}, 1.5, k, root);
  tube.add_ring({0, 8, 0}, 1, k, middle);
  const std::uint32_t branch = tube.add_ring({3, 5, 0}, 0.5, k, middle);
  tube.add_ring({6, 6, 0}, 0.25, k, branch);
  tube.finish();
  return tube;
}

}  // namespace copse
