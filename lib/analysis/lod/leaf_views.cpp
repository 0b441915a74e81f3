#include "lib/analysis/lod/leaf_views.h"

#include "lib/analysis/measure/view_sphere.h"
#include "lib/formats/random.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>

#include <tbb/parallel_for.h>

namespace copse {
namespace {

constexpr int k_narrowest = 16, k_widest = 512;  // pixels of a picture
constexpr int k_block = 4;                // pixels: coverage is balanced over three by three such blocks
constexpr double k_whole = 40;            // the same for the coverage of the whole crown
constexpr double k_most_whole = 1.5;      // ... at most
constexpr float k_balance = 4;            // of a pixel's value, how much the balance round it counts
constexpr int k_fewest = 4, k_most = 24;  // points of a triangle that stand for its pixels

// Evenly over a triangle with corners (0, 0), (1, 0), (0, 1): the first n of them are so too (the plastic
// number's sequence, Roberts 2018, folded).
std::array<Float2, k_most> points_of_triangle() {
  std::array<Float2, k_most> out;
  for (int i = 0; i < k_most; ++i) {
    const double s = std::fmod(0.5 + 0.7548776662466927 * (i + 1), 1.0),
                 t = std::fmod(0.5 + 0.5698402909980532 * (i + 1), 1.0);
    const bool over = s + t > 1;
    out[i] = {static_cast<float>(over ? 1 - s : s), static_cast<float>(over ? 1 - t : t)};
  }
  return out;
}
const std::array<Float2, k_most> k_points = points_of_triangle();

// One of each pair of opposite directions, all turned together.
std::vector<Double3> half_sphere(std::uint64_t turn, int views) {
  Random draw = Random(0x1eaf).fork(turn);
  const auto any = [&] { return 2 * draw.uniform() - 1; };
  const Double3 x = normalized(Double3{any(), any(), any()}, {1, 0, 0});
  const Double3 y = normalized(cross(x, Double3{any(), any(), any()}), {0, 1, 0});
  const Double3 z = cross(x, y);
  // Directions evenly over one half: a spiral from pole to rim.
  std::vector<Double3> out;
  for (int i = 0; i < views; ++i) {
    const double h = (i + 0.5) / views, angle = 2.399963229728653 * i, r = std::sqrt(1 - h * h);
    out.push_back(x * (r * std::cos(angle)) + y * (r * std::sin(angle)) + z * h);
  }
  return out;
}

// The view of what is in the box: all of it when that is empty.
LeafEye cropped(const OrthographicView& view, const DoubleBox& box) {
  LeafEye eye(view);
  if (box.empty()) return eye;
  DoubleBox on;
  for (int c = 0; c < 8; ++c)
    on.grow(view.project({(c & 1) != 0 ? box.max.x : box.min.x, (c & 2) != 0 ? box.max.y : box.min.y,
                          (c & 4) != 0 ? box.max.z : box.min.z}));
  const auto cut = [](double low, double high, float& at, int& size) {
    const int from = static_cast<int>(std::clamp(low - 1, 0.0, double(size - 1)));
    const int to = static_cast<int>(std::clamp(high + 2, double(from + 1), double(size)));
    at -= static_cast<float>(from), size = to - from;
  };
  cut(on.min.x, on.max.x, eye.x, eye.width), cut(on.min.y, on.max.y, eye.y, eye.height);
  return eye;
}

}  // namespace

namespace {

int picture_size(double radius, double pixel, int narrowest, int widest) {
  const double wanted = pixel > 0 && radius > 0 ? 2 * radius / pixel : narrowest;
  return static_cast<int>(std::clamp<double>(std::ceil(wanted), narrowest, widest));
}

}  // namespace

std::vector<LeafEye> eyes_round(const Double3& centre, double radius, double pixel, std::uint64_t turn,
                                int views, const DoubleBox& box, int narrowest, int widest) {
  std::vector<LeafEye> eyes;
  for (const Double3& d : half_sphere(turn, views))
    eyes.push_back(
        cropped(view_of_sphere(centre, radius, d, picture_size(radius, pixel, narrowest, widest)), box));
  return eyes;
}

LeafViews::LeafViews(const Double3& centre, double radius, double pixel, std::uint64_t turn, int views,
                     const DoubleBox& box)
    : eyes_(eyes_round(centre, radius, pixel, turn, std::clamp(views, 1, k_most_views), box, k_narrowest,
                       k_widest)),
      centre_(centre),
      pixel_(view_of_sphere(centre, radius, {0, 0, 1}, picture_size(radius, pixel, k_narrowest, k_widest))
                 .pixel) {
  first_.push_back(0);
  for (const LeafEye& eye : eyes_)
    first_.push_back(first_.back() +
                     static_cast<std::size_t>(eye.width) * static_cast<std::size_t>(eye.height));
  per_step_ = radius > 0 ? static_cast<float>(0x1p29 / radius) : 0;
}

LeafViews::Local LeafViews::local(const ViewedLeaf& leaf, std::size_t triangle) const {
  Local out{{}, {}, leaf.mask};
  for (int c = 0; c < 3; ++c) {
    const SpectrumVertex& v = leaf.vertices[leaf.triangles[triangle][c]];
    out.corners[c] = to_float(to_double(v.position) - centre_), out.texcoords[c] = v.texcoord;
  }
  return out;
}

LeafViews::Scene LeafViews::scene(std::span<const ViewedLeaf> leaves) const {
  Scene out;
  out.triangles.reserve(2 * leaves.size()), out.first.reserve(leaves.size() + 1);
  for (const ViewedLeaf& leaf : leaves) {
    out.first.push_back(static_cast<std::uint32_t>(out.triangles.size()));
    for (std::size_t t = 0; t < leaf.triangles.size(); ++t) out.triangles.push_back(local(leaf, t));
  }
  out.first.push_back(static_cast<std::uint32_t>(out.triangles.size()));
  return out;
}

template <class See, class Wanted>
void LeafViews::draw(const Local& t, std::size_t view, See&& see, const Wanted& wanted) const {
  const LeafEye& eye = eyes_[view];
  for_each_leaf_pixel({eye.project(t.corners[0]), eye.project(t.corners[1]), eye.project(t.corners[2])},
                      t.texcoords, t.mask, eye.width, eye.height, see, wanted);
}

template <class See>
void LeafViews::sample(const ViewedLeaf& leaf, See&& see) const {
  for (std::size_t t = 0; t < leaf.triangles.size(); ++t) {
    const auto [corners, uv, mask] = local(leaf, t);
    const Float3 a = corners[0], p = corners[1] - a, q = corners[2] - a;
    const Double3 n = to_double(cross(p, q));
    const double pixels = std::sqrt(dot(n, n)) / (4 * pixel_ * pixel_);  // half of its area, on average
    const int points = pixels < k_most ? std::max(static_cast<int>(pixels + 0.5), k_fewest) : k_most;
    for (std::size_t v = 0; v < eyes_.size(); ++v) {
      const LeafEye& eye = eyes_[v];
      const Float3 from = eye.project(a);
      const Float3 along{dot(p, eye.right), dot(p, eye.down), dot(p, eye.toward)};
      const Float3 across{dot(q, eye.right), dot(q, eye.down), dot(q, eye.toward)};
      const float area = 0.5f * std::abs(along.x * across.y - along.y * across.x);
      const float weight = area / static_cast<float>(points);
      if (!(weight > 0)) continue;
      const int first = points < k_most ? static_cast<int>(v) * points : 0;  // other ones in each view
      for (int i = 0; i < points; ++i) {
        const auto [s, r] = k_points[(first + i) % k_most];
        const float x = from.x + s * along.x + r * across.x, y = from.y + s * along.y + r * across.y;
        if (!(x >= 0 && y >= 0 && x < static_cast<float>(eye.width) && y < static_cast<float>(eye.height)))
          continue;
        if (mask != nullptr &&
            !leaf_raster::passes(*mask, uv[0].x + s * (uv[1].x - uv[0].x) + r * (uv[2].x - uv[0].x),
                                 uv[0].y + s * (uv[1].y - uv[0].y) + r * (uv[2].y - uv[0].y)))
          continue;
        const std::size_t at_pixel =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(eye.width) + static_cast<std::size_t>(x);
        see(seen_[first_[v] + at_pixel], from.z + s * along.z + r * across.z, weight);
      }
    }
  }
}

void LeafViews::set_source(std::span<const ViewedLeaf> leaves) {
  const Scene drawn = scene(leaves);
  source_.assign(first_.back(), 0);
  tbb::parallel_for(std::size_t{0}, eyes_.size(), [&](std::size_t v) {
    const auto picture = of_view(source_, v);
    const auto see = [&](std::size_t p, float) { picture[p] = 1; };
    const auto wanted = [&](std::size_t p) { return picture[p] == 0; };
    for (const Local& t : drawn.triangles) draw(t, v, see, wanted);
  });
  source_count_ = 0;
  for (const std::uint8_t covered : source_) source_count_ += covered;
}

void LeafViews::look(const Scene& scene, std::size_t view, std::vector<Count>& counts) {
  const std::span<Pixel> picture = pixels_of(view);
  std::vector<std::uint32_t> last;  // leaf of more than two triangles, which may lie in front of itself
  counts.resize(scene.first.size() - 1);
  for (std::uint32_t l = 0; l < counts.size(); ++l) {
    const std::uint32_t begin = scene.first[l], end = scene.first[l + 1];
    const bool folded = end - begin > 2;
    if (folded && last.empty()) last.assign(picture.size(), k_none);
    std::uint32_t total = 0;
    const auto see = [&](std::size_t at, float depth) {
      Pixel& p = picture[at];
      const std::uint64_t here = key(depth, l);
      p.front = std::max(p.front, here), p.back = std::min(p.back, here);
      if (folded) {
        if (last[at] == l) return;
        last[at] = l;
      }
      ++p.count, ++total;
    };
    for (std::uint32_t t = begin; t < end; ++t) draw(scene.triangles[t], view, see);
    counts[l].total = total;
  }
  for (const Pixel& p : picture) {
    if (p.count == 0) continue;
    counts[p.front_leaf()].sole += p.count == 1;
    ++counts[p.front_leaf()].seen, ++counts[p.back_leaf()].seen;
  }
}

std::vector<LeafViews::Count> LeafViews::look(std::span<const ViewedLeaf> leaves) {
  seen_.assign(first_.back(), {});
  source_.resize(seen_.size(), 0);
  std::vector<std::vector<Count>> counts(eyes_.size());
  const Scene drawn = scene(leaves);
  tbb::parallel_for(std::size_t{0}, eyes_.size(), [&](std::size_t v) { look(drawn, v, counts[v]); });
  count_ = 0;
  for (const Pixel& p : seen_) count_ += p.count > 0;
  tbb::parallel_for(std::size_t{0}, eyes_.size(), [&](std::size_t v) { balance(v); });
  std::vector<Count> sum(leaves.size());
  for (const auto& view : counts)
    for (std::size_t l = 0; l < sum.size(); ++l)
      sum[l].total += view[l].total, sum[l].sole += view[l].sole, sum[l].seen += view[l].seen;
  return sum;
}

// Values the pixels of a view by how much is covered too much round each of them, and of the whole crown.
void LeafViews::balance(std::size_t view) {
  const std::span<Pixel> picture = pixels_of(view);
  const auto source = of_view(source_, view);
  const int width = eyes_[view].width, height = eyes_[view].height;
  const int columns = (width + k_block - 1) / k_block, rows = (height + k_block - 1) / k_block;
  const auto too_much =
      static_cast<float>(std::clamp(k_whole * (coverage() - 1), -k_most_whole, k_most_whole));
  std::vector<float> sum(static_cast<std::size_t>(columns) * rows, 0);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const std::size_t p = static_cast<std::size_t>(y) * width + x;
      sum[static_cast<std::size_t>(y / k_block) * columns + x / k_block] +=
          static_cast<float>(picture[p].count > 0) - static_cast<float>(source[p]);
    }
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) {
      float around = 0;
      for (int j = std::max(y - 1, 0); j <= std::min(y + 1, rows - 1); ++j)
        for (int i = std::max(x - 1, 0); i <= std::min(x + 1, columns - 1); ++i)
          around += sum[static_cast<std::size_t>(j) * columns + i];
      const float less = k_balance * around / (9 * k_block * k_block) + too_much;
      for (int j = y * k_block; j < std::min((y + 1) * k_block, height); ++j)
        for (int i = x * k_block; i < std::min((x + 1) * k_block, width); ++i) {
          const std::size_t p = static_cast<std::size_t>(j) * width + i;
          picture[p].value = (source[p] != 0 ? 1.0f : -1.0f) - less;
        }
    }
}

