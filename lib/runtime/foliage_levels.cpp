#include "lib/runtime/foliage_levels.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace copse {
namespace {

// The corners of a cell's box.
Double3 corner(const OrientedBox<float>& box, int which) {
  Double3 p = to_double(box.centre);
  for (int a = 0; a < 3; ++a)
    p += to_double(box.axes[a]) *
         ((which >> a & 1) != 0 ? double{box.half_extents[a]} : -double{box.half_extents[a]});
  return p;
}

constexpr double k_margin = 0.012;  // of the crown's width, out of its hull

// What a leaf may not grow out of: its cell's half extent round its centre, and the crown's supports.
class Bounds {
 public:
  Bounds(const Tree& tree, const FoliageCells& cells) : views_(cells.views.span()) {
    std::vector<double> low(views_.size(), std::numeric_limits<double>::infinity());
    support_.assign(views_.size(), -std::numeric_limits<double>::infinity());
    for (const auto& t : tree.leaves.triangles)
      for (const std::uint32_t v : t.vertex)
        for (std::size_t d = 0; d < views_.size(); ++d) {
          const double along = dot(to_double(views_[d]), to_double(tree.leaves.vertices[v]));
          support_[d] = std::max(support_[d], along), low[d] = std::min(low[d], along);
        }
    double width = 0;
    for (std::size_t d = 0; d < views_.size(); ++d) width = std::max(width, support_[d] - low[d]);
    for (double& s : support_) s += k_margin * width;
  }

  // The largest factor of lengths, from the anchor, that keeps the point inside.
  double largest(const Double3& anchor, const Double3& point, double reach) const {
    const double away = distance(anchor, point);
    double most = away > 0 ? reach / away : std::numeric_limits<double>::infinity();
    for (std::size_t d = 0; d < views_.size(); ++d) {
      const double along = dot(to_double(views_[d]), point - anchor);
      if (along > 0) most = std::min(most, (support_[d] - dot(to_double(views_[d]), anchor)) / along);
    }
    return most;
  }

 private:
  std::span<const Float3> views_;
  std::vector<double> support_;
};

LeafSize size_of(const Tree& tree, std::uint32_t leaf, double reach, const Bounds& bounds) {
  const Double3 anchor = to_double(tree.leaves.centres[leaf]);
  double area = 0, most = std::numeric_limits<double>::infinity();
  const std::size_t end = std::min(tree.first_triangle_of_leaf(leaf + 1), tree.leaves.triangles.size());
  for (std::size_t t = tree.first_triangle_of_leaf(leaf); t < end; ++t) {
    std::array<Double3, 3> p;
    for (std::size_t k = 0; k < 3; ++k) {
      p[k] = to_double(tree.leaves.vertices[tree.leaves.triangles[t].vertex[k]]);
      most = std::min(most, bounds.largest(anchor, p[k], reach));
    }
    area += 0.5 * length(cross(p[1] - p[0], p[2] - p[0]));
  }
  const double grown = most > 1 ? most * most : 1;
  return {static_cast<float>(area),
          static_cast<float>(std::min<double>(grown, std::numeric_limits<float>::max()))};
}

double triple(const Double3& a, const Double3& b, const Double3& c) {
  return dot(cross(a, b), c);
}

}  // namespace

double ramp_share(const FoliageParameters& p, double distance) {
  if (!(distance > p.near)) return 1;
  if (p.ramp == FoliageParameters::Ramp::linear) {
    if (distance >= p.far) return p.least;
    return 1 - (1 - double{p.least}) * (distance - p.near) / (double{p.far} - p.near);
  }
  // u = z^(-log_h 2), z >= 1 (erratum P1).
  if (!(p.near > 0) || !(p.half_distance > 1)) return p.least;
  const double u = std::exp(-std::log(2.0) * std::log(distance / p.near) / std::log(double{p.half_distance}));
  return std::clamp(u, double{p.least}, 1.0);
}

