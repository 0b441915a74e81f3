#include "lib/analysis/lod/leaf_occlusion.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <utility>

#include <tbb/parallel_for.h>

namespace copse {
namespace {

constexpr int k_narrowest = 16, k_least = 2, k_widest = 1024;  // pixels of a picture
constexpr double k_most_samples = 1 << 24;                     // of leaves that are all as large as the crown
constexpr std::uint64_t k_turn = 77, k_control_turn = 78;
// Views that have no say in what goes but in when to stop: leaves are chosen for what the others happen not
// to see.
constexpr int k_control_views = 2;

double area_of(const ViewedLeaf& leaf) {
  double sum = 0;
  for (const auto& t : leaf.triangles) {
    const Double3 a = to_double(leaf.vertices[t[0]].position);
    const Double3 n =
        cross(to_double(leaf.vertices[t[1]].position) - a, to_double(leaf.vertices[t[2]].position) - a);
    sum += 0.5 * std::sqrt(dot(n, n));
  }
  return sum;
}

// One picture: of each pixel the leaves that cover it, the nearest first.
class Layers {
 public:
  void draw(std::span<const ViewedLeaf> leaves, const Double3& centre, const LeafEye& eye) {
    std::vector<float> depth;
    const std::size_t pixels = std::size_t(eye.width) * std::size_t(eye.height);
    std::vector<std::uint32_t> last;  // leaf of more than two triangles, which may cover a pixel twice
    first_of_leaf_.reserve(leaves.size() + 1);
    for (std::uint32_t l = 0; l < leaves.size(); ++l) {
      first_of_leaf_.push_back(std::uint32_t(pixel_.size()));
      const ViewedLeaf& leaf = leaves[l];
      const bool folded = leaf.triangles.size() > 2;
      if (folded && last.empty()) last.assign(pixels, 0);
      for (const auto& t : leaf.triangles) {
        std::array<Float3, 3> corners;
        std::array<Float2, 3> texcoords;
        for (int c = 0; c < 3; ++c) {
          const SpectrumVertex& v = leaf.vertices[t[c]];
          corners[c] = eye.project(to_float(to_double(v.position) - centre)), texcoords[c] = v.texcoord;
        }
        for_each_leaf_pixel(corners, texcoords, leaf.mask, eye.width, eye.height,
                            [&](std::size_t p, float d) {
                              if (folded && std::exchange(last[p], l + 1) == l + 1) return;
                              pixel_.push_back(std::uint32_t(p)), depth.push_back(d);
                            });
      }
    }
    first_of_leaf_.push_back(std::uint32_t(pixel_.size()));
    sort(pixels, depth);
  }

  // fn(leaf) for the leaf in front, for the one at the back, and for what covers a pixel alone.
  template <class Front, class Alone>
  void each_pixel(Front&& front, Alone&& alone) const {
    for (std::size_t p = 0; p < left_.size(); ++p) {
      if (left_[p] == 0) continue;
      front(leaf_[front_[p]]), front(leaf_[back_[p]]);
      if (left_[p] == 1) alone(leaf_[front_[p]]);
    }
  }
  std::uint32_t pixels_of(std::uint32_t leaf) const {
    return first_of_leaf_[leaf + 1] - first_of_leaf_[leaf];
  }

  // The leaf, which is no longer alive, goes: the same of what is in front, at the back and alone from now
  // on.
  template <class Front, class Alone>
  std::uint32_t remove(std::uint32_t leaf, const std::vector<std::uint8_t>& alive, Front&& front,
                       Alone&& alone) {
    std::uint32_t lost = 0;
    for (std::uint32_t i = first_of_leaf_[leaf]; i < first_of_leaf_[leaf + 1]; ++i) {
      const std::uint32_t p = pixel_[i];
      if (--left_[p] == 0) {
        ++lost;
        continue;
      }
      if (alive[leaf_[front_[p]]] == 0) {
        while (alive[leaf_[front_[p]]] == 0) ++front_[p];
        front(leaf_[front_[p]]);
      }
      if (alive[leaf_[back_[p]]] == 0) {
        while (alive[leaf_[back_[p]]] == 0) --back_[p];
        front(leaf_[back_[p]]);
      }
      if (left_[p] == 1) alone(leaf_[front_[p]]);
    }
    return lost;
  }

 private:
  void sort(std::size_t pixels, const std::vector<float>& depth) {
    std::vector<std::uint32_t> first(pixels + 1, 0);
    for (const std::uint32_t p : pixel_) ++first[p + 1];
    left_.assign(first.begin() + 1, first.end());
    for (std::size_t p = 0; p < pixels; ++p) first[p + 1] += first[p];
    std::vector<std::pair<float, std::uint32_t>> at(pixel_.size());
    front_.assign(first.begin(), first.end() - 1);
    for (std::uint32_t l = 0; l + 1 < first_of_leaf_.size(); ++l)
      for (std::uint32_t i = first_of_leaf_[l]; i < first_of_leaf_[l + 1]; ++i)
        at[front_[pixel_[i]]++] = {-depth[i], l};  // depth grows toward the viewer
    back_.resize(pixels), leaf_.resize(at.size());
    for (std::size_t p = 0; p < pixels; ++p) {
      std::sort(at.begin() + first[p], at.begin() + first[p + 1]);
      front_[p] = first[p], back_[p] = first[p + 1] - 1;  // of an empty pixel never looked at
    }
    for (std::size_t i = 0; i < at.size(); ++i) leaf_[i] = at[i].second;
  }

