// The loops that bands of triangles run between, and how a branch's first loop is cut out of its parent.
#pragma once

#include "tools/treegrow/surface.h"

#include <cstdint>
#include <span>
#include <vector>

namespace copse::grow {

// A closed loop of k vertices as k + 1 columns: the last is the first again, or its twin at a seam. An open
// one (k = 2) has 2 columns.
struct Loop {
  std::vector<std::uint32_t> vertex, texcoord;
  std::size_t columns() const { return vertex.size() - 1; }  // quads in a band
};

// The quads between two loops of as many columns; columns in [skip_first, skip_first + skip_count), taken
// modulo k, are left out.
void add_band(Surface& surface, const Loop& lower, const Loop& upper, std::size_t skip_first = 0,
              std::size_t skip_count = 0);

// Triangles between two closed loops of any sizes: n + m of them.
void add_zipper(Surface& surface, const Loop& lower, const Loop& upper);

// Closes a loop by a fan round a new vertex at `middle`, or by one polygon. `outward` is the normal; the loop
// runs counter-clockwise about it unless `reversed`.
void add_fan(Surface& surface, const Loop& loop, const Double3& middle, const Double3& outward,
             bool reversed);
void add_ngon(Surface& surface, const Loop& loop, bool reversed);

// How far a ring of k vertices in the plane (side, up) round `centre` must be turned, in radians, so that its
// vertices come nearest to the loop's in order.
double best_phase(const Surface& surface, const Loop& loop, const Double3& centre, const Double3& side,
                  const Double3& up);

}  // namespace copse::grow