bool LeafViews::Exchange::taken(std::uint32_t leaf) const {
  return leaf < taken_.size() && taken_[leaf] != 0;
}

void LeafViews::Exchange::remove(std::span<const std::uint32_t> numbers, std::span<const ViewedLeaf> leaves) {
  for (const std::uint32_t p : touched_) marks_[p] = {};
  touched_.clear();
  marks_.resize(views_.seen_.size());
  for (const std::uint32_t n : numbers_) taken_[n] = 0;
  numbers_.assign(numbers.begin(), numbers.end());
  taken_.resize(std::max<std::size_t>(taken_.size(), *std::max_element(numbers.begin(), numbers.end()) + 1u));
  for (const std::uint32_t n : numbers_) taken_[n] = 1;
  removed_ = {};
  for (std::size_t l = 0; l < leaves.size(); ++l) {
    for (std::size_t t = 0; t < leaves[l].triangles.size(); ++t) {
      const Local triangle = views_.local(leaves[l], t);
      for (std::size_t v = 0; v < views_.eyes_.size(); ++v) {
        views_.draw(triangle, v, [&, first = views_.first_[v]](std::size_t at, float) {
          const std::size_t p = first + at;
          Mark& mark = marks_[p];
          if (mark.count == 0) touched_.push_back(static_cast<std::uint32_t>(p));
          if (mark.last != l + 1) mark.last = static_cast<std::uint16_t>(l + 1), ++mark.count;
        });
      }
    }
  }
  for (const std::uint32_t p : touched_) {
    const Pixel& pixel = views_.seen_[p];
    if (pixel.count == marks_[p].count)
      removed_.covered += pixel.value;
    else
      removed_.other += 0.5 * taken(pixel.front_leaf()) + 0.5 * taken(pixel.back_leaf());
  }
}

