#include "lib/analysis/ecosystem/terrain_grid.h"

#include "lib/analysis/ecosystem/ground.h"
#include "lib/formats/ecosystem/ecosystem_file.h"

#include <cmath>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

namespace copse {
namespace {

// Relative to the origin; exact at both borders.
std::vector<Double3> regular_grid(const TerrainPlan& p) {
  std::vector<Double3> vertices(std::size_t{p.columns} * p.rows);
  const double sx = p.width / (p.columns - 1), sz = p.depth / (p.rows - 1);
  std::vector<Double3> net;
  if (p.heights) net = sample(*p.heights, p.columns, p.rows);
  const PlantedArea area{0, 0, p.width, p.depth};
  tbb::parallel_for(std::size_t{0}, std::size_t{p.rows}, [&](std::size_t r) {
    for (std::size_t c = 0; c < p.columns; ++c) {
      Double3& v = vertices[r * p.columns + c];
      v = {static_cast<double>(c) * sx, 0, static_cast<double>(r) * sz};
      if (p.heights) v.y = net[r * p.columns + c].y;
      if (p.height_map) v.y = p.low + (p.high - p.low) * smooth_at(*p.height_map, area, v.x, v.z);
    }
  });
  return vertices;
}

Result<void> check_range(const std::vector<Double3>& vertices) {
  constexpr double k_most = 1e9;  // m: squares of it are far from float32's end
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Double3& v = vertices[i];
    if (std::abs(v.x) <= k_most && std::abs(v.y) <= k_most && std::abs(v.z) <= k_most) continue;
    return refuse("", fmt::format("terrain: vertex {} is at ({}, {}, {})", i, v.x, v.y, v.z),
                  "keep the terrain within 1e9 m of its origin");
  }
  return {};
}

}  // namespace

Result<Terrain> make_terrain(const TerrainPlan& plan, const Random& random) {
  if (plan.columns < 2 || plan.rows < 2 || plan.columns > k_max_terrain_side ||
      plan.rows > k_max_terrain_side)
    return refuse("", fmt::format("terrain: {} x {} samples", plan.columns, plan.rows),
                  fmt::format("use 2 to {} each way", k_max_terrain_side));
  for (const auto* surface : {&plan.surface, &plan.heights})
    if (surface->has_value())
      if (const std::string wrong = fault_of(**surface); !wrong.empty())
        return refuse("", "terrain.nurbs: " + wrong, "mend the surface");
  std::vector<Double3> vertices =
      plan.surface ? sample(*plan.surface, plan.columns, plan.rows) : regular_grid(plan);
  apply_faults(vertices, plan.columns, plan.faults, random);
  if (auto sound = check_range(vertices); !sound) return std::unexpected(sound.error());
  Terrain t;
  t.columns = plan.columns;
  t.rows = plan.rows;
  t.origin = plan.origin;
  if (plan.surface) {
    std::vector<Float3> points(vertices.size());
    for (std::size_t i = 0; i < points.size(); ++i) points[i] = to_float(vertices[i]);
    t.points = std::move(points);
  } else {
    t.spacing_x = plan.width / (plan.columns - 1);
    t.spacing_z = plan.depth / (plan.rows - 1);
    std::vector<float> heights(vertices.size());
    for (std::size_t i = 0; i < heights.size(); ++i) heights[i] = static_cast<float>(vertices[i].y);
    t.heights = std::move(heights);
  }
  const TerrainGround ground(t);
  if (!(ground.area() > 0) || !(ground.x1() > ground.x0()) || !(ground.z1() > ground.z0()))
    return refuse("", "terrain: seen from above it has no area, so nothing can be planted on it",
                  "give it an extent along both x and z");
  return t;
}

}  // namespace copse