ViewWeights view_weights(const FoliageCells& cells, const Double3& toward_eye) {
  const double size = length(toward_eye);
  if (!(size > 0) || !std::isfinite(size)) return {};
  const Double3 d = toward_eye / size;
  ViewWeights best;
  double deepest = -std::numeric_limits<double>::infinity();
  for (const auto& t : cells.view_triangles) {
    const Double3 a = to_double(cells.views[t[0]]), b = to_double(cells.views[t[1]]),
                  c = to_double(cells.views[t[2]]);
    const double volume = triple(a, b, c);
    if (!(std::abs(volume) > 1e-12)) continue;
    const std::array<double, 3> w{triple(d, b, c) / volume, triple(a, d, c) / volume,
                                  triple(a, b, d) / volume};
    // The triangle that is pierced has no negative weight; rounding may leave none that is quite so.
    const double least = std::min({w[0], w[1], w[2]});
    if (!(least > deepest)) continue;
    deepest = least;
    const std::array<double, 3> kept{std::max(w[0], 0.0), std::max(w[1], 0.0), std::max(w[2], 0.0)};
    const double sum = kept[0] + kept[1] + kept[2];
    best = {t, {kept[0] / sum, kept[1] / sum, kept[2] / sum}};
  }
  return best;
}

std::vector<LeafSize> leaf_sizes(const Tree& tree, const FoliageCells& cells) {
  const Bounds bounds(tree, cells);
  std::vector<LeafSize> out(tree.leaf_count());
  for (const FoliageCell& cell : cells.cells) {
    const Float3& h = cell.box.half_extents;
    for (std::uint32_t i = cell.first; i < cell.first + cell.count; ++i)
      out[cells.order[i]] = size_of(tree, cells.order[i], std::max({h.x, h.y, h.z}), bounds);
  }
  return out;
}

FoliageLevels::FoliageLevels(const FoliageCells& cells, std::span<const LeafSize> sizes) : cells_(&cells) {
  sum_.push_back(0);
  for (const FoliageCell& cell : cells.cells) {
    for (std::uint32_t i = cell.first; i < cell.first + cell.count; ++i) {
      const LeafSize size = cells.order[i] < sizes.size() ? sizes[cells.order[i]] : LeafSize{};
      sum_.push_back(sum_.back() + double{size.area});
      most_.push_back(std::max(1.0f, size.most));
      least_most_.push_back(i == cell.first ? most_.back() : std::min(least_most_.back(), most_.back()));
    }
  }
  DoubleBox box;
  for (const FoliageCell& cell : cells.cells)
    for (int i = 0; i < 8; ++i) box.grow(corner(cell.box, i));
  if (box.empty()) return;
  centre_ = box.centre();
  for (const FoliageCell& cell : cells.cells)
    for (int i = 0; i < 8; ++i) radius_ = std::max(radius_, distance(corner(cell.box, i), centre_));
}

// Of the first so many leaves, the last one in part.
double FoliageLevels::area(const FoliageCell& cell, double leaves) const {
  const double whole = std::clamp(std::floor(leaves), 0.0, double(cell.count));
  const std::size_t at = cell.first + static_cast<std::size_t>(whole);
  const double part = whole < cell.count ? (leaves - whole) * (sum_[at + 1] - sum_[at]) : 0;
  return sum_[at] - sum_[cell.first] + part;
}

// What is drawn when all that can grows by `factor`.
double FoliageLevels::enlarged(const FoliageCell& cell, const CellLevel& level, double factor) const {
  double sum = 0;
  for (std::uint32_t i = 0; i < level.count; ++i) {
    const std::size_t at = cell.first + i;
    const double shown = i + 1 == level.count ? double{level.last} : 1.0;
    sum += shown * (sum_[at + 1] - sum_[at]) * std::min(factor, double{most_[at]});
  }
  return sum;
}