LeafViews::Change LeafViews::Exchange::add(const ViewedLeaf& leaf, std::uint32_t like) {
  Change change = removed_;
  const auto side = [&](std::uint32_t owner, bool in_front) {
    if (taken(owner)) return owner == like ? -0.5 : -0.25;  // it was to show what is behind
    return in_front ? 0.5 : 0.0;
  };
  for (std::size_t t = 0; t < leaf.triangles.size(); ++t) {
    const Local triangle = views_.local(leaf, t);
    for (std::size_t v = 0; v < views_.eyes_.size(); ++v) {
      views_.draw(triangle, v, [&, first = views_.first_[v]](std::size_t at, float depth) {
        const Pixel& pixel = views_.seen_[first + at];
        if (pixel.count == marks_[first + at].count)
          change.covered -= pixel.value;
        else
          change.other += side(pixel.front_leaf(), views_.key(depth, k_none) > pixel.front) +
                          side(pixel.back_leaf(), views_.key(depth, 0) < pixel.back);
      });
    }
  }
  return change;
}

bool LeafViews::Estimate::taken(std::uint32_t leaf) const {
  return std::find(numbers_.begin(), numbers_.end(), leaf) != numbers_.end();
}

bool LeafViews::Estimate::alone(const Pixel& pixel) const {
  return pixel.count <= 2 && (pixel.count == 0 || (taken(pixel.front_leaf()) && taken(pixel.back_leaf())));
}

