// leaf_views: a crown from all round, as counts: which leaves cover ground that no other covers, which are
// seen, and what a change of a few leaves would do to the picture.
//
// Twelve views over one half of the sphere (the other half shows the same outlines); each pixel knows how
// many leaves cover it and which is nearest to the viewer, on either side. So one drawing answers for all
// leaves what digest 001, section 5.2, asks of one cell at a time.
#pragma once

#include "lib/analysis/measure/alpha_raster.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace copse {

struct ViewedTriangle {
  std::array<Double3, 3> corners;
  std::array<Float2, 3> texcoords{};
};

// One leaf: some triangles, of one material.
struct ViewedLeaf {
  std::span<const ViewedTriangle> triangles;
  const AlphaMask* mask = nullptr;  // null: opaque
};

class LeafViews {
 public:
  static constexpr int k_views = 12;

  // In pixels, summed over the views.
  struct Count {
    std::uint32_t total = 0;  // covered by the leaf
    std::uint32_t sole = 0;   // covered by no other leaf
    std::uint32_t seen = 0;   // in front of all others, from either side
  };
  // What a change does to the picture, in pixels, summed over the views.
  struct Change {
    // That are covered and should not be, or the other way round: below 0 where it mends what earlier changes
    // did. Each counts more where there is too little (of lost ones) or too much (of gained ones) round it
    // already, so that coverage holds everywhere, at any size on screen.
    double covered = 0;
    double other = 0;  // that show another leaf than before, half for each side
  };

  // Sees the ball. `turn` picks one of many orientations of the set of views. `pixel`: side of a pixel; the
  // pictures are kept between 16 and 512 pixels wide, whatever it says.
  LeafViews(const Double3& centre, double radius, double pixel, std::uint64_t turn);

  // What coverage is compared with from now on: what is there.
  void set_source(std::span<const ViewedLeaf> leaves);
  // Draws the leaves and keeps the drawing. A leaf is its index. Views in parallel; exact integers.
  std::vector<Count> look(std::span<const ViewedLeaf> leaves);
  // Covered pixels of the last drawing over those of the source; 1 without a source.
  double coverage() const;
  double pixel() const { return pixel_; }

  // Judges what may take the place of some leaves of the last drawing. One for each thread.
  class Exchange {
   public:
    explicit Exchange(const LeafViews& views) : views_(views) {}
    // What is taken away: leaves of the last drawing and their numbers. Cost: their pixels.
    void remove(std::span<const std::uint32_t> numbers, std::span<const ViewedLeaf> leaves);
    // `like`: the leaf that it looks like, k_none: none of those. Cost: its pixels.
    Change add(const ViewedLeaf& leaf, std::uint32_t like);

   private:
    struct Mark {
      std::uint32_t count = 0;  // leaves that are taken away, each once
      std::uint32_t last = k_none;
    };
    bool taken(std::uint32_t leaf) const;
    const LeafViews& views_;
    std::vector<std::uint32_t> numbers_;
    std::vector<std::uint8_t> taken_;  // one a leaf, as far as needed
    Change removed_;
    std::vector<Mark> marks_;
    std::vector<std::uint32_t> touched_;  // pixels with a mark
  };

 private:
  struct Pixel {
    float front = 0, back = 0;  // depth of the nearest leaf from either side
    std::uint32_t front_leaf = k_none, back_leaf = k_none, last_leaf = k_none;
    std::uint32_t count = 0;
  };
  template <class See>
  void draw(const ViewedLeaf& leaf, std::size_t view, See&& see) const;

  std::vector<OrthographicView> views_;
  double pixel_ = 1;
  std::size_t pixels_ = 0;  // of one view
  void balance();
  // What it is worth to cover a pixel: 1 where the source does, -1 where not, more where coverage is low.
  float value(std::size_t pixel) const;

  std::vector<std::uint8_t> source_;  // 1: covered; view after view
  std::vector<float> excess_;         // of coverage round a pixel, -1 to 1; one a block
  float too_much_ = 0;                // coverage of the whole crown, -1 to 1
  int blocks_ = 0;                    // of a view, along each side
  std::vector<Pixel> seen_;
};

}  // namespace copse
