#include "tools/treeplay/forest.h"

#include "lib/formats/ecosystem/terrain_normal.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

namespace copse::treeplay {

namespace {

// Times the terrain's own size; beyond the last one all is haze.
constexpr std::array<double, 7> k_surroundings{1.02, 1.1, 1.4, 2.5, 6, 18, 60};

// `p` as vertices are: relative to the origin.
Float2 texcoord(const Double3& p, const Double3& origin, const Terrain& terrain) {
  const double size = double{terrain.texture_size};
  return {static_cast<float>((p.x + origin.x) / size), static_cast<float>(-(p.z + origin.z) / size)};
}

}  // namespace

Float3 moved(const DrawCopy& copy, const Float3& p) {
  const auto row = [&](const Float4& r) { return r.x * p.x + r.y * p.y + r.z * p.z + r.w; };
  return {row(copy.rows[0]), row(copy.rows[1]), row(copy.rows[2])};
}

std::optional<double> ground_height(const Terrain& t, double x, double z) {
  if (t.columns == 0 || !t.regular()) return std::nullopt;
  const double u = std::clamp((x - t.origin.x) / t.spacing_x, 0.0, t.columns - 1.0),
               v = std::clamp((z - t.origin.z) / t.spacing_z, 0.0, t.rows - 1.0);
  const auto c = std::min(static_cast<std::uint32_t>(u), t.columns - 2),
             r = std::min(static_cast<std::uint32_t>(v), t.rows - 2);
  const double i = u - c, k = v - r;
  const double a = t.vertex(c, r).y, b = t.vertex(c + 1, r).y, d = t.vertex(c, r + 1).y,
               e = t.vertex(c + 1, r + 1).y;
  return i >= k ? a * (1 - i) + b * (i - k) + e * k : a * (1 - k) + d * (k - i) + e * i;
}

namespace {

// Where a vertical line meets a triangle, seen from above; none when it passes or the triangle stands
// upright.
std::optional<double> height_in(const Double3& a, const Double3& b, const Double3& c, double x, double z) {
  const double area = (b.x - a.x) * (c.z - a.z) - (c.x - a.x) * (b.z - a.z);
  if (area == 0 || !std::isfinite(area)) return std::nullopt;
  const double v = ((x - a.x) * (c.z - a.z) - (c.x - a.x) * (z - a.z)) / area,
               w = ((b.x - a.x) * (z - a.z) - (x - a.x) * (b.z - a.z)) / area;
  // A line through an edge meets one of its two triangles, whatever rounding says.
  constexpr double k_edge = -1e-12;
  if (v < k_edge || w < k_edge || v + w > 1 - k_edge) return std::nullopt;
  return a.y + v * (b.y - a.y) + w * (c.y - a.y);
}

}  // namespace

std::optional<double> highest_ground(const Terrain& t, double x, double z) {
  if (t.columns == 0 || t.regular()) return ground_height(t, x, z);
  std::optional<double> highest;
  for (std::uint32_t r = 0; r + 1 < t.rows; ++r)
    for (std::uint32_t c = 0; c + 1 < t.columns; ++c) {
      const Double3 a = t.vertex(c, r), b = t.vertex(c + 1, r), d = t.vertex(c, r + 1),
                    e = t.vertex(c + 1, r + 1);
      for (const auto& height : {height_in(a, d, e, x, z), height_in(a, e, b, x, z)})
        if (height && (!highest || *height > *highest)) highest = height;
    }
  return highest;
}

ForestGround::ForestGround(const Terrain& terrain, const Double3& origin, TreeGeometry& geometry)
    : columns_(terrain.columns),
      rows_(terrain.rows),
      material_(terrain.material),
      first_(static_cast<std::uint32_t>(geometry.vertices.size())) {
  if (empty()) return;
  geometry.vertices.resize(geometry.vertices.size() + terrain.vertex_count());
  const auto take_row = [&](std::uint32_t r) {
    for (std::uint32_t c = 0; c < columns_; ++c) {
      const Double3 p = terrain.vertex(c, r) - origin;
      geometry.vertices[first_ + std::size_t{r} * columns_ + c] = {
          to_float(p), to_float(terrain_normal(terrain, c, r)), texcoord(p, origin, terrain)};
    }
  };
  tbb::parallel_invoke([&] { tiles_ = TerrainTiles(terrain); },
                       [&] { tbb::parallel_for(std::uint32_t{0}, rows_, take_row); });
  first_ring_ = static_cast<std::uint32_t>(geometry.vertices.size());
  add_surroundings(geometry, terrain);
}

std::uint64_t ForestGround::triangles() const {
  return empty() ? 0 : 2 * std::uint64_t{columns_ - 1} * (rows_ - 1);
}

// Every vertex of the border, once round, in the order of TerrainTiles::append_border.
std::vector<std::uint32_t> ForestGround::whole_border() const {
  std::vector<std::uint32_t> ring;
  for (std::uint32_t c = 0; c + 1 < columns_; ++c) ring.push_back(c);
  for (std::uint32_t r = 0; r + 1 < rows_; ++r) ring.push_back(r * columns_ + columns_ - 1);
  for (std::uint32_t c = columns_ - 1; c > 0; --c) ring.push_back((rows_ - 1) * columns_ + c);
  for (std::uint32_t r = rows_ - 1; r > 0; --r) ring.push_back(r * columns_);
  return ring;
}

// Its number in that order.
std::uint32_t ForestGround::place_on_border(std::uint32_t vertex) const {
  const std::uint32_t c = vertex % columns_, r = vertex / columns_, w = columns_ - 1, h = rows_ - 1;
  if (r == 0) return c;
  if (c == w) return w + r;
  return r == h ? w + h + (w - c) : 2 * w + h + (h - r);
}

void ForestGround::add_surroundings(TreeGeometry& geometry, const Terrain& terrain) {
  const std::vector<std::uint32_t> ring = whole_border();
  Double3 middle;
  for (const std::uint32_t i : ring)
    middle += to_double(geometry.vertices[first_ + i].position) / static_cast<double>(ring.size());
  for (const double factor : k_surroundings)
    for (const std::uint32_t i : ring) {
      const Double3 p = to_double(geometry.vertices[first_ + i].position),
                    out = middle + (p - middle) * factor;
      // Half as high above the middle at twice the distance, and so on.
      const Double3 at{out.x, middle.y + (p.y - middle.y) / (factor * factor), out.z};
      geometry.vertices.push_back({to_float(at), {0, 1, 0}, texcoord(at, geometry.origin, terrain)});
    }
}

void ForestGround::append(const Frustum& frustum, const Double3& eye,
                          std::vector<std::uint32_t>& indices) const {
  if (empty()) return;
  const std::size_t begin = indices.size();
  tiles_.append(frustum, eye, indices);
  for (std::size_t i = begin; i < indices.size(); ++i) indices[i] += first_;
  std::vector<std::uint32_t> border;
  tiles_.append_border(border);
  const std::uint32_t ring = 2 * (columns_ - 1 + rows_ - 1);
  for (std::uint32_t k = 0; k < k_surroundings.size(); ++k)
    for (std::size_t i = 0; i < border.size(); ++i) {
      const std::uint32_t here = border[i], next = border[(i + 1) % border.size()];
      const auto outer = [&](std::uint32_t v) { return first_ring_ + k * ring + place_on_border(v); };
      const auto inner = [&](std::uint32_t v) { return k == 0 ? first_ + v : outer(v) - ring; };
      for (const std::uint32_t v :
           {inner(here), inner(next), outer(next), inner(here), outer(next), outer(here)})
        indices.push_back(v);
    }
}

}  // namespace copse::treeplay
