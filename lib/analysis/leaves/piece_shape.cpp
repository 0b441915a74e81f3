#include "lib/analysis/leaves/piece_shape.h"

#include "lib/analysis/surface/components.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <vector>

#include <Eigen/Eigenvalues>

namespace copse {
namespace {

// A flat sheet has at least 12.6, an open tube longer than 3 radii at most 8.4; trees measured: sheets 13.7
// to 32, tubes and lumps up to 2.7.
constexpr double k_sheet_border = 8;
// |sum of area vectors| / area: 1 for a flat sheet, about 0.8 for fronds, near 0 for a short tube.
constexpr double k_sheet_opening = 0.2;
// Share of the surface that faces along one axis: 1 for a plate, 1/2 for a tube, 1/3 for a ball.
constexpr double k_plate_facing = 0.75;
// 36 pi V^2 / A^3 is 1 for a ball, 4e-4 for a twig a thousand times as long as thick, 0 for a double layer.
constexpr double k_no_volume = 1e-8;
// Spread along the first axis over the second. Blobs measured: up to 1.3; the stubbiest trunk: 2.3.
constexpr double k_stem_elongation = 1.8;
// Bent and branching stems fill little of their ellipsoid; hollow tiers of a conifer at least 0.19.
constexpr double k_stem_fill = 0.1;
// Pieces of fewer triangles are not asked how many borders they have: cards, most of a foliage.
constexpr std::size_t k_one_border = 16;
constexpr double k_planar_cosine = 1 - 1e-6;

// Coordinates are about 1 here: squares are safe, and much cheaper than length().
double norm(const Double3& a) {
  return std::sqrt(dot(a, a));
}

// Sums over the triangles of a piece, relative to its box's centre and in units of its size.
struct Sums {
  double area = 0, border = 0, volume = 0;
  Double3 area_vector, moment;
  std::array<double, 6> spread{};  // xx xy xz yy yz zz of the corners, weighted by area
  std::array<double, 6> facing{};  // the same of the normals
  Double3 first_normal;
  bool planar = true, non_manifold = false;
};

void add_product(std::array<double, 6>& m, const Double3& a, double weight) {
  m[0] += weight * a.x * a.x, m[1] += weight * a.x * a.y, m[2] += weight * a.x * a.z;
  m[3] += weight * a.y * a.y, m[4] += weight * a.y * a.z, m[5] += weight * a.z * a.z;
}

class Reader {
 public:
  Reader(const Mesh& mesh, std::span<const std::uint32_t> triangles) : mesh_(mesh), triangles_(triangles) {
    for (const std::uint32_t t : triangles) {
      for (const std::uint32_t v : mesh.triangles[t]) box_.grow(mesh.positions[v]);
    }
    const Double3 half = box_.max * 0.5 - box_.min * 0.5;
    centre_ = box_.min + half;
    const double reach = std::max({half.x, half.y, half.z});
    // A power of two: scaling rounds nothing, and cubes of lengths stay in range.
    if (reach > 0) scale_ = std::ldexp(1.0, std::clamp(-std::ilogb(reach), -1000, 1000));
  }

  const DoubleBox& box() const { return box_; }
  double scale() const { return scale_; }
  Double3 at(std::uint32_t vertex) const { return (mesh_.positions[vertex] - centre_) * scale_; }

  // What tells a card, and everything else that bending does not change.
  Sums read_surface(std::span<const std::uint8_t> edges) const {
    Sums sums;
    for (const std::uint32_t t : triangles_) {
      const std::array<Double3, 3> p{at(mesh_.triangles[t][0]), at(mesh_.triangles[t][1]),
                                     at(mesh_.triangles[t][2])};
      add_triangle(p, sums);
      sums.volume += dot(cross(p[0], p[1]), p[2]) / 6;
      for (int e = 0; e < 3; ++e) {
        if (edges[t] & Pieces::border_0 << e) sums.border += norm(p[(e + 1) % 3] - p[e]);
      }
      sums.non_manifold |= (edges[t] & Pieces::non_manifold) != 0;
    }
    return sums;
  }

