// leaf_matching: which leaves go next, and which leaf takes the place of each, wherever that changes the
// picture least.
//
// What a match costs is estimated from what is seen of both leaves (leaf_views.h): either the guest vanishes,
// and what it covered alone is lost, while the host grows and covers open ground as far as it lies in the
// open; or both give way to a leaf between them. Every leaf's best host is looked for among its neighbours
// along a space-filling curve (as in Meister and Bittner's locally-ordered clustering, 2018) and among the
// cores, the leaves that can grow with least harm, wherever they are; the cheapest matches are taken. So what
// no one sees soon bears the area of all that went.
#pragma once

#include "lib/formats/vec.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace copse {

// Areas of the picture in any one unit, such as pixels of all views.
struct MatchLeaf {
  Double3 centre;
  Double3 normal;           // length: how much its parts agree, 0 to 1
  double area = 0;          // m²
  double covered = 0;       // of the picture
  double sole = 0;          // of it what no other leaf covers
  double seen = 0;          // of it what is seen
  std::uint32_t group = 0;  // leaves of different groups count as farther apart
};

struct LeafMatch {
  std::uint32_t host;
  std::vector<std::uint32_t> guests;  // cheapest first
  bool core = false;                  // they may come from anywhere
};

struct MatchOptions {
  double largest = 0;  // m², of all leaves of a match together: what exceeds it counts as lost; 0: no limit
  double lost = 1, gained = 1, other = 0.04;  // what a pixel counts that is lost, gained, another leaf's
  int window = 8;                             // neighbours looked at on each side
  std::size_t most = 1;                       // guests, of all matches together
  std::size_t guests = 4;                     // of one host among its neighbours
  std::size_t cores = 8;  // hosts that take guests from everywhere, until they are twice as large or ...
  double core = 0.5;      // ... this share of `largest`
  double room = 0;        // m², that all cores together may take
  // The area that a leaf can grow to where it is, m²: asked of cores alone. Empty: any.
  std::function<double(std::uint32_t)> holds;
};

// The points in the order of a space-filling curve (Morton's): what is near in it is near in space.
std::vector<std::uint32_t> curve_order(std::span<const Double3> points);

// No leaf is in two matches. Of two leaves or more at least one match. Deterministic. O(n (log n + window)).
std::vector<LeafMatch> match_leaves(std::span<const MatchLeaf> leaves, const MatchOptions& options);

}  // namespace copse
