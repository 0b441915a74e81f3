#include "lib/analysis/ecosystem/ground.h"

#include "lib/analysis/ecosystem/tilt.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace copse {
namespace {

using Triangle = std::array<Double3, 3>;

constexpr double k_most_buckets = 4096 * 4096;
constexpr std::uint64_t k_most_entries = 8;  // buckets that a triangle is in, in the mean

// Triangle 2 * cell + 0 is (a, c, d), + 1 is (a, d, b).
Triangle triangle_of(const Terrain& t, std::uint32_t index) {
  const std::uint32_t cell = index / 2, columns = t.columns - 1, c = cell % columns, r = cell / columns;
  const Double3 a = t.vertex(c, r), d = t.vertex(c + 1, r + 1);
  if (index % 2 == 0) return {a, t.vertex(c, r + 1), d};
  return {a, d, t.vertex(c + 1, r)};
}

// Twice the area seen from above, positive when it faces up.
double doubled_area(const Triangle& t) {
  const Double3 u = t[1] - t[0], v = t[2] - t[0];
  return u.z * v.x - u.x * v.z;
}

std::uint32_t bucket(double at, double low, double high, std::uint32_t count) {
  const double f = high > low ? (at - low) / (high - low) * count : 0;
  return static_cast<std::uint32_t>(std::clamp(f, 0.0, count - 1.0));
}

}  // namespace

TerrainGround::TerrainGround(const Terrain& terrain) : terrain_(terrain) {
  if (terrain.columns == 0) return;
  if (terrain.regular()) {
    x0_ = terrain.origin.x;
    z0_ = terrain.origin.z;
    x1_ = x0_ + terrain.spacing_x * (terrain.columns - 1);
    z1_ = z0_ + terrain.spacing_z * (terrain.rows - 1);
    return;
  }
  DoubleBox box;
  for (const Float3& p : terrain.points) box.grow(terrain.origin + to_double(p));
  x0_ = box.min.x, z0_ = box.min.z, x1_ = box.max.x, z1_ = box.max.z;
  fill_buckets();
}

std::array<std::uint32_t, 4> TerrainGround::buckets_of(const Triangle& t) const {
  if (doubled_area(t) == 0) return {};
  const auto [xl, xh] = std::minmax({t[0].x, t[1].x, t[2].x});
  const auto [zl, zh] = std::minmax({t[0].z, t[1].z, t[2].z});
  return {bucket(xl, x0_, x1_, across_), bucket(zl, z0_, z1_, down_), bucket(xh, x0_, x1_, across_) + 1,
          bucket(zh, z0_, z1_, down_) + 1};
}

// Square ones, about one a cell of the surface; fewer where triangles lie one over another in so many that
// they would be in too many buckets.
void TerrainGround::choose_buckets(std::uint32_t triangles) {
  const double width = x1_ - x0_, depth = z1_ - z0_, cells = std::min(triangles / 2.0, k_most_buckets);
  const auto count = [&](double side, double other) {
    if (!(side > 0)) return 1u;
    const double wanted = other > 0 ? std::sqrt(cells * (side / other)) : cells;
    return static_cast<std::uint32_t>(std::clamp(wanted, 1.0, std::max(1.0, cells)));
  };
  across_ = count(width, depth), down_ = count(depth, width);
  const auto entries = [&] {
    std::uint64_t sum = 0;
    for (std::uint32_t i = 0; i < triangles; ++i) {
      const auto [c0, r0, c1, r1] = buckets_of(triangle_of(terrain_, i));
      sum += std::uint64_t{c1 - c0} * (r1 - r0);
    }
    return sum;
  };
  while (across_ * down_ > 1 && entries() > k_most_entries * triangles)
    (across_ > down_ ? across_ : down_) = (std::max(across_, down_) + 1) / 2;
}

void TerrainGround::fill_buckets() {
  const std::uint32_t count = 2 * (terrain_.columns - 1) * (terrain_.rows - 1);
  choose_buckets(count);
  const auto visit = [&](std::uint32_t i, auto&& action) {
    const auto [c0, r0, c1, r1] = buckets_of(triangle_of(terrain_, i));
    for (std::uint32_t r = r0; r < r1; ++r)
      for (std::uint32_t c = c0; c < c1; ++c) action(r * across_ + c);
  };
  first_.assign(std::size_t{across_} * down_ + 1, 0);
  for (std::uint32_t i = 0; i < count; ++i) visit(i, [&](std::size_t b) { ++first_[b + 1]; });
  for (std::size_t b = 1; b < first_.size(); ++b) first_[b] += first_[b - 1];
  triangles_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::uint32_t i = 0; i < count; ++i) visit(i, [&](std::size_t b) { triangles_[next[b]++] = i; });
}

