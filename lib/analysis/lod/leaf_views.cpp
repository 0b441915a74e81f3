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

constexpr int k_narrowest = 16, k_widest = 512;
constexpr int k_block = 4;      // pixels: coverage is balanced over three by three such blocks
constexpr double k_whole = 20;  // the same for the coverage of the whole crown
constexpr float k_balance = 4;  // of a pixel's value, how much the balance round it counts

// One of each pair of opposite directions, all turned together.
std::vector<Double3> half_sphere(std::uint64_t turn) {
  Random draw = Random(0x1eaf).fork(turn);
  const auto any = [&] { return 2 * draw.uniform() - 1; };
  const Double3 x = normalized(Double3{any(), any(), any()}, {1, 0, 0});
  const Double3 y = normalized(cross(x, Double3{any(), any(), any()}), {0, 1, 0});
  const Double3 z = cross(x, y);
  // Twelve directions evenly over one half: a spiral from pole to rim.
  std::vector<Double3> out;
  for (int i = 0; i < LeafViews::k_views; ++i) {
    const double h = (i + 0.5) / LeafViews::k_views, angle = 2.399963229728653 * i, r = std::sqrt(1 - h * h);
    out.push_back(x * (r * std::cos(angle)) + y * (r * std::sin(angle)) + z * h);
  }
  return out;
}

}  // namespace

LeafViews::LeafViews(const Double3& centre, double radius, double pixel, std::uint64_t turn) {
  const double wanted = pixel > 0 && radius > 0 ? 2 * radius / pixel : k_narrowest;
  const int size = static_cast<int>(std::clamp<double>(std::ceil(wanted), k_narrowest, k_widest));
  for (const Double3& d : half_sphere(turn)) views_.push_back(view_of_sphere(centre, radius, d, size));
  pixel_ = views_.front().pixel;
  pixels_ = static_cast<std::size_t>(size) * size;
}

template <class See>
void LeafViews::draw(const ViewedLeaf& leaf, std::size_t view, See&& see) const {
  const OrthographicView& v = views_[view];
  for (const ViewedTriangle& t : leaf.triangles) {
    ScreenTriangle on;
    on.mask = leaf.mask;
    for (int c = 0; c < 3; ++c) on.corners[c] = {v.project(t.corners[c]), t.texcoords[c]};
    for_each_sample(
        on, v.width, v.height, [](std::size_t, float) { return true; },
        [&](std::size_t p, float depth) { see(view * pixels_ + p, depth); });
  }
}

void LeafViews::set_source(std::span<const ViewedLeaf> leaves) {
  source_.assign(views_.size() * pixels_, 0);
  tbb::parallel_for(std::size_t{0}, views_.size(), [&](std::size_t v) {
    for (const ViewedLeaf& leaf : leaves) draw(leaf, v, [&](std::size_t p, float) { source_[p] = 1; });
  });
}

std::vector<LeafViews::Count> LeafViews::look(std::span<const ViewedLeaf> leaves) {
  seen_.assign(views_.size() * pixels_, {});
  std::vector<std::vector<Count>> counts(views_.size());
  tbb::parallel_for(std::size_t{0}, views_.size(), [&](std::size_t v) {
    counts[v].resize(leaves.size());
    for (std::uint32_t l = 0; l < leaves.size(); ++l) {
      draw(leaves[l], v, [&](std::size_t at, float depth) {
        Pixel& p = seen_[at];
        if (p.count == 0 || depth > p.front) p.front = depth, p.front_leaf = l;
        if (p.count == 0 || depth < p.back) p.back = depth, p.back_leaf = l;
        if (p.last_leaf == l) return;
        p.last_leaf = l, ++p.count, ++counts[v][l].total;
      });
    }
    for (std::size_t at = v * pixels_; at < (v + 1) * pixels_; ++at) {
      const Pixel& p = seen_[at];
      if (p.count == 0) continue;
      counts[v][p.last_leaf].sole += p.count == 1;
      ++counts[v][p.front_leaf].seen, ++counts[v][p.back_leaf].seen;
    }
  });
  balance();
  too_much_ = static_cast<float>(std::clamp(k_whole * (coverage() - 1), -1.0, 1.0));
  std::vector<Count> sum(leaves.size());
  for (const auto& view : counts)
    for (std::size_t l = 0; l < sum.size(); ++l)
      sum[l].total += view[l].total, sum[l].sole += view[l].sole, sum[l].seen += view[l].seen;
  return sum;
}