  void read_spread(Sums& sums) const {
    for (const std::uint32_t t : triangles_) {
      const std::array<Double3, 3> p{at(mesh_.triangles[t][0]), at(mesh_.triangles[t][1]),
                                     at(mesh_.triangles[t][2])};
      const Double3 normal = cross(p[1] - p[0], p[2] - p[0]) * 0.5;
      const double area = norm(normal);
      if (!(area > 0)) continue;
      add_product(sums.facing, normal, 1 / area);
      for (const Double3& corner : p) {
        add_product(sums.spread, corner, area / 3);
        sums.moment += corner * (area / 3);
      }
    }
  }

  // Extents of the corners along three axes.
  Double3 extents(const Eigen::Matrix3d& axes) const {
    DoubleBox box;
    for (const std::uint32_t t : triangles_) {
      for (const std::uint32_t v : mesh_.triangles[t]) {
        const Double3 p = at(v);
        const Eigen::Vector3d along = axes.transpose() * Eigen::Vector3d(p.x, p.y, p.z);
        box.grow(Double3{along.x(), along.y(), along.z()});
      }
    }
    return box.extent();
  }

 private:
  static void add_triangle(const std::array<Double3, 3>& p, Sums& sums) {
    const Double3 normal = cross(p[1] - p[0], p[2] - p[0]) * 0.5;
    const double area = norm(normal);
    if (!(area > 0)) return;
    sums.area += area;
    sums.area_vector += normal;
    if (dot(sums.first_normal, sums.first_normal) == 0) sums.first_normal = normal / area;
    sums.planar = sums.planar && std::abs(dot(sums.first_normal, normal)) >= k_planar_cosine * area;
  }

  const Mesh& mesh_;
  std::span<const std::uint32_t> triangles_;
  DoubleBox box_;
  Double3 centre_;
  double scale_ = 1;
};

Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(const std::array<double, 6>& m) {
  Eigen::Matrix3d matrix;
  matrix << m[0], m[1], m[2], m[1], m[3], m[4], m[2], m[4], m[5];
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(matrix);
  return solver;
}

// One triangle of each set of three corners, and the border of what is left.
struct SingleLayer {
  std::vector<std::uint32_t> triangles;
  double border = 0;
};

SingleLayer single_layer(const Mesh& mesh, std::span<const std::uint32_t> welded,
                         std::span<const std::uint32_t> triangles, const Reader& reader) {
  struct Corners {
    Triangle v;
    std::uint32_t triangle;
    auto operator<=>(const Corners&) const = default;
  };
  std::vector<Corners> sorted;
  for (const std::uint32_t t : triangles) {
    const Triangle& v = mesh.triangles[t];
    Triangle corners{welded[v[0]], welded[v[1]], welded[v[2]]};
    std::sort(corners.begin(), corners.end());
    sorted.push_back({corners, t});
  }
  std::sort(sorted.begin(), sorted.end());
  SingleLayer layer;
  std::vector<std::array<std::uint32_t, 2>> edges;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    if (i > 0 && sorted[i].v == sorted[i - 1].v) continue;
    layer.triangles.push_back(sorted[i].triangle);
    const Triangle& v = sorted[i].v;
    for (const auto& edge : {std::array{v[0], v[1]}, std::array{v[1], v[2]}, std::array{v[0], v[2]}}) {
      if (edge[0] != edge[1]) edges.push_back(edge);
    }
  }
  std::sort(edges.begin(), edges.end());
  for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    while (end < edges.size() && edges[end] == edges[begin]) ++end;
    if (end - begin == 1) layer.border += norm(reader.at(edges[begin][1]) - reader.at(edges[begin][0]));
  }
  return layer;
}

double roundness(const Sums& sums) {  // 36 pi V^2 / A^3
  return 36 * std::numbers::pi * sums.volume * sums.volume / (sums.area * sums.area * sums.area);
}

