// leaf_views: a crown from all round, as counts: which leaves cover ground that no other covers, which are
// seen, and what a change of a few leaves would do to the picture.
//
// Up to twelve views over one half of the sphere (the other half shows the same outlines); each pixel knows
// how many leaves cover it and which is nearest to the viewer, on either side. So one drawing answers for all
// leaves what digest 001, section 5.2, asks of one cell at a time.
#pragma once

#include "lib/analysis/lod/leaf_raster.h"
#include "lib/formats/levels/spectrum.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace copse {

// One leaf: some triangles, of one material.
struct ViewedLeaf {
  std::span<const SpectrumVertex> vertices;
  std::span<const std::array<std::uint32_t, 3>> triangles;  // of `vertices`
  const AlphaMask* mask = nullptr;                          // null: opaque
};

// `views` sides of the ball, or what of it is in the box unless that is empty, evenly over one half of the
// sphere; `turn` picks one of many orientations of the set. `pixel`: side of a pixel; the pictures are kept
// between `narrowest` and `widest` pixels wide, whatever it says.
std::vector<LeafEye> eyes_round(const Double3& centre, double radius, double pixel, std::uint64_t turn,
                                int views, const DoubleBox& box, int narrowest, int widest);

class LeafViews {
 public:
  static constexpr int k_most_views = 12;

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

 private:
  struct Pixel {
    // The nearest leaf from either side: its depth, in steps, above its number.
    std::uint64_t front = 0, back = ~std::uint64_t{0};
    std::uint32_t count = 0;  // of leaves
    std::uint32_t front_leaf() const { return static_cast<std::uint32_t>(front); }
    std::uint32_t back_leaf() const { return static_cast<std::uint32_t>(back); }
    // What it is worth to cover the pixel: 1 where the source does, -1 where not, more where coverage is low.
    float value = 0;
  };

 public:
  // Sees the ball, or what of it is in the box unless that is empty, from `views` sides, 1 to k_most_views.
  // `turn` picks one of many orientations of the set of views. `pixel`: side of a pixel; the pictures are
  // kept between 16 and 512 pixels wide, whatever it says.
  LeafViews(const Double3& centre, double radius, double pixel, std::uint64_t turn, int views = k_most_views,
            const DoubleBox& box = {});

  // What coverage is compared with from now on: what is there.
  void set_source(std::span<const ViewedLeaf> leaves);
  // Draws the leaves and keeps the drawing. A leaf is its index. Views in parallel; exact integers.
  std::vector<Count> look(std::span<const ViewedLeaf> leaves);
  // Covered pixels of the last drawing over those of the source; 1 without a source.
  double coverage() const {
    return source_count_ > 0 ? static_cast<double>(count_) / static_cast<double>(source_count_) : 1;
  }
  double pixel() const { return pixel_; }
  int views() const { return static_cast<int>(eyes_.size()); }

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
      std::uint16_t count = 0;  // leaves that are taken away, each once
      std::uint16_t last = 0;   // of them, from 1 on
    };
    bool taken(std::uint32_t leaf) const;
    const LeafViews& views_;
    std::vector<std::uint32_t> numbers_;
    std::vector<std::uint8_t> taken_;  // one a leaf, as far as needed
    Change removed_;
    std::vector<Mark> marks_;
    std::vector<std::uint32_t> touched_;  // pixels with a mark
  };

  // The same from some points of each leaf instead of all of its pixels, as many as it has in a view on
  // average: several times as fast. Where more than two leaves cover a pixel, none of it counts as theirs
  // alone.
  class Estimate {
   public:
    explicit Estimate(const LeafViews& views) : views_(views) {}
    void remove(std::span<const std::uint32_t> numbers, std::span<const ViewedLeaf> leaves);
    Change add(const ViewedLeaf& leaf, std::uint32_t like) const;

   private:
    bool taken(std::uint32_t leaf) const;
    // Whether nothing but what is taken away covers the pixel.
    bool alone(const Pixel& pixel) const;
    const LeafViews& views_;
    std::vector<std::uint32_t> numbers_;
    Change removed_;
  };

 private:
  std::uint64_t key(float depth, std::uint32_t leaf) const {
    const float steps = std::min(std::max(0.0f, depth * per_step_ + 0x1p30f), 0x1p31f);
    return std::uint64_t{static_cast<std::uint32_t>(steps)} << 32 | leaf;
  }
  // A triangle round the ball's centre.
  struct Local {
    std::array<Float3, 3> corners;
    std::array<Float2, 3> texcoords;
    const AlphaMask* mask;
  };
  Local local(const ViewedLeaf& leaf, std::size_t triangle) const;
  template <class See, class Wanted = leaf_raster::All>
  void draw(const Local& triangle, std::size_t view, See&& see, const Wanted& wanted = {}) const;
  // Calls see(pixel, depth, weight) for some points of the leaf in all views; a weight is in pixels.
  template <class See>
  void sample(const ViewedLeaf& leaf, See&& see) const;
  // Triangles leaf after leaf; the first one of each leaf, and one number more.
  struct Scene {
    std::vector<Local> triangles;
    std::vector<std::uint32_t> first;
  };
  Scene scene(std::span<const ViewedLeaf> leaves) const;
  void look(const Scene& scene, std::size_t view, std::vector<Count>& counts);
  void balance(std::size_t view);
  template <class T>
  std::span<T> of_view(std::vector<T>& all, std::size_t view) const {
    return std::span(all).subspan(first_[view], first_[view + 1] - first_[view]);
  }
  std::span<Pixel> pixels_of(std::size_t view) { return of_view<Pixel>(seen_, view); }

  std::vector<LeafEye> eyes_;
  Double3 centre_;
  double pixel_ = 1;
  float per_step_ = 0;                          // steps of depth a metre
  std::vector<std::size_t> first_;              // pixel of each view, and one number more
  std::vector<std::uint8_t> source_;            // 1: covered; view after view
  std::uint64_t source_count_ = 0, count_ = 0;  // covered pixels of the source, of the last drawing
  std::vector<Pixel> seen_;
};

}  // namespace copse