double LeafViews::coverage() const {
  std::uint64_t source = 0, now = 0;
  for (std::size_t p = 0; p < source_.size(); ++p) source += source_[p], now += seen_[p].count > 0;
  return source > 0 ? static_cast<double>(now) / static_cast<double>(source) : 1;
}

void LeafViews::balance() {
  const int size = views_.front().width;
  blocks_ = (size + k_block - 1) / k_block;
  const std::size_t per_view = static_cast<std::size_t>(blocks_) * blocks_;
  excess_.assign(views_.size() * per_view, 0);
  tbb::parallel_for(std::size_t{0}, views_.size(), [&](std::size_t v) {
    std::vector<float> sum(per_view), mean(per_view);
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x) {
        const std::size_t p = v * pixels_ + static_cast<std::size_t>(y) * size + x;
        sum[static_cast<std::size_t>(y / k_block) * blocks_ + x / k_block] +=
            static_cast<float>(seen_[p].count > 0) - static_cast<float>(source_[p]);
      }
    for (int y = 0; y < blocks_; ++y)
      for (int x = 0; x < blocks_; ++x) {
        float around = 0;
        for (int j = std::max(y - 1, 0); j <= std::min(y + 1, blocks_ - 1); ++j)
          for (int i = std::max(x - 1, 0); i <= std::min(x + 1, blocks_ - 1); ++i)
            around += sum[static_cast<std::size_t>(j) * blocks_ + i];
        excess_[v * per_view + static_cast<std::size_t>(y) * blocks_ + x] = around / (9 * k_block * k_block);
      }
  });
}

float LeafViews::value(std::size_t p) const {
  const std::size_t view = p / pixels_, within = p % pixels_;
  const auto size = static_cast<std::size_t>(views_.front().width);
  const std::size_t x = within % size / k_block, y = within / size / k_block;
  const float right = source_[p] != 0 ? 1.0f : -1.0f;
  return right - k_balance * excess_[(view * blocks_ + y) * blocks_ + x] - too_much_;
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
    for (std::size_t v = 0; v < views_.views_.size(); ++v) {
      views_.draw(leaves[l], v, [&](std::size_t p, float) {
        Mark& mark = marks_[p];
        if (mark.count == 0) touched_.push_back(static_cast<std::uint32_t>(p));
        if (mark.last != numbers[l]) mark.last = numbers[l], ++mark.count;
      });
    }
  }
  for (const std::uint32_t p : touched_) {
    const Pixel& pixel = views_.seen_[p];
    if (pixel.count == marks_[p].count)
      removed_.covered += views_.value(p);
    else
      removed_.other += 0.5 * taken(pixel.front_leaf) + 0.5 * taken(pixel.back_leaf);
  }
}

LeafViews::Change LeafViews::Exchange::add(const ViewedLeaf& leaf, std::uint32_t like) {
  Change change = removed_;
  const auto side = [&](std::uint32_t owner, bool in_front) {
    if (taken(owner)) return owner == like ? -0.5 : -0.25;  // it was to show what is behind
    return in_front ? 0.5 : 0.0;
  };
  for (std::size_t v = 0; v < views_.views_.size(); ++v) {
    views_.draw(leaf, v, [&](std::size_t p, float depth) {
      const Pixel& pixel = views_.seen_[p];
      if (pixel.count == marks_[p].count)
        change.covered -= views_.value(p);
      else
        change.other +=
            side(pixel.front_leaf, depth > pixel.front) + side(pixel.back_leaf, depth < pixel.back);
    });
  }
  return change;
}

}  // namespace copse
