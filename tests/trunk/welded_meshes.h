// Welded surfaces with a known truth, for the tests of the trunk.
#pragma once

#include "lib/analysis/rings/hierarchy.h"
#include "lib/analysis/surface/surface.h"
#include "lib/analysis/surface/trunk_mesh.h"

#include <cstdint>
#include <functional>
#include <random>
#include <span>
#include <string>
#include <vector>

namespace copse {

struct TrueRing {
  Double3 centre;
  double diameter = 0;
  std::uint32_t parent = k_none;
};

struct WeldedMesh {
  TrunkMesh mesh;
  std::vector<TrueRing> rings;  // parents first
};

// A tree whose forks share vertices: at a fork three arcs of k / 2 - 1 vertices run between two vertices; the
// ring of the limb below takes two of them, those of the two limbs above one of these and the third. Quads
// are cut along random diagonals and turned by up to `twist` vertices. Limbs end in points. `sides` is even.
struct ForkTree {
  std::uint32_t sides = 6;
  int depth = 5;
  int twist = 1;
  double tip_length = 6;  // in radii of the last fork
  std::uint32_t seed = 1;
};
WeldedMesh fork_tree(const ForkTree& shape);

// A straight trunk of `rings` open rings of eight vertices; from each of the bands in `seats` a limb of four
// sides grows out of one quad: its first ring is the quad's corners. Limbs end open.
WeldedMesh seated_limbs(int rings, std::span<const int> seats, int limb_rings);

// A torus of `around` rings of `sides` vertices; a sphere of `rings` rings and two poles; a Moebius strip.
TrunkMesh torus(int around, int sides, double large, double small);
TrunkMesh sphere(int rings, int sides, double radius);
TrunkMesh moebius(int steps);

// A tube of `sides` along the points, with these radii; open, or with a vertex at each end.
TrunkMesh tube(std::span<const Double3> axis, std::span<const double> radii, int sides, bool capped);

// The surface of unit cells, in quads, smoothed `rounds` times by Catmull and Clark, then cut into triangles.
struct Cell {
  int x, y, z;
  auto operator<=>(const Cell&) const = default;
};
TrunkMesh smooth_cells(std::span<const Cell> cells, int rounds);

// Triangles between random vertices: everything that can be wrong with a mesh, at once.
TrunkMesh random_soup(std::uint32_t vertices, std::uint32_t triangles, std::uint32_t seed);
// The triangles of its first connected component.
std::vector<std::uint32_t> first_component(const TrunkMesh& mesh);

// The same surface with its triangles and vertices in another order and some triangles turned over.
TrunkMesh shuffled(const TrunkMesh& mesh, std::uint32_t seed);

Surface surface_of(const TrunkMesh& mesh);
std::vector<std::uint32_t> all_triangles(const TrunkMesh& mesh);

// Everything that any hierarchy of a surface must obey; the first breach in words, empty when there is none.
std::string breach(const Hierarchy& hierarchy, std::size_t vertices, std::size_t triangles);

// How a hierarchy compares with the truth. Rings are found by their centres, within `tolerance`.
struct Match {
  std::size_t found = 0;                        // true rings that some radius matches
  std::size_t extra = 0;                        // radii (diameter over 0) that match no true ring
  std::size_t wrong_parents = 0;                // found rings whose radius hangs on another ring's
  double worst_centre = 0, worst_diameter = 0;  // of those found; the diameter as a share
};
Match match(const Hierarchy& hierarchy, const std::vector<TrueRing>& truth, double tolerance);

}  // namespace copse
