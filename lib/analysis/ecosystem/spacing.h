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
  // Whether a single disc is in the way of any other of `radius` whose centre is in the patch. If not, those
  // that are in the way of some of them are added to `near`; of more than `most` one more than that.
  bool closes(const Patch& patch, double radius, std::size_t most, std::vector<Disc>& near) const;
  void add(const Disc& disc);
  std::size_t size() const { return count_; }

 private:
  // Whether `test` holds of any disc that one of `radius` here may overlap, and perhaps of some beyond.
  template <class Test>
  bool any_near(double x, double z, double radius, const Test& test) const;

  // A chain of discs for every bucket that has any, in a table with open addressing.
  class Level {
   public:
    explicit Level(double bucket_side) : side(bucket_side) {}
    const double side;  // of a bucket: the largest diameter of the level
    std::size_t buckets() const { return filled_; }
    void add(const Disc& disc, std::uint64_t key);
    template <class Test>
    bool any_in(std::uint64_t key, const Test& test) const;
    template <class Test>
    bool any(const Test& test) const;

   private:
    struct Slot {
      std::uint64_t key = 0;
      std::uint32_t first = k_end;  // of its chain; k_end: the slot is empty
    };
    struct Link {
      Disc disc;
      std::uint32_t next = k_end;
    };
    static constexpr std::uint32_t k_end = ~std::uint32_t{0};
    std::size_t slot_of(std::uint64_t key) const;
    void grow();
    std::vector<Slot> slots_ = std::vector<Slot>(16);  // a power of two, half empty
    std::vector<Link> links_;
    std::size_t filled_ = 0;
  };
  std::map<int, Level> levels_;  // by the exponent of the radius
  std::size_t count_ = 0;
};

}  // namespace copse
