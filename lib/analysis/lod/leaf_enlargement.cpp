#include "lib/analysis/lod/leaf_enlargement.h"

#include "lib/analysis/measure/view_sphere.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace copse {
namespace {

constexpr double k_margin = 0.012;      // of the crown's width, out of its hull
constexpr int k_hull_subdivisions = 2;  // 162 directions
constexpr int k_halvings = 60;  // of the interval in which a factor is sought: as exact as doubles are
constexpr double k_enough = 1 - 1e-12;  // of an area

double triangle_area(const PartTriangles& part, const std::array<std::uint32_t, 3>& t) {
  const Double3 a = to_double(part.vertices[t[0]].position);
  return 0.5 * length(cross(to_double(part.vertices[t[1]].position) - a,
                            to_double(part.vertices[t[2]].position) - a));
}

// The supports of a set of points, and how much a leaf may grow before it reaches out of them.
class Hull {
 public:
  explicit Hull(std::span<const SpectrumVertex> vertices)
      : directions_(view_sphere(k_hull_subdivisions).directions),
        support_(directions_.size(), -std::numeric_limits<double>::infinity()) {
    for (std::size_t d = 0; d < directions_.size(); ++d)
      for (const SpectrumVertex& v : vertices)
        support_[d] = std::max(support_[d], dot(directions_[d], to_double(v.position)));
    double width = 0;
    for (std::size_t d = 0; d < directions_.size(); ++d)
      for (std::size_t e = 0; e < d; ++e)
        if (dot(directions_[d], directions_[e]) < -1 + 1e-9)
          width = std::max(width, support_[d] + support_[e]);
    for (double& s : support_) s += k_margin * width;
  }

  // The largest factor of lengths, from the anchor, that keeps the point inside.
  double largest(const Double3& anchor, const Double3& point) const {
    double most = std::numeric_limits<double>::infinity();
    for (std::size_t d = 0; d < directions_.size(); ++d) {
      const double along = dot(directions_[d], point - anchor);
      if (along > 0) most = std::min(most, (support_[d] - dot(directions_[d], anchor)) / along);
    }
    return most;
  }

 private:
  std::vector<Double3> directions_;
  std::vector<double> support_;
};

double longest_half(const OrientedBox<float>& box) {
  return std::max({box.half_extents.x, box.half_extents.y, box.half_extents.z});
}

void grow(DoubleBox& box, const OrientedBox<float>& by) {
  for (int corner = 0; corner < 8; ++corner) {
    Double3 p = to_double(by.centre);
    for (int a = 0; a < 3; ++a)
      p += to_double(by.axes[a]) *
           ((corner >> a & 1) != 0 ? double{by.half_extents[a]} : -double{by.half_extents[a]});
    box.grow(p);
  }
}

}  // namespace

LeafEnlargement::LeafEnlargement(const Tree& tree, const PartTriangles& part, const FoliageCells& foliage)
    : foliage_(foliage) {
  measure(tree, part);
  make_runs();
}

void LeafEnlargement::measure(const Tree& tree, const PartTriangles& part) {
  const Hull hull(part.vertices);
  leaves_.reserve(foliage_.order.size());
  for (const std::uint32_t l : foliage_.order) {
    Leaf leaf;
    const Double3 anchor = to_double(tree.leaves.centres[l]);
    double most = std::sqrt(double{foliage_.parameters.largest_enlargement});
    const std::size_t end = std::min(tree.first_triangle_of_leaf(l + 1), part.triangles.size());
    for (std::size_t t = tree.first_triangle_of_leaf(l); t < end; ++t) {
      leaf.area += triangle_area(part, part.triangles[t]);
      for (const std::uint32_t v : part.triangles[t]) {
        const Double3 p = to_double(part.vertices[v].position);
        leaf.reach = std::max(leaf.reach, distance(p, anchor));
        most = std::min(most, hull.largest(anchor, p));
      }
    }
    leaf.most = most > 1 ? most * most : 1;
    leaves_.push_back(leaf);
  }
}

// Every cell; then always two of the runs before, up to the whole.
void LeafEnlargement::make_runs() {
  std::vector<DoubleBox> boxes;
  for (std::uint32_t c = 0; c < foliage_.cells.size(); ++c) {
    const FoliageCell& cell = foliage_.cells[c];
    runs_.push_back({c, c + 1, longest_half(cell.box), 0});
    for (std::uint32_t i = cell.first; i < cell.first + cell.count; ++i) runs_.back().area += leaves_[i].area;
    grow(boxes.emplace_back(), cell.box);
  }
  for (std::size_t begin = 0, end = runs_.size(); end - begin > 1;) {
    for (std::size_t i = begin; i < end; i += 2) {
      Run run = runs_[i];
      DoubleBox box = boxes[i];
      if (i + 1 < end) {
        run.last = runs_[i + 1].last, run.area += runs_[i + 1].area;
        box.grow(boxes[i + 1]);
        const Double3 e = box.extent();
        run.half = std::max({run.half, runs_[i + 1].half, e.x / 2, e.y / 2, e.z / 2});
      }
      runs_.push_back(run), boxes.push_back(box);
    }
    begin = end, end = runs_.size();
  }
}

template <class F>
void LeafEnlargement::for_each_shown(const Run& run, std::span<const std::uint32_t> shown, F&& f) const {
  for (std::uint32_t c = run.first; c < run.last; ++c)
    for (std::uint32_t i = 0; i < shown[c]; ++i) f(foliage_.cells[c].first + i);
}

void LeafEnlargement::fill(const Run& run, std::span<const std::uint32_t> shown,
                           std::vector<double>& factors) const {
  const auto limit = [&](std::uint32_t i) {
    const Leaf& leaf = leaves_[i];
    const double fits = leaf.reach > 0 ? run.half / leaf.reach : 1;
    return std::max(factors[i], std::min(leaf.most, fits * fits));
  };
  double now = 0, most = 0;
  for_each_shown(run, shown, [&](std::uint32_t i) {
    now += leaves_[i].area * factors[i], most += leaves_[i].area * limit(i);
  });
  if (now >= k_enough * run.area) return;
  double low = 1, high = std::max(1.0, double{foliage_.parameters.largest_enlargement});
  // All grow to the same factor, but what is already larger stays, and what does not fit grows as far as it
  // does.
  for (int i = 0; i < k_halvings && most > run.area; ++i) {
    const double middle = (low + high) / 2;
    double sum = 0;
    for_each_shown(run, shown, [&](std::uint32_t l) {
      sum += leaves_[l].area * std::clamp(middle, factors[l], limit(l));
    });
    (sum < run.area ? low : high) = middle;
  }
  for_each_shown(run, shown, [&](std::uint32_t i) { factors[i] = std::clamp(high, factors[i], limit(i)); });
}

std::vector<double> LeafEnlargement::factors(std::span<const std::uint32_t> shown) const {
  std::vector<double> out(leaves_.size(), 0);
  for (std::uint32_t c = 0; c < foliage_.cells.size(); ++c)
    std::fill_n(out.begin() + foliage_.cells[c].first, shown[c], 1.0);
  for (const Run& run : runs_) fill(run, shown, out);
  return out;
}

}  // namespace copse
