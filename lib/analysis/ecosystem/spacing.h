// Keeps instances apart: discs that never overlap, each as large as its tree asks for (a Poisson-disk pattern
// of variable radius).
//
// Discs are kept in one grid of buckets for every power of two of their radius, so that a giant among a
// million seedlings costs no more than another seedling. A query costs O(1) when no disc is placed among much
// smaller ones: place the large ones first. It never looks at more buckets than are filled.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <unordered_map>
#include <vector>

namespace copse {

struct Disc {
  double x = 0, z = 0, radius = 0;
};

// A rectangle along the axes, from (x, z) on.
struct Patch {
  double x = 0, z = 0, width = 0, depth = 0;
};

class Spacing {
 public:
  // Whether a disc here would overlap none of those inside; touching is allowed.
  bool is_free(const Disc& disc) const;
  // From (x, z) to the nearest border of a disc, negative inside of one; `most` when that is farther.
  double clearance(double x, double z, double most) const;
  // Whether a single disc is in the way of any other of `radius` whose centre is in the patch.
  bool closes(const Patch& patch, double radius) const;
  void add(const Disc& disc);
  std::size_t size() const { return count_; }

 private:
  // Whether `test` holds of any disc that one of `radius` here may overlap, and perhaps of some beyond.
  template <class Test>
  bool any_near(double x, double z, double radius, const Test& test) const;
  struct Level {
    double bucket = 1;                                             // side: the largest diameter of the level
    std::unordered_map<std::uint64_t, std::vector<Disc>> buckets;  // by key
  };
  std::map<int, Level> levels_;  // by the exponent of the radius
  std::size_t count_ = 0;
};

}  // namespace copse
