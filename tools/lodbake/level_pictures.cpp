#include "tools/lodbake/level_pictures.h"

#include "lib/analysis/measure/picture_error.h"
#include "lib/analysis/measure/raster.h"
#include "lib/analysis/measure/view_sphere.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <tbb/parallel_for.h>

namespace copse::lodbake {
namespace {

// One of each pair of opposite corners of the icosahedron.
std::vector<Double3> six_sides() {
  std::vector<Double3> sides;
  for (const Double3& d : view_sphere(0).directions) {
    const bool opposite =
        std::any_of(sides.begin(), sides.end(), [&](const Double3& s) { return dot(s, d) < -0.999; });
    if (!opposite) sides.push_back(d);
  }
  return sides;
}

}  // namespace

DrawnMesh drawn_level(const LodSpectra& spectra, const LodLevel& level) {
  DrawnMesh mesh = drawn_state(spectra.trunk, level.trunk_steps);
  append(mesh, drawn_state(spectra.leaves, level.leaf_steps));
  return mesh;
}

LevelPictures::LevelPictures(const LodSpectra& spectra, const Looks& looks)
    : spectra_(spectra), looks_(looks) {
  const DrawnMesh source = drawn_level(spectra, {});
  full_ = static_cast<double>(source.triangles.size());
  const DoubleBox box = bounds(source);
  if (box.empty()) return;
  centre_ = box.centre();
  radius_ = std::max(0.5 * length(box.extent()), 1e-300);
  for (std::size_t i = 0; i < k_sizes.size(); ++i) {
    for (const OrthographicView& view : views(i)) source_[i].push_back(draw_picture(source, looks_, view, 2));
  }
}

std::vector<OrthographicView> LevelPictures::views(std::size_t size) const {
  std::vector<OrthographicView> out;
  for (const Double3& side : six_sides())
    out.push_back(view_of_sphere(centre_, radius_, side, k_sizes[size]));
  return out;
}

double LevelPictures::error(const TriedLevel& level) {
  const double share = static_cast<double>(level.triangles) / std::max(full_, 1.0);
  const std::size_t size = share >= 0.25 ? 0 : share >= 0.05 ? 1 : 2;
  if (source_[size].empty()) return 0;
  // Levels become smaller; those that are tried for one knot have two sizes at most.
  for (std::size_t larger = 0; larger + 1 < size; ++larger) pictures_[larger].reset();
  if (!pictures_[size]) pictures_[size].emplace(spectra_, looks_, views(size));
  const std::vector<Picture> pictures = pictures_[size]->draw(level.trunk_steps, level.leaves);
  std::vector<double> squares(pictures.size());
  tbb::parallel_for(std::size_t{0}, squares.size(), [&](std::size_t i) {
    const double e = picture_rmse(pictures[i], source_[size][i]);
    squares[i] = e * e;
  });
  const double sum = std::accumulate(squares.begin(), squares.end(), 0.0);
  return std::sqrt(sum / static_cast<double>(squares.size()));
}

}  // namespace copse::lodbake
