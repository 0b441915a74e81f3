#include "lib/analysis/measure/surface_distance.h"

#include "lib/analysis/measure/triangle_distance.h"
#include "lib/formats/random.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include <tbb/parallel_for.h>

namespace copse {
namespace {

// A binary tree of boxes over triangles, halved at the median: node i's children are 2i + 1 and 2i + 2.
class Nearest {
 public:
  explicit Nearest(const DrawnMesh& mesh) : mesh_(mesh), order_(mesh.triangles.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    std::size_t bottoms = 1;
    while (bottoms * k_bottom < order_.size()) bottoms *= 2;
    nodes_.resize(2 * bottoms - 1);
    nodes_[0].last = static_cast<std::uint32_t>(order_.size());
    for (std::size_t i = 0; i < nodes_.size(); ++i) build(i, i + 1 < bottoms);
  }

  double square(const Double3& p) const {
    double best = std::numeric_limits<double>::infinity();
    std::array<std::uint32_t, 64> stack{};
    int depth = 0;
    if (!order_.empty()) stack[depth++] = 0;
    while (depth > 0) {
      const std::uint32_t i = stack[--depth];
      if (square_distance(p, nodes_[i].box) >= best) continue;
      if (2 * i + 2 >= nodes_.size()) {
        for (std::uint32_t t = nodes_[i].first; t < nodes_[i].last; ++t)
          best = std::min(best, to_triangle(p, order_[t]));
        continue;
      }
      const std::uint32_t l = 2 * i + 1, r = l + 1;
      const bool left = square_distance(p, nodes_[l].box) <= square_distance(p, nodes_[r].box);
      stack[depth++] = left ? r : l, stack[depth++] = left ? l : r;
    }
    return best;
  }

 private:
  static constexpr std::size_t k_bottom = 4;
  struct Node {
    DoubleBox box;
    std::uint32_t first = 0, last = 0;
  };

  double to_triangle(const Double3& p, std::uint32_t t) const {
    const auto& [a, b, c] = mesh_.triangles[t];
    return square_distance(p, mesh_.positions[a], mesh_.positions[b], mesh_.positions[c]);
  }

  void build(std::size_t i, bool inner) {
    Node& node = nodes_[i];
    DoubleBox middles;
    for (std::uint32_t t = node.first; t < node.last; ++t) {
      for (const std::uint32_t v : mesh_.triangles[order_[t]]) node.box.grow(mesh_.positions[v]);
      middles.grow(middle(order_[t]));
    }
    if (!inner) return;
    const Double3 e = middles.extent();
    const int axis = e.x >= e.y && e.x >= e.z ? 0 : e.y >= e.z ? 1 : 2;
    const std::uint32_t half = node.first + (node.last - node.first) / 2;
    std::nth_element(order_.begin() + node.first, order_.begin() + half, order_.begin() + node.last,
                     [&](std::uint32_t s, std::uint32_t t) {
                       const double a = middle(s)[axis], b = middle(t)[axis];
                       return a != b ? a < b : s < t;
                     });
    nodes_[2 * i + 1].first = node.first, nodes_[2 * i + 1].last = half;
    nodes_[2 * i + 2].first = half, nodes_[2 * i + 2].last = node.last;
  }

  Double3 middle(std::uint32_t t) const {
    const auto& [a, b, c] = mesh_.triangles[t];
    return (mesh_.positions[a] + mesh_.positions[b] + mesh_.positions[c]) / 3;
  }

  const DrawnMesh& mesh_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

// One point in each of `samples` equal shares of the area.
std::vector<Double3> spread_points(const DrawnMesh& mesh, std::uint32_t samples, std::uint64_t seed) {
  std::vector<double> sums;
  double sum = 0;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) sums.push_back(sum += area(mesh, t));
  std::vector<Double3> points;
  if (!(sum > 0)) return points;
  const Random root(seed);
  for (std::uint32_t i = 0; i < samples; ++i) {
    Random draw = root.fork(i);
    const double at = (i + draw.uniform()) / samples * sum;
    const auto found = std::upper_bound(sums.begin(), sums.end(), at);
    const auto t = std::min<std::size_t>(found - sums.begin(), sums.size() - 1);
    double u = draw.uniform(), v = draw.uniform();
    if (u + v > 1) u = 1 - u, v = 1 - v;
    const auto& [a, b, c] = mesh.triangles[t];
    const Double3 p = mesh.positions[a];
    points.push_back(p + (mesh.positions[b] - p) * u + (mesh.positions[c] - p) * v);
  }
  return points;
}

SurfaceDistance one_sided(const std::vector<Double3>& points, const Nearest& to) {
  std::vector<double> squares(points.size());
  tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t i) { squares[i] = to.square(points[i]); });
  SurfaceDistance out;
  if (points.empty()) return out;
  const auto n = static_cast<double>(points.size());
  for (const double s : squares) {
    out.mean += std::sqrt(s) / n, out.rms += s / n;
    out.max = std::max(out.max, std::sqrt(s));
  }
  out.rms = std::sqrt(out.rms);
  return out;
}

}  // namespace

SurfaceDistances surface_distance(const DrawnMesh& source, const DrawnMesh& level, std::uint32_t samples,
                                  std::uint64_t seed) {
  return {one_sided(spread_points(level, samples, seed), Nearest(source)),
          one_sided(spread_points(source, samples, seed), Nearest(level))};
}

}  // namespace copse