double TerrainGround::area() const {
  if (terrain_.columns == 0) return 0;
  if (terrain_.regular()) return (x1_ - x0_) * (z1_ - z0_);
  double sum = 0;
  const std::uint32_t count = 2 * (terrain_.columns - 1) * (terrain_.rows - 1);
  for (std::uint32_t i = 0; i < count; ++i) sum += std::abs(doubled_area(triangle_of(terrain_, i))) / 2;
  return sum;
}

std::optional<GroundPoint> TerrainGround::at(double x, double z) const {
  if (terrain_.columns == 0) return std::nullopt;
  if (terrain_.regular()) return at_regular(x, z);
  return at_free(x, z);
}

bool TerrainGround::covers(double x, double z) const {
  return x >= x0_ && x <= x1_ && z >= z0_ && z <= z1_ && at(x, z).has_value();
}

GroundPoint TerrainGround::at_regular(double x, double z) const {
  const Terrain& t = terrain_;
  const double u = std::clamp((x - t.origin.x) / t.spacing_x, 0.0, t.columns - 1.0);
  const double v = std::clamp((z - t.origin.z) / t.spacing_z, 0.0, t.rows - 1.0);
  const auto c = std::min(static_cast<std::uint32_t>(u), t.columns - 2);
  const auto r = std::min(static_cast<std::uint32_t>(v), t.rows - 2);
  const double fu = u - c, fv = v - r;
  const std::size_t at = std::size_t{r} * t.columns + c;
  const double ya = t.heights[at], yb = t.heights[at + 1], yc = t.heights[at + t.columns],
               yd = t.heights[at + t.columns + 1];
  // (a, c, d) is the half where v runs ahead of u.
  const bool lower = fv >= fu;
  const double along = lower ? yd - yc : yb - ya, down = lower ? yc - ya : yd - yb;
  return {t.origin.y + (ya + fu * along + fv * down), upward({-along / t.spacing_x, 1, -down / t.spacing_z})};
}

std::optional<GroundPoint> TerrainGround::at_free(double x, double z) const {
  if (first_.empty() || !(x >= x0_ && x <= x1_ && z >= z0_ && z <= z1_)) return std::nullopt;
  const std::size_t b = std::size_t{bucket(z, z0_, z1_, down_)} * across_ + bucket(x, x0_, x1_, across_);
  std::optional<GroundPoint> best;
  for (std::uint32_t i = first_[b]; i < first_[b + 1]; ++i) {
    const Triangle t = triangle_of(terrain_, triangles_[i]);
    const double area = doubled_area(t);
    const Double3 p{x, 0, z};
    // Barycentric weights; what lies on an edge belongs to both sides, within rounding.
    std::array<double, 3> w{};
    bool inside = true;
    for (std::size_t k = 0; k < 3; ++k) {
      w[k] = doubled_area({p, t[(k + 1) % 3], t[(k + 2) % 3]}) / area;
      inside &= w[k] >= -1e-12;
    }
    if (!inside) continue;
    const double height = w[0] * t[0].y + w[1] * t[1].y + w[2] * t[2].y;
    if (!best || height > best->height) best = GroundPoint{height, upward(cross(t[1] - t[0], t[2] - t[0]))};
  }
  return best;
}

GroundPoint GroundBeside::at(double x, double z) {
  if (const auto here = ground_.at(x, z)) return *here;
  if (terrain_.columns == 0) return {};
  if (!nearest_) {
    vertices_.reserve(terrain_.vertex_count());
    for (std::uint32_t r = 0; r < terrain_.rows; ++r)
      for (std::uint32_t c = 0; c < terrain_.columns; ++c) {
        const Double3 v = terrain_.vertex(c, r);
        vertices_.push_back({v.x, 0, v.z});
      }
    nearest_.emplace(vertices_);
  }
  const std::uint32_t v = nearest_->nearest({x, 0, z});
  if (v == k_none) return {};
  // A vertex of nothing but upright triangles has no ground of its own.
  const GroundPoint lone{terrain_.vertex(v % terrain_.columns, v / terrain_.columns).y, {0, 1, 0}};
  return ground_.at(vertices_[v].x, vertices_[v].z).value_or(lone);
}

}  // namespace copse
