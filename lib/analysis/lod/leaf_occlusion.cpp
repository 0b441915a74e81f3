#include "lib/analysis/lod/leaf_occlusion.h"

#include <algorithm>
#include <bit>
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

// A number from 0 to 1 of the i-th of a sequence that fills the interval evenly (Weyl's), exactly.
constexpr std::uint32_t k_golden = 0x9e3779b9u;                         // 2^32 over the golden ratio
constexpr std::uint32_t k_first = 0xc13fa9a9u, k_second = 0x91e10da5u;  // the same for pairs of numbers
float part(std::uint32_t i) {
  return static_cast<float>(i >> 8) * 0x1p-24f;
}

// All leaves' triangles round the ball's centre, leaf after leaf.
struct Scene {
  struct Flat {
    Float3 at, e, f;  // a corner, and from it to the others
    std::array<Float2, 3> texcoords;
    std::uint32_t seed;  // of equal places equal
  };
  std::vector<Flat> triangles;
  std::vector<std::uint32_t> first;  // of each leaf, and one number more
  std::vector<const AlphaMask*> masks;

  Scene(std::span<const ViewedLeaf> leaves, const Double3& centre) {
    first.reserve(leaves.size() + 1), masks.reserve(leaves.size()), triangles.reserve(leaves.size());
    for (const ViewedLeaf& leaf : leaves) {
      first.push_back(static_cast<std::uint32_t>(triangles.size())), masks.push_back(leaf.mask);
      for (const auto& t : leaf.triangles) {
        const SpectrumVertex &a = leaf.vertices[t[0]], &b = leaf.vertices[t[1]], &c = leaf.vertices[t[2]];
        const Float3 at = to_float(to_double(a.position) - centre);
        triangles.push_back({at,
                             to_float(to_double(b.position) - centre) - at,
                             to_float(to_double(c.position) - centre) - at,
                             {a.texcoord, b.texcoord, c.texcoord},
                             seed_of(a.position) + seed_of(b.position) + seed_of(c.position)});
      }
    }
    first.push_back(static_cast<std::uint32_t>(triangles.size()));
  }

 private:
  static std::uint32_t seed_of(const Float3& p) {
    const auto bits = [](float x) { return std::bit_cast<std::uint32_t>(x); };
    const std::uint32_t h = (bits(p.x) * k_first ^ bits(p.y)) * k_second ^ bits(p.z);
    return (h ^ h >> 15) * k_golden;
  }
};

