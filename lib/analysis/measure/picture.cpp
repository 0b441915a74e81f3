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

struct Corner {
  Double3 at;  // pixels, depth
  Float2 uv{};
};

// The pixel centres in [low, high], cut to [0, size): first > last when there are none.
struct Range {
  int first, last;
};

Range centres(double low, double high, int size) {
  const double first = std::ceil(std::max(low, 0.0) - 0.5),
               last = std::floor(std::min(high, double(size)) - 0.5);
  if (!(first <= last)) return {0, -1};
  return {static_cast<int>(std::max(first, 0.0)), static_cast<int>(std::min(last, size - 1.0))};
}

// Where a row at height y crosses the triangle: no pixel outside is looked at.
Range crossing(const std::array<Corner, 3>& t, double y, int width) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (int i = 0; i < 3; ++i) {
    const Double3 &a = t[i].at, &b = t[(i + 1) % 3].at;
    if ((a.y <= y) == (b.y <= y)) continue;
    const double x = a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x);
    low = std::min(low, x), high = std::max(high, x);
  }
  return low <= high ? centres(low, high, width) : Range{0, -1};
}

void draw(const std::array<Corner, 3>& t, std::uint32_t id, const AlphaMask* mask, Samples& out) {
  const Double3 &a = t[0].at, &b = t[1].at, &c = t[2].at;
  const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  if (area == 0 || !std::isfinite(area)) return;
  const Range rows = centres(std::min({a.y, b.y, c.y}), std::max({a.y, b.y, c.y}), out.height);
  for (int y = rows.first; y <= rows.last; ++y) {
    const double py = y + 0.5;
    const Range columns = crossing(t, py, out.width);
    for (int x = columns.first; x <= columns.last; ++x) {
      const double px = x + 0.5;
      const double u = ((b.x - px) * (c.y - py) - (b.y - py) * (c.x - px)) / area;
      const double v = ((c.x - px) * (a.y - py) - (c.y - py) * (a.x - px)) / area;
      const double w = 1 - u - v;
      const auto depth = static_cast<float>(u * a.z + v * b.z + w * c.z);
      const std::size_t i = static_cast<std::size_t>(y) * out.width + x;
      if (!(depth > out.depth[i])) continue;
      if (mask != nullptr && !mask->passes(u * t[0].uv.x + v * t[1].uv.x + w * t[2].uv.x,
                                           u * t[0].uv.y + v * t[1].uv.y + w * t[2].uv.y))
        continue;
      out.depth[i] = depth, out.triangle[i] = id;
    }
  }
}

Samples sample(const DrawnMesh& mesh, const Looks& looks, const OrthographicView& view) {
  Samples out{view.width, view.height, {}, {}};
  const std::size_t n = static_cast<std::size_t>(view.width) * view.height;
  out.depth.assign(n, -std::numeric_limits<float>::infinity());
  out.triangle.assign(n, k_none);
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const std::uint32_t m = mesh.material[i];
    const AlphaMask* mask =
        m < looks.masks.size() && !looks.masks[m].opaque.empty() && !mesh.texcoords.empty() ? &looks.masks[m]
                                                                                            : nullptr;
    std::array<Corner, 3> t;
    for (int c = 0; c < 3; ++c) {
      t[c].at = view.project(mesh.positions[mesh.triangles[i][c]]);
      if (mask != nullptr) t[c].uv = mesh.texcoords[mesh.triangles[i][c]];
    }
    draw(t, i, mask, out);
  }
  return out;
}

Double3 normal_of(const DrawnMesh& mesh, const Triangle& t) {
  if (!mesh.normals.empty()) {
    const Double3 n =
        to_double(mesh.normals[t[0]]) + to_double(mesh.normals[t[1]]) + to_double(mesh.normals[t[2]]);
    if (dot(n, n) > 1e-6) return normalized(n);
  }
  const Double3 a = mesh.positions[t[0]];
  return normalized(cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a));
}

Float3 shade(const DrawnMesh& mesh, const Looks& looks, std::uint32_t triangle) {
  static const Double3 light = normalized({0.35, 0.8, 0.5});
  const double lit = 0.5 + 0.5 * std::abs(dot(normal_of(mesh, mesh.triangles[triangle]), light));
  Float3 base{0.8f, 0.8f, 0.8f};
  if (const std::uint32_t m = mesh.material[triangle]; m < looks.materials.size()) {
    const Material& material = looks.materials[m];
    base = {material.diffuse.x * material.mean_colour.x, material.diffuse.y * material.mean_colour.y,
            material.diffuse.z * material.mean_colour.z};
  }
  return base * static_cast<float>(lit);
}

}  // namespace

Picture draw_picture(const DrawnMesh& mesh, const Looks& looks, const OrthographicView& view, int samples) {
  OrthographicView fine = view;
  fine.width *= samples, fine.height *= samples, fine.pixel /= samples;
  const Samples seen = sample(mesh, looks, fine);

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
          sum += t == k_none ? Float3{1, 1, 1} : shade(mesh, looks, t);
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