// Enlarges what is drawn of a cell to an area; returns what it cannot hold of it.
double FoliageLevels::fill(const FoliageCell& cell, CellLevel& level, double wanted) const {
  const double largest = cells_->parameters.largest_enlargement,
               shown = area(cell, level.count - 1.0 + double{level.last});
  level.enlargement = 1;
  if (level.count == 0 || !(shown > 0) || wanted <= shown) return std::max(0.0, wanted - shown);
  const double free = wanted / shown;
  if (free <= largest && free <= double{least_most_[cell.first + level.count - 1]}) {
    level.enlargement = static_cast<float>(free);
    return 0;
  }
  const double holds = enlarged(cell, level, largest);
  if (holds <= wanted) {
    level.enlargement = static_cast<float>(largest);
    return wanted - holds;
  }
  // What is drawn grows with the factor, so halving finds it: as exactly as a float says it.
  double low = 1, high = largest;
  for (int i = 0; i < 40 && static_cast<float>(low) != static_cast<float>(high); ++i) {
    const double middle = 0.5 * (low + high);
    (enlarged(cell, level, middle) < wanted ? low : high) = middle;
  }
  level.enlargement = static_cast<float>(high);
  return 0;
}

void FoliageLevels::choose(const Double3& eye, const Options& options, std::span<CellLevel> out) const {
  const FoliageParameters& p = cells_->parameters;
  const double away = distance(eye, centre_);
  const ViewWeights weights = view_weights(*cells_, eye - centre_);
  // What was counted from outside says nothing inside: 1 there, as counted from twice the radius on.
  const double counted = options.uniform || radius_ <= 0 ? 0 : std::clamp(away / radius_ - 1, 0.0, 1.0);
  const bool total = p.compensation == FoliageParameters::Compensation::total;
  double carried = 0;  // area that the cells before could not hold
  for (std::size_t c = 0; c < std::min(out.size(), cell_count()); ++c) {
    const FoliageCell& cell = cells_->cells[c];
    double visible = 0;
    for (std::size_t k = 0; k < 3; ++k)
      if (weights.weight[k] > 0) visible += weights.weight[k] * cells_->at(c, weights.view[k]).share();
    visible = counted * visible + (1 - counted);
    const double from =
        p.distance == FoliageParameters::Distance::tree ? away : distance(eye, to_double(cell.box.centre));
    const double share = ramp_share(p, from), wanted = cell.count * visible * share;
    // A whole number that rounding has pushed up a little stays what it is; not a number is full detail.
    const double rounded = std::isfinite(wanted) ? std::ceil(wanted - 1e-9 * cell.count) : cell.count;
    out[c].count = static_cast<std::uint32_t>(std::clamp<double>(rounded, 0, cell.count));
    const bool fraction = options.shrinking && out[c].count > 0 && wanted < out[c].count;
    out[c].last = fraction ? static_cast<float>(wanted - (out[c].count - 1)) : 1.0f;
    // Leaves that no one sees projected nothing, so by default only those that the distance takes are made
    // good (erratum P5).
    const double before = total || !std::isfinite(wanted) ? cell.count : cell.count * visible;
    const bool takes = share < 1 || total;
    const double left = fill(cell, out[c], area(cell, before) + (takes ? carried : 0));
    carried = takes ? left : carried;
  }
}

std::size_t FoliageLevels::extract(std::span<const CellLevel> levels, std::span<std::uint32_t> leaves) const {
  std::uint64_t total = 0;
  const std::size_t cells = std::min(levels.size(), cell_count());
  for (std::size_t c = 0; c < cells; ++c) total += std::min(levels[c].count, cells_->cells[c].count);
  if (total > leaves.size()) return 0;
  std::size_t at = 0;
  for (std::size_t c = 0; c < cells; ++c) {
    const FoliageCell& cell = cells_->cells[c];
    const std::size_t count = std::min(levels[c].count, cell.count);
    std::copy_n(cells_->order.begin() + cell.first, count, leaves.begin() + static_cast<std::ptrdiff_t>(at));
    at += count;
  }
  return at;
}

}  // namespace copse
