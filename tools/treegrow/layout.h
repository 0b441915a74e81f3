// Which rings a skeleton gets, and what that costs: everything about the mesh that can be counted before a
// vertex is made. The triangle budget is met by trying layouts.
#pragma once

#include "tools/treegrow/breaks.h"
#include "tools/treegrow/skeleton.h"
#include "tools/treegrow/species.h"

#include <cstdint>
#include <span>
#include <vector>

namespace copse::grow {

// Factors on what the species says.
struct Detail {
  double sides = 1;     // ring vertices
  double segments = 1;  // segments a stem
  double leaves = 1;    // leaves of the whole tree
};

struct StemLayout {
  std::uint32_t first = 0;  // its rings are Layout::rings[first .. first + count)
  std::uint32_t count = 0;  // at least 2
  std::uint32_t k = 0;
  std::uint32_t join = 0;  // number, among the parent's rings, of the ring it hangs on; unused by free tubes
  std::uint32_t leaves = 0;  // that it bears
};

struct Layout {
  std::vector<double> rings;  // parameters, ascending within a stem
  std::vector<StemLayout> stems;
  std::uint64_t leaves = 0;
  double leaf_scale = 1;  // on the leaves' size, so that few leaves still make a crown
  std::uint64_t trunk_triangles = 0;
  std::uint64_t leaf_triangles = 0;

  std::span<const double> rings_of(std::size_t stem) const {
    return std::span(rings).subspan(stems[stem].first, stems[stem].count);
  }
};

// How a leaf is made; one a leaf break.
struct LeafForm {
  Break kind;               // free_tubes stands for the strict model's single triangle
  std::uint32_t triangles;  // of one leaf
  std::uint32_t components;
  double count;          // factor on the number of leaves
  double length, width;  // factors on their size
};
LeafForm leaf_form(const Breaks& breaks);

// The triangles of a closed or open (k = 2) band between two rings.
constexpr std::uint64_t band_triangles(std::uint32_t k) {
  return k == 2 ? 2 : 2u * k;
}

// `leaves`: the exact number wanted; negative: what the species and the detail give. A layout that will have
// more than `most_triangles` is left unfinished as soon as that is certain; its count says so.
Layout lay_out(const Species& species, const Skeleton& skeleton, const Breaks& breaks, const Detail& detail,
               std::int64_t leaves = -1, std::uint64_t most_triangles = 100'000'000);

// Both parts, with what --break adds to the faces (duplicates, degenerate triangles).
std::uint64_t total_triangles(const Layout& layout, const Breaks& breaks);

}  // namespace copse::grow
