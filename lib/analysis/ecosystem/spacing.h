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

class Spacing {
 public:
  // Whether a disc here would overlap none of those inside; touching is allowed.
  bool is_free(const Disc& disc) const;
  void add(const Disc& disc);
  std::size_t size() const { return count_; }

 private:
  struct Level {
    double bucket = 1;                                             // side: the largest diameter of the level
    std::unordered_map<std::uint64_t, std::vector<Disc>> buckets;  // by key
  };
  std::map<int, Level> levels_;  // by the exponent of the radius
  std::size_t count_ = 0;
};

}  // namespace copse
