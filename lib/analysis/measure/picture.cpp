#include "lib/analysis/measure/picture.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace copse {
namespace {

struct Samples {
  int width, height;
  std::vector<float> depth;
  std::vector<std::uint32_t> triangle;
};

Samples sample(const DrawnMesh& mesh, const Looks& looks, const OrthographicView& view) {
  Samples out{view.width, view.height, {}, {}};
  const std::size_t n = static_cast<std::size_t>(view.width) * view.height;
  out.depth.assign(n, -std::numeric_limits<float>::infinity());
  out.triangle.assign(n, k_none);
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    for_each_sample(
        on_screen(mesh, looks, view, i), view.width, view.height,
        [&](std::size_t pixel, float depth) { return depth > out.depth[pixel]; },
        [&](std::size_t pixel, float depth) { out.depth[pixel] = depth, out.triangle[pixel] = i; });
  }
  return out;
}

Float3 shade(const DrawnMesh& mesh, const Looks& looks, std::uint32_t triangle) {
  const Triangle& t = mesh.triangles[triangle];
  Double3 normals{};
  if (!mesh.normals.empty())
    for (const std::uint32_t v : t) normals += to_double(mesh.normals[v]);
  const std::uint32_t m = mesh.material[triangle];
  return shaded({mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]}, normals,
                m < looks.materials.size() ? &looks.materials[m] : nullptr);
}

}  // namespace

Float3 shaded(const std::array<Double3, 3>& corners, const Double3& normals, const Material* material) {
  static const Double3 light = normalized({0.35, 0.8, 0.5});
  const Double3 normal =
      dot(normals, normals) > 1e-6 ? normals : cross(corners[1] - corners[0], corners[2] - corners[0]);
  const double lit = 0.5 + 0.5 * std::abs(dot(normalized(normal), light));
  Float3 base{0.8f, 0.8f, 0.8f};
  if (material != nullptr)
    base = {material->diffuse.x * material->mean_colour.x, material->diffuse.y * material->mean_colour.y,
            material->diffuse.z * material->mean_colour.z};
  return base * static_cast<float>(lit);
}

Picture draw_picture(const DrawnMesh& mesh, const Looks& looks, const OrthographicView& view, int samples) {
  OrthographicView fine = view;
  fine.width *= samples, fine.height *= samples, fine.pixel /= samples;
  const Samples seen = sample(mesh, looks, fine);

  // Of most triangles many samples are seen, of some none.
  std::vector<Float3> shades(mesh.triangles.size(), {-1, 0, 0});
  const auto shade_of = [&](std::uint32_t t) {
    if (shades[t].x < 0) shades[t] = shade(mesh, looks, t);
    return shades[t];
  };
  Picture out{view.width, view.height, {}, {}};
  const std::size_t n = static_cast<std::size_t>(view.width) * view.height;
  out.colour.resize(n), out.coverage.resize(n);
  const float weight = 1.0f / static_cast<float>(samples * samples);
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      Float3 sum{};
      int hits = 0;
      for (int j = 0; j < samples; ++j) {
        const std::size_t row = static_cast<std::size_t>(y * samples + j) * fine.width + x * samples;
        for (int i = 0; i < samples; ++i) {
          const std::uint32_t t = seen.triangle[row + i];
          sum += t == k_none ? Float3{1, 1, 1} : shade_of(t);
          hits += t != k_none;
        }
      }
      const std::size_t at = static_cast<std::size_t>(y) * view.width + x;
      out.colour[at] = sum * weight;
      out.coverage[at] = static_cast<float>(hits) * weight;
    }
  }
  return out;
}

double covered_pixels(const Picture& picture) {
  double sum = 0;
  for (const float c : picture.coverage) sum += c;
  return sum;
}

}  // namespace copse