  std::vector<std::uint32_t> first_of_leaf_, pixel_;  // of every leaf its pixels
  std::vector<std::uint32_t> leaf_;                   // of every pixel its leaves
  std::vector<std::uint32_t> front_, back_, left_;    // in leaf_, of those that are alive; how many
};

class Greedy {
 public:
  Greedy(std::span<const ViewedLeaf> leaves, const OcclusionOptions& options)
      : leaves_(leaves),
        options_(options),
        alive_(leaves.size(), 1),
        total_(leaves.size(), 0),
        sole_(leaves.size(), 0),
        seen_(leaves.size(), 0) {}

  Occlusion run(const Double3& centre, double radius, const DoubleBox& box) {
    draw(centre, radius, box);
    count();
    Occlusion out;
    for (std::size_t l = 0; l < leaves_.size(); ++l) out.covered += total_[l], out.seen += 0.5 * seen_[l];
    take(out);
    return out;
  }

 private:
  void draw(const Double3& centre, double radius, const DoubleBox& box) {
    double area = 0;
    for (const ViewedLeaf& l : leaves_) area += area_of(l), triangles_ += l.triangles.size();
    // Seen from all round a leaf shows half of its area on the mean.
    const double pixel = std::sqrt(area * options_.views /
                                   (2 * options_.samples * double(std::max<std::size_t>(1, leaves_.size()))));
    // Leaves as large as the crown cover whole pictures: of very many such leaves these are smaller.
    const double pictures =
        (options_.views + k_control_views) * double(std::max<std::size_t>(1, leaves_.size()));
    const int narrowest =
        std::clamp(static_cast<int>(std::sqrt(k_most_samples / pictures)), k_least, k_narrowest);
    const auto round = [&](std::uint64_t turn, int views) {
      return eyes_round(centre, radius, std::isfinite(pixel) ? pixel : 0, turn, views, box, narrowest,
                        k_widest);
    };
    auto eyes = round(k_turn, options_.views);
    deciding_ = eyes.size();
    for (const LeafEye& eye : round(k_control_turn, k_control_views)) eyes.push_back(eye);
    layers_.resize(eyes.size());
    tbb::parallel_for(std::size_t{0}, eyes.size(),
                      [&](std::size_t v) { layers_[v].draw(leaves_, centre, eyes[v]); });
  }

  void count() {
    for (const Layers& view : std::span(layers_).subspan(deciding_))
      view.each_pixel([&](std::uint32_t) { control_ += 0.5; }, [](std::uint32_t) {});
    for (const Layers& view : std::span(layers_).first(deciding_)) {
      view.each_pixel([&](std::uint32_t l) { ++seen_[l]; }, [&](std::uint32_t l) { ++sole_[l]; });
      for (std::uint32_t l = 0; l < leaves_.size(); ++l) total_[l] += view.pixels_of(l);
    }
  }

  // Of each triangle of the leaf, pixels.
  float cost(std::uint32_t l) const {
    const double vanish = sole_[l] + options_.other * (0.5 * seen_[l] - sole_[l]);
    const double known = options_.prior.empty() ? 0 : options_.prior[l];
    return static_cast<float>((vanish + known) /
                              double(std::max<std::size_t>(1, leaves_[l].triangles.size())));
  }

  void take(Occlusion& out) {
    using Offer = std::pair<float, std::uint32_t>;
    std::vector<Offer> all;
    for (std::uint32_t l = 0; l < leaves_.size(); ++l) all.emplace_back(cost(l), l);
    std::priority_queue<Offer, std::vector<Offer>, std::greater<>> offers(std::greater<>{}, std::move(all));
    const double most = (1 - options_.coverage) * control_;
    std::uint32_t lost = 0;
    while (!offers.empty()) {
      const auto [asked, leaf] = offers.top();
      offers.pop();
      const float now = cost(leaf);  // it grows while others go
      if (now > asked) {
        offers.emplace(now, leaf);
        continue;
      }
      const std::size_t faces = leaves_[leaf].triangles.size();
      if (triangles_ < options_.least + faces) return;
      alive_[leaf] = 0;
      for (Layers& view : std::span(layers_).subspan(deciding_))
        lost += view.remove(
            leaf, alive_, [](std::uint32_t) {}, [](std::uint32_t) {});
      if (lost > most) return;
      triangles_ -= faces;
      out.gone.push_back(leaf);
      for (Layers& view : std::span(layers_).first(deciding_))
        view.remove(
            leaf, alive_, [&](std::uint32_t l) { ++seen_[l]; }, [&](std::uint32_t l) { ++sole_[l]; });
    }
  }

  std::span<const ViewedLeaf> leaves_;
  const OcclusionOptions& options_;
  std::vector<Layers> layers_;
  std::size_t deciding_ = 0;  // of them; those after control
  double control_ = 0;        // pixels that they show covered
  std::vector<std::uint8_t> alive_;
  std::vector<std::uint32_t> total_, sole_, seen_;  // pixels of every leaf
  std::size_t triangles_ = 0;                       // that are left
};

}  // namespace

Occlusion leaves_by_occlusion(std::span<const ViewedLeaf> leaves, const Double3& centre, double radius,
                              const DoubleBox& box, const OcclusionOptions& options) {
  return Greedy(leaves, options).run(centre, radius, box);
}

}  // namespace copse