void LeafViews::Estimate::remove(std::span<const std::uint32_t> numbers, std::span<const ViewedLeaf> leaves) {
  numbers_.assign(numbers.begin(), numbers.end());
  removed_ = {};
  for (std::size_t l = 0; l < leaves.size(); ++l) {
    views_.sample(leaves[l], [&](const Pixel& pixel, float, float weight) {
      // What two of them cover together each of them loses by half.
      const double share = pixel.count == 2 ? 0.5 * weight : weight;
      if (alone(pixel))
        removed_.covered += share * pixel.value;
      else
        removed_.other +=
            weight * (0.5 * (pixel.front_leaf() == numbers[l]) + 0.5 * (pixel.back_leaf() == numbers[l]));
    });
  }
}

LeafViews::Change LeafViews::Estimate::add(const ViewedLeaf& leaf, std::uint32_t like) const {
  Change change = removed_;
  const auto side = [&](std::uint32_t owner, bool in_front) {
    if (taken(owner)) return owner == like ? -0.5 : -0.25;  // it was to show what is behind
    return in_front ? 0.5 : 0.0;
  };
  views_.sample(leaf, [&](const Pixel& pixel, float depth, float weight) {
    if (alone(pixel))
      change.covered -= weight * pixel.value;
    else
      change.other += weight * (side(pixel.front_leaf(), views_.key(depth, k_none) > pixel.front) +
                                side(pixel.back_leaf(), views_.key(depth, 0) < pixel.back));
  });
  return change;
}

}  // namespace copse
