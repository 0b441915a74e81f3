// Tubes with a known truth, for the tests of the trunk: every way in which a generator may write one.
#pragma once

#include "lib/formats/mesh.h"

#include <cstdint>
#include <functional>
#include <random>
#include <span>
#include <vector>

namespace copse {

enum class TubeEnd { open, fan, lid, point };
enum class Diagonals { forward, backward, alternating, random };

struct TubeShape {
  std::vector<Double3> axis;   // ring centres
  std::vector<double> radius;  // one a ring
  int sides = 6;               // 2: a strip
  TubeEnd first = TubeEnd::open, last = TubeEnd::open;
  Diagonals diagonals = Diagonals::forward;
  bool seam = false;   // the first vertex of every ring is there twice
  bool split = false;  // every triangle has vertices of its own
  double turn = 0;     // of all rings, in sides
  std::uint32_t seed = 1;
};

class TubeMaker {
 public:
  // Appends a tube. Points at the ends lie `point_length` radii beyond the outer ring.
  void add(const TubeShape& shape, double point_length = 4);

  // Puts the triangles and the vertices in random order.
  void shuffle(std::uint32_t seed);

  Mesh mesh;
};

std::vector<std::uint8_t> all_trunk(const Mesh& mesh);

// `rings` ring centres from `from` to `to`, bent sideways by `bend`, and radii that taper linearly.
std::vector<Double3> axis_between(const Double3& from, const Double3& to, int rings, double bend = 0);
std::vector<double> taper_between(double from, double to, int rings);

}  // namespace copse