// One picture: of each pixel the leaves that cover it, the nearest first.
class Layers {
 public:
  void draw(const Scene& scene, std::size_t samples, float few, const LeafEye& eye) {
    const std::size_t pixels = std::size_t(eye.width) * std::size_t(eye.height);
    std::vector<std::uint32_t> last;  // leaf of more than two triangles, which may cover a pixel twice
    first_of_leaf_.reserve(scene.first.size()), pixel_.reserve(samples), depth_.reserve(samples);
    for (std::uint32_t l = 0; l < scene.masks.size(); ++l) {
      first_of_leaf_.push_back(std::uint32_t(pixel_.size()));
      const bool folded = scene.first[l + 1] - scene.first[l] > 2;
      if (folded && last.empty()) last.assign(pixels, 0);
      for (std::uint32_t t = scene.first[l]; t < scene.first[l + 1]; ++t) {
        const Scene::Flat& flat = scene.triangles[t];
        const Float3 at = eye.project(flat.at), e = along(eye, flat.e), f = along(eye, flat.f);
        const float area = 0.5f * std::abs(e.x * f.y - e.y * f.x);
        if (area < few) {
          draw_points(at, e, f, area, flat, scene.masks[l], eye);
          continue;
        }
        for_each_leaf_pixel({at, at + e, at + f}, flat.texcoords, scene.masks[l], eye.width, eye.height,
                            [&](std::size_t p, float d) {
                              if (folded && std::exchange(last[p], l + 1) == l + 1) return;
                              pixel_.push_back(std::uint32_t(p)), depth_.push_back(d);
                            });
      }
    }
    first_of_leaf_.push_back(std::uint32_t(pixel_.size()));
    sort(pixels);
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
  static Float3 along(const LeafEye& eye, const Float3& way) {
    return {dot(way, eye.right), dot(way, eye.down), dot(way, eye.toward)};
  }

  // A triangle of few pixels as points, as many as it has pixels on the mean: what counts is how many leaves
  // cover the ground, not where one ends.
  void draw_points(const Float3& at, const Float3& e, const Float3& f, float area, const Scene::Flat& flat,
                   const AlphaMask* mask, const LeafEye& eye) {
    const std::uint32_t seed = flat.seed;
    const auto& texcoords = flat.texcoords;
    const int points = static_cast<int>(area + part(seed));
    const std::size_t first = first_of_leaf_.back();
    for (int i = 0; i < points; ++i) {
      const auto n = static_cast<std::uint32_t>(i + 1);
      float v = part(seed + n * k_first), w = part((seed ^ k_golden) + n * k_second);
      if (v + w > 1) v = 1 - v, w = 1 - w;
      const float x = at.x + v * e.x + w * f.x, y = at.y + v * e.y + w * f.y;
      if (!(x >= 0 && y >= 0 && x < static_cast<float>(eye.width) && y < static_cast<float>(eye.height)))
        continue;
      if (mask != nullptr) {
        const float u = 1 - v - w;
        if (!leaf_raster::passes(*mask, u * texcoords[0].x + v * texcoords[1].x + w * texcoords[2].x,
                                 u * texcoords[0].y + v * texcoords[1].y + w * texcoords[2].y))
          continue;
      }
      const auto pixel = static_cast<std::uint32_t>(static_cast<int>(y) * eye.width + static_cast<int>(x));
      if (std::find(pixel_.begin() + std::ptrdiff_t(first), pixel_.end(), pixel) != pixel_.end()) continue;
      pixel_.push_back(pixel), depth_.push_back(at.z + v * e.z + w * f.z);
    }
  }

  void sort(std::size_t pixels) {
    std::vector<std::uint32_t> first(pixels + 1, 0);
    for (const std::uint32_t p : pixel_) ++first[p + 1];
    left_.assign(first.begin() + 1, first.end());
    for (std::size_t p = 0; p < pixels; ++p) first[p + 1] += first[p];
    std::vector<std::uint64_t> at(pixel_.size());
    front_.assign(first.begin(), first.end() - 1);
    for (std::uint32_t l = 0; l + 1 < first_of_leaf_.size(); ++l)
      for (std::uint32_t i = first_of_leaf_[l]; i < first_of_leaf_[l + 1]; ++i)
        at[front_[pixel_[i]]++] = key(depth_[i], l);
    back_.resize(pixels), leaf_.resize(at.size());
    for (std::size_t p = 0; p < pixels; ++p) {
      sort(std::span(at).subspan(first[p], first[p + 1] - first[p]));
      front_[p] = first[p], back_[p] = first[p + 1] - 1;  // of an empty pixel never looked at
    }
    for (std::size_t i = 0; i < at.size(); ++i) leaf_[i] = static_cast<std::uint32_t>(at[i]);
    depth_ = {};
  }

  // Depth grows toward the viewer: the nearest first, of equals the leaf of the least number.
  static std::uint64_t key(float depth, std::uint32_t leaf) {
    const auto bits = std::bit_cast<std::uint32_t>(depth);
    return std::uint64_t{(bits >> 31) != 0 ? bits : 0x7fffffffu - bits} << 32 | leaf;
  }

  static void sort(std::span<std::uint64_t> keys) {
    constexpr std::size_t k_short = 24;
    if (keys.size() > k_short) return std::sort(keys.begin(), keys.end());
    for (std::size_t i = 1; i < keys.size(); ++i) {
      const std::uint64_t moved = keys[i];
      std::size_t to = i;
      for (; to > 0 && moved < keys[to - 1]; --to) keys[to] = keys[to - 1];
      keys[to] = moved;
    }
  }

  std::vector<std::uint32_t> first_of_leaf_, pixel_;  // of every leaf its pixels
  std::vector<float> depth_;                          // in them
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
    const Scene scene(leaves_, centre);
    const auto samples = static_cast<std::size_t>(
        1.2 * std::min(options_.samples * double(leaves_.size()), k_most_samples) / options_.views);
    tbb::parallel_for(std::size_t{0}, eyes.size(),
                      [&](std::size_t v) { layers_[v].draw(scene, samples, options_.few, eyes[v]); });
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