// The sum of the squared lengths of all borders. A tree in one surface has a thousand tips, open each: their
// borders together are as long as a sheet's, one by one they are short.
double squared_borders(const Mesh& mesh, std::span<const std::uint32_t> welded, const Pieces& pieces,
                       std::span<const std::uint32_t> triangles, const Reader& reader) {
  struct Edge {
    std::uint32_t a, b;
    double length;
  };
  std::vector<Edge> edges;
  std::vector<std::uint32_t> vertices;
  for (const std::uint32_t t : triangles) {
    for (int e = 0; e < 3; ++e) {
      if (!(pieces.edges[t] & Pieces::border_0 << e)) continue;
      const std::uint32_t a = mesh.triangles[t][e], b = mesh.triangles[t][(e + 1) % 3];
      edges.push_back({welded[a], welded[b], norm(reader.at(b) - reader.at(a))});
      vertices.insert(vertices.end(), {welded[a], welded[b]});
    }
  }
  std::ranges::sort(vertices);
  const auto repeated = std::ranges::unique(vertices);
  vertices.erase(repeated.begin(), repeated.end());
  const auto number = [&](std::uint32_t v) {
    return static_cast<std::uint32_t>(std::ranges::lower_bound(vertices, v) - vertices.begin());
  };
  UnionFind borders(vertices.size());
  for (const Edge& e : edges) borders.unite(number(e.a), number(e.b));
  std::vector<double> lengths(vertices.size(), 0);
  for (const Edge& e : edges) lengths[borders.find(number(e.a))] += e.length;
  double sum = 0;
  for (const double l : lengths) sum += l * l;
  return sum;
}

// Sheets of one layer, told without looking at their axes: nearly all of a foliage ends here.
bool is_single_sheet(const Sums& sums, double squared_border) {
  if (squared_border < k_sheet_border * sums.area) return false;
  return sums.non_manifold || norm(sums.area_vector) >= k_sheet_opening * sums.area;
}

void judge_solid(const Reader& reader, Sums& sums, PieceShape& shape) {
  reader.read_spread(sums);
  const double facing = principal(sums.facing).eigenvalues()[2] / sums.area;
  if (facing >= k_plate_facing) {
    shape.kind = ShapeKind::sheet;
    shape.solid = true;
    return;
  }
  const Double3 mean = sums.moment / sums.area;
  add_product(sums.spread, mean, -sums.area);
  const auto axes = principal(sums.spread);
  const double second = axes.eigenvalues()[1];
  shape.elongation = second > 0 ? std::sqrt(axes.eigenvalues()[2] / second) : 1 / k_no_volume;
  const Double3 extent = reader.extents(axes.eigenvectors());
  const double ellipsoid = extent.x * extent.y * extent.z * std::numbers::pi / 6;
  const double volume = std::abs(sums.volume);
  shape.fill = ellipsoid > 0 ? volume / ellipsoid : 0;
  const bool stem = shape.elongation >= k_stem_elongation || shape.fill <= k_stem_fill;
  shape.kind = stem ? ShapeKind::stem : ShapeKind::blob;
}

}  // namespace

PieceShape shape_of(const Mesh& mesh, std::span<const std::uint32_t> welded, const Pieces& pieces,
                    std::span<const std::uint32_t> triangles) {
  const Reader reader(mesh, triangles);
  Sums sums = reader.read_surface(pieces.edges);
  PieceShape shape;
  shape.box = reader.box();
  shape.size = length(shape.box.extent());
  shape.area = sums.area / reader.scale() / reader.scale();
  if (!(sums.area > 0)) return shape;  // a line or a point: as good as a sheet
  shape.planar = sums.planar;
  double squared_border = sums.border * sums.border;
  if (!sums.planar && triangles.size() >= k_one_border && squared_border >= k_sheet_border * sums.area) {
    squared_border = squared_borders(mesh, welded, pieces, triangles, reader);
  }
  shape.border_ratio = squared_border / sums.area;
  if (sums.planar || is_single_sheet(sums, squared_border)) return shape;
  if (sums.border == 0 && roundness(sums) < k_no_volume) {
    const SingleLayer layer = single_layer(mesh, welded, triangles, reader);
    const Reader single(mesh, layer.triangles);
    sums = single.read_surface(pieces.edges);
    sums.border = layer.border / reader.scale() * single.scale();
    if (sums.border * sums.border >= k_sheet_border * sums.area) return shape;
    judge_solid(single, sums, shape);
    return shape;
  }
  judge_solid(reader, sums, shape);
  return shape;
}

}  // namespace copse
