#include "lib/analysis/lod/cell_visibility.h"

#include <limits>

#include <tbb/parallel_for.h>

namespace copse {
namespace {

void count(const DrawnMesh& mesh, const Looks& looks, std::span<const std::uint32_t> cell_of,
           const OrthographicView& view, std::span<CellVisibility> out, std::size_t stride) {
  const std::size_t pixels = static_cast<std::size_t>(view.width) * view.height;
  std::vector<float> depth(pixels, -std::numeric_limits<float>::infinity());
  const auto draw = [&](std::uint32_t t, auto&& wants, auto&& see) {
    for_each_sample(on_screen(mesh, looks, view, t), view.width, view.height, wants, see);
  };
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    draw(
        t, [&](std::size_t p, float z) { return z > depth[p]; },
        [&](std::size_t p, float z) { depth[p] = z; });
  }
  // The cell that has counted a pixel already: triangles come cell after cell, so one mark serves all.
  std::vector<std::uint32_t> covered(pixels, k_none), seen(pixels, k_none);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::uint32_t cell = cell_of[t];
    CellVisibility& counts = out[cell * stride];
    draw(
        t, [&](std::size_t p, float z) { return covered[p] != cell || (z >= depth[p] && seen[p] != cell); },
        [&](std::size_t p, float z) {
          if (covered[p] != cell) covered[p] = cell, ++counts.total;
          if (z >= depth[p] && seen[p] != cell) seen[p] = cell, ++counts.visible;
        });
  }
}

}  // namespace

std::vector<CellVisibility> cell_visibility(const DrawnMesh& mesh, const Looks& looks,
                                            std::span<const std::uint32_t> cell_of, std::uint32_t cells,
                                            std::span<const Double3> views, int size) {
  std::vector<CellVisibility> out(std::size_t{cells} * views.size());
  const DoubleBox box = bounds(mesh);
  if (box.empty()) return out;
  double radius = 0;
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t) radius = std::max(radius, distance(mesh.positions[v], box.centre()));
  tbb::parallel_for(std::size_t{0}, views.size(), [&](std::size_t v) {
    count(mesh, looks, cell_of, view_of_sphere(box.centre(), radius, views[v], size),
          std::span(out).subspan(v), views.size());
  });
  return out;
}

}  // namespace copse
