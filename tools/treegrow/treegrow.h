// A tree of a species as a mesh with its exact hierarchy: what the tool writes and what tests compare with.
#pragma once

#include "lib/formats/mesh.h"
#include "lib/formats/result.h"
#include "tools/treegrow/breaks.h"
#include "tools/treegrow/grow.h"
#include "tools/treegrow/layout.h"
#include "tools/treegrow/skeleton.h"
#include "tools/treegrow/species.h"
#include "tools/treegrow/truth.h"

#include <cstdint>

namespace copse::grow {

inline constexpr std::uint64_t k_most_triangles = 100'000'000;  // indices stay far inside 32 bits

struct Order {
  Species species;
  std::uint64_t seed = 0;
  double height = 0;                                // m; 0: the species'
  std::uint64_t triangles = 0;                      // 0: what the species has by itself
  Breaks breaks;                                    // none: the strict model
  std::uint64_t most_nodes = k_most_nodes;          // of the skeleton
  std::uint64_t most_triangles = k_most_triangles;  // of the mesh
};

// Skeleton and layout that meet the order: their triangles are within 2 % of what was asked for.
struct Plan {
  Skeleton skeleton;
  Layout layout;
};

// Errors: limit: a number of triangles that the species cannot be made of; refused: parameters that make more
// nodes or triangles than the order allows. Cost: a few times that of growing the
// skeleton.
Result<Plan> make_plan(const Order& order);

struct Grown {
  Mesh mesh;  // without textures: art.h paints them
  Truth truth;
};

Grown make_mesh(const Order& order, const Plan& plan);

Result<Grown> grow_mesh(const Order& order);

}  // namespace copse::grow
