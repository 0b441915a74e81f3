#include "tests/trunk/welded_meshes.h"

#include "lib/analysis/surface/components.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <set>

namespace copse {

namespace {

using Ids = std::vector<std::uint32_t>;
constexpr double k_pi = std::numbers::pi;

struct Builder {
  WeldedMesh out;
  std::mt19937 random;

  std::uint32_t add(const Double3& p) {
    out.mesh.positions.push_back(p);
    return static_cast<std::uint32_t>(out.mesh.positions.size() - 1);
  }
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    out.mesh.source.push_back(static_cast<std::uint32_t>(out.mesh.triangles.size()));
    out.mesh.piece.push_back(0);
    out.mesh.triangles.push_back({a, b, c});
  }
  void quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    if (random() % 2 == 0) {
      triangle(a, b, c), triangle(a, c, d);
    } else {
      triangle(a, b, d), triangle(b, c, d);
    }
  }
  // Joins two rings of the same size and sense, the second one turned to lie best, then by `twist`.
  void band(const Ids& from, const Ids& to, int twist) {
    const std::size_t k = from.size();
    std::size_t best = 0;
    double least = INFINITY;
    for (std::size_t o = 0; o < k; ++o) {
      double sum = 0;
      for (std::size_t i = 0; i < k; ++i) {
        sum += distance(out.mesh.positions[from[i]], out.mesh.positions[to[(i + o) % k]]);
      }
      if (sum < least) least = sum, best = o;
    }
    best = (best + k + static_cast<std::size_t>(twist + static_cast<int>(k))) % k;
    for (std::size_t i = 0; i < k; ++i) {
      quad(from[i], from[(i + 1) % k], to[(i + 1 + best) % k], to[(i + best) % k]);
    }
  }
  TrueRing ring(const Ids& ids, std::uint32_t parent) const {
    TrueRing r{{}, 0, parent};
    for (const auto v : ids) r.centre += out.mesh.positions[v] / static_cast<double>(ids.size());
    for (const auto v : ids) {
      r.diameter += 2 * distance(out.mesh.positions[v], r.centre) / static_cast<double>(ids.size());
    }
    return r;
  }
};

struct ForkGrower : Builder {
  ForkTree shape;

  double uniform(double a, double b) { return a + (b - a) * static_cast<double>(random() % 65536) / 65536; }
  int twist() {
    return shape.twist == 0 ? 0 : static_cast<int>(random() % (2 * shape.twist + 1)) - shape.twist;
  }

  // The limb that starts in `start` at the fork `from` and runs along `d`.
  void limb(const Ids& start, const Double3& from, const Double3& d, double radius, std::uint32_t parent,
            int left) {
    if (left == 0) {
      const std::uint32_t tip = add(from + d * (shape.tip_length * radius));
      for (std::size_t i = 0; i < start.size(); ++i) triangle(start[i], start[(i + 1) % start.size()], tip);
      out.rings.push_back({out.mesh.positions[tip], 0, parent});
      return;
    }
    const Double3 head = from + d * (radius * uniform(6, 12));
    // The plane in which the limb forks: `along` goes through both shared vertices, `side` to the first limb.
    const Double3 any = std::abs(d.x) < 0.5 ? Double3{1, 0, 0} : Double3{0, 0, 1};
    const Double3 u = normalized(cross(d, any)), v = cross(d, u);
    const double turn = uniform(0, 2 * k_pi);
    const Double3 along = u * std::cos(turn) + v * std::sin(turn), side = cross(d, along);
    const std::size_t half = shape.sides / 2;
    Ids first, second, third;  // the arcs between the shared vertices
    const std::uint32_t l0 = add(head + along * radius);
    const auto arc = [&](Ids& ids, const Double3& towards, double height) {
      for (std::size_t i = 1; i < half; ++i) {
        const double a = k_pi * static_cast<double>(i) / static_cast<double>(half);
        ids.push_back(
            add(head + along * (radius * std::cos(a)) + towards * (radius * std::sin(a)) + d * height));
      }
    };
    arc(first, side, -0.2 * radius);
    const std::uint32_t l1 = add(head - along * radius);
    arc(second, -side, -0.3 * radius);
    arc(third, d, 0);
    std::ranges::reverse(second);
    const auto cycle = [&](const Ids& go, const Ids& back) {
      Ids ids{l0};
      ids.insert(ids.end(), go.begin(), go.end());
      ids.push_back(l1);
      ids.insert(ids.end(), back.begin(), back.end());
      return ids;
    };
    const Ids back_third(third.rbegin(), third.rend()), back_first(first.rbegin(), first.rend());
    const Ids end = cycle(first, second);
    band(start, end, twist());
    out.rings.push_back(ring(end, parent));
    const auto here = static_cast<std::uint32_t>(out.rings.size() - 1);
    const double lean = uniform(0.4, 0.8);
    limb(cycle(first, back_third), head, normalized(d + side * lean), 0.75 * radius, here, left - 1);
    limb(cycle(third, second), head, normalized(d - side * lean), 0.7 * radius, here, left - 1);
  }
};

}  // namespace

WeldedMesh fork_tree(const ForkTree& shape) {
  ForkGrower g;
  g.shape = shape;
  g.random.seed(shape.seed);
  Ids root;
  for (std::uint32_t i = 0; i < shape.sides; ++i) {
    const double a = 2 * k_pi * i / shape.sides;
    root.push_back(g.add({std::cos(a), 0, -std::sin(a)}));
  }
  g.out.rings.push_back(g.ring(root, k_none));
  g.limb(root, {0, 0, 0}, {0, 1, 0}, 1, 0, shape.depth);
  return std::move(g.out);
}

WeldedMesh seated_limbs(int rings, std::span<const int> seats, int limb_rings) {
  Builder b;
  b.random.seed(7);
  std::vector<Ids> trunk;
  for (int r = 0; r < rings; ++r) {
    Ids ids;
    for (int i = 0; i < 8; ++i) {
      const double a = 2 * k_pi * i / 8, radius = 1 - 0.02 * r;
      ids.push_back(b.add({radius * std::cos(a), 0.8 * r, -radius * std::sin(a)}));
    }
    b.out.rings.push_back(b.ring(ids, r == 0 ? k_none : static_cast<std::uint32_t>(r - 1)));
    trunk.push_back(ids);
  }
  for (int r = 0; r + 1 < rings; ++r) {
    const Ids &low = trunk[static_cast<std::size_t>(r)], &high = trunk[static_cast<std::size_t>(r + 1)];
    const bool seat = std::ranges::count(seats, r) > 0;
    const std::size_t hole = seat ? static_cast<std::size_t>(3 * r) % 8 : 8;
    for (std::size_t i = 0; i < 8; ++i) {
      const std::size_t j = (i + 1) % 8;
      if (i != hole) b.quad(low[i], low[j], high[j], high[i]);
    }
    if (!seat) continue;
    Ids ring{low[hole], low[(hole + 1) % 8], high[(hole + 1) % 8], high[hole]};
    const TrueRing base = b.ring(ring, k_none);
    const Double3 out = normalized({base.centre.x, 0, base.centre.z});
    for (int n = 0; n < limb_rings; ++n) {
      Ids next;
      for (const auto v : ring) {
        const Double3 p = b.out.mesh.positions[v];
        next.push_back(
            b.add(base.centre + out * (0.5 * (n + 1)) + (p - base.centre - out * (0.5 * n)) * 0.95));
      }
      for (std::size_t i = 0; i < 4; ++i) b.quad(ring[i], ring[(i + 1) % 4], next[(i + 1) % 4], next[i]);
      const auto last = static_cast<std::uint32_t>(b.out.rings.size() - 1);
      b.out.rings.push_back(b.ring(next, n == 0 ? static_cast<std::uint32_t>(r) : last));
      ring = next;
    }
  }
  return std::move(b.out);
}

TrunkMesh torus(int around, int sides, double large, double small) {
  Builder b;
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < sides; ++j) {
      const double a = 2 * k_pi * i / around, c = 2 * k_pi * j / sides, r = large + small * std::cos(c);
      b.add({r * std::cos(a), r * std::sin(a), small * std::sin(c)});
    }
  }
  const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(i % around * sides + j % sides); };
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < sides; ++j) b.quad(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
  }
  return std::move(b.out.mesh);
}

TrunkMesh sphere(int rings, int sides, double radius) {
  Builder b;
  std::vector<Ids> all;
  for (int r = 1; r <= rings; ++r) {
    Ids ids;
    const double a = k_pi * r / (rings + 1);
    for (int j = 0; j < sides; ++j) {
      const double c = 2 * k_pi * j / sides;
      ids.push_back(b.add(
          {radius * std::sin(a) * std::cos(c), -radius * std::cos(a), -radius * std::sin(a) * std::sin(c)}));
    }
    all.push_back(ids);
  }
  for (int r = 0; r + 1 < rings; ++r)
    b.band(all[static_cast<std::size_t>(r)], all[static_cast<std::size_t>(r + 1)], 0);
  const auto low = b.add({0, -radius, 0}), high = b.add({0, radius, 0});
  for (std::size_t j = 0; j < all[0].size(); ++j) {
    const std::size_t k = (j + 1) % all[0].size();
    b.triangle(all[0][k], all[0][j], low);
    b.triangle(all.back()[j], all.back()[k], high);
  }
  return std::move(b.out.mesh);
}

TrunkMesh moebius(int steps) {
  Builder b;
  for (int i = 0; i < steps; ++i) {
    const double a = 2 * k_pi * i / steps;
    for (const double side : {-0.2, 0.2}) {
      const double r = 1 + side * std::cos(a / 2);
      b.add({r * std::cos(a), r * std::sin(a), side * std::sin(a / 2)});
    }
  }
  const auto at = [&](int i, int j) {
    return static_cast<std::uint32_t>(i < steps ? 2 * i + j : 1 - j);  // the strip closes turned over
  };
  for (int i = 0; i < steps; ++i) b.quad(at(i, 0), at(i + 1, 0), at(i + 1, 1), at(i, 1));
  return std::move(b.out.mesh);
}

TrunkMesh tube(std::span<const Double3> axis, std::span<const double> radii, int sides, bool capped) {
  Builder b;
  std::vector<Ids> rings;
  Double3 u{1, 0, 0};
  for (std::size_t i = 0; i < axis.size(); ++i) {
    const Double3 d = normalized(axis[std::min(i + 1, axis.size() - 1)] - axis[i > 0 ? i - 1 : 0]);
    u = normalized(u - d * dot(u, d), normalized(cross(d, Double3{0, 0, 1}), {1, 0, 0}));
    const Double3 v = cross(u, d);
    Ids ids;
    for (int j = 0; j < sides; ++j) {
      const double a = 2 * k_pi * j / sides;
      ids.push_back(b.add(axis[i] + (u * std::cos(a) + v * std::sin(a)) * radii[i]));
    }
    rings.push_back(ids);
    if (i > 0) b.band(rings[i - 1], rings[i], 0);
  }
  if (capped) {
    for (const bool end : {false, true}) {
      const Ids& ids = end ? rings.back() : rings.front();
      const auto centre = b.add(end ? axis.back() : axis.front());
      for (std::size_t j = 0; j < ids.size(); ++j) {
        const std::size_t k = (j + 1) % ids.size();
        b.triangle(ids[end ? j : k], ids[end ? k : j], centre);
      }
    }
  }
  return std::move(b.out.mesh);
}

TrunkMesh smooth_cells(std::span<const Cell> cells, int rounds) {
  using Quad = std::array<std::uint32_t, 4>;
  const std::set<Cell> full(cells.begin(), cells.end());
  std::map<Cell, std::uint32_t> id;
  std::vector<Double3> points;
  std::vector<Quad> quads;
  const auto corner = [&](int x, int y, int z) {
    const auto [it, is_new] = id.try_emplace({x, y, z}, static_cast<std::uint32_t>(points.size()));
    if (is_new) points.push_back({double(x), double(y), double(z)});
    return it->second;
  };
  for (const Cell& c : full) {
    const auto [x, y, z] = c;
    if (!full.contains({x - 1, y, z}))
      quads.push_back({corner(x, y, z), corner(x, y, z + 1), corner(x, y + 1, z + 1), corner(x, y + 1, z)});
    if (!full.contains({x + 1, y, z}))
      quads.push_back({corner(x + 1, y, z), corner(x + 1, y + 1, z), corner(x + 1, y + 1, z + 1),
                       corner(x + 1, y, z + 1)});
    if (!full.contains({x, y - 1, z}))
      quads.push_back({corner(x, y, z), corner(x + 1, y, z), corner(x + 1, y, z + 1), corner(x, y, z + 1)});
    if (!full.contains({x, y + 1, z}))
      quads.push_back({corner(x, y + 1, z), corner(x, y + 1, z + 1), corner(x + 1, y + 1, z + 1),
                       corner(x + 1, y + 1, z)});
    if (!full.contains({x, y, z - 1}))
      quads.push_back({corner(x, y, z), corner(x, y + 1, z), corner(x + 1, y + 1, z), corner(x + 1, y, z)});
    if (!full.contains({x, y, z + 1}))
      quads.push_back({corner(x, y, z + 1), corner(x + 1, y, z + 1), corner(x + 1, y + 1, z + 1),
                       corner(x, y + 1, z + 1)});
  }
  for (int round = 0; round < rounds; ++round) {
    const std::size_t n = points.size();
    std::vector<Double3> face_sum(n), edge_sum(n);
    std::vector<double> faces(n, 0), edges(n, 0);
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::size_t>> sides;
    std::vector<Double3> centre;
    for (std::size_t q = 0; q < quads.size(); ++q) {
      Double3 c;
      for (const auto v : quads[q]) c += points[v] / 4.0;
      centre.push_back(c);
      for (std::size_t i = 0; i < 4; ++i) {
        face_sum[quads[q][i]] += c, ++faces[quads[q][i]];
        sides[std::minmax(quads[q][i], quads[q][(i + 1) % 4])].push_back(q);
      }
    }
    std::vector<Double3> next;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middle;
    for (const auto& [e, of] : sides) {
      const Double3 m = (points[e.first] + points[e.second]) / 2.0;
      for (const auto v : {e.first, e.second}) edge_sum[v] += m, ++edges[v];
      Double3 f;
      for (const auto q : of) f += centre[q] / static_cast<double>(of.size());
      middle[e] = static_cast<std::uint32_t>(n + next.size());
      next.push_back((m + f) / 2.0);
    }
    for (std::size_t v = 0; v < n; ++v) {
      const double k = faces[v];
      points[v] = (face_sum[v] / k + edge_sum[v] * (2 / edges[v]) + points[v] * (k - 3)) / k;
    }
    points.insert(points.end(), next.begin(), next.end());
    std::vector<Quad> finer;
    for (std::size_t q = 0; q < quads.size(); ++q) {
      const auto c = static_cast<std::uint32_t>(points.size());
      points.push_back(centre[q]);
      for (std::size_t i = 0; i < 4; ++i) {
        const auto a = quads[q][i], b = quads[q][(i + 1) % 4], d = quads[q][(i + 3) % 4];
        finer.push_back({a, middle[std::minmax(a, b)], c, middle[std::minmax(d, a)]});
      }
    }
    quads = finer;
  }
  Builder b;
  b.out.mesh.positions = points;
  for (const Quad& q : quads) b.quad(q[0], q[1], q[2], q[3]);
  return std::move(b.out.mesh);
}

TrunkMesh random_soup(std::uint32_t vertices, std::uint32_t triangles, std::uint32_t seed) {
  Builder b;
  b.random.seed(seed);
  for (std::uint32_t v = 0; v < vertices; ++v) {
    const auto c = [&] {
      return static_cast<double>(b.random() % 17) / 16;
    };  // many coincide, many are in line
    const double x = c(), y = c(), z = c();
    b.add({x, y, z});
  }
  while (b.out.mesh.triangles.size() < triangles) {
    const std::uint32_t x = b.random() % vertices, y = b.random() % vertices, z = b.random() % vertices;
    if (x != y && y != z && x != z) b.triangle(x, y, z);
  }
  return std::move(b.out.mesh);
}

std::vector<std::uint32_t> first_component(const TrunkMesh& mesh) {
  const Components parts = connected_components(mesh.triangles);
  std::vector<std::uint32_t> first;
  for (std::uint32_t t = 0; t < parts.of.size(); ++t) {
    if (parts.of[t] == 0) first.push_back(t);
  }
  return first;
}

TrunkMesh shuffled(const TrunkMesh& mesh, std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto permutation = [&](std::size_t n) {
    Ids p(n);
    std::iota(p.begin(), p.end(), 0u);
    for (std::size_t i = n; i-- > 1;) std::swap(p[i], p[random() % (i + 1)]);
    return p;
  };
  const Ids vertex = permutation(mesh.positions.size()), order = permutation(mesh.triangles.size());
  TrunkMesh out = mesh;
  for (std::size_t v = 0; v < vertex.size(); ++v) out.positions[vertex[v]] = mesh.positions[v];
  for (std::size_t t = 0; t < order.size(); ++t) {
    Triangle c = mesh.triangles[order[t]];
    for (auto& v : c) v = vertex[v];
    if (random() % 8 == 0) std::swap(c[0], c[1]);
    std::rotate(c.begin(), c.begin() + random() % 3, c.end());
    out.triangles[t] = c;
  }
  return out;
}

std::vector<std::uint32_t> all_triangles(const TrunkMesh& mesh) {
  Ids all(mesh.triangles.size());
  std::iota(all.begin(), all.end(), 0u);
  return all;
}

Surface surface_of(const TrunkMesh& mesh) {
  return make_surface(mesh, all_triangles(mesh));
}

std::string breach(const Hierarchy& h, std::size_t vertices, std::size_t triangles) {
  if (h.first_vertex.size() != h.radii.size() + 1) return "first_vertex has a wrong size";
  if (h.first_vertex.back() != h.ring_vertices.size()) return "first_vertex does not end at the vertices";
  if (h.segment_of.size() != triangles) return "segment_of has a wrong size";
  for (std::size_t r = 0; r < h.radii.size(); ++r) {
    const RadiusNode& n = h.radii[r];
    if (!is_finite(n.centre) || !std::isfinite(n.diameter) || n.diameter < 0) return "a radius is not finite";
    if ((r == 0) != (n.parent == k_none)) return "radius 0 is not the only root";
    if (r > 0 && n.parent >= r) return "a parent comes after its child";
    if (h.first_vertex[r] > h.first_vertex[r + 1]) return "first_vertex falls";
  }
  std::vector<std::uint8_t> seen(vertices, 0);
  for (const auto v : h.ring_vertices) {
    if (v >= vertices) return "a vertex does not exist";
    if (seen[v]++) return "a vertex belongs to two radii";
  }
  for (const auto r : h.segment_of) {
    if (r != k_none && (r >= h.radii.size() || h.radii[r].parent == k_none))
      return "a segment does not exist";
  }
  return {};
}

Match match(const Hierarchy& h, const std::vector<TrueRing>& truth, double tolerance) {
  Match m;
  std::vector<std::uint32_t> radius_of(truth.size(), k_none), ring_of(h.radii.size(), k_none);
  for (std::uint32_t t = 0; t < truth.size(); ++t) {
    for (std::uint32_t r = 0; r < h.radii.size(); ++r) {
      const double d = distance(h.radii[r].centre, truth[t].centre);
      if (d > tolerance || ring_of[r] != k_none) continue;
      radius_of[t] = r, ring_of[r] = t;
      ++m.found;
      m.worst_centre = std::max(m.worst_centre, d);
      if (truth[t].diameter > 0) {
        m.worst_diameter = std::max(m.worst_diameter, std::abs(h.radii[r].diameter / truth[t].diameter - 1));
      }
      break;
    }
  }
  for (std::uint32_t t = 0; t < truth.size(); ++t) {
    if (radius_of[t] == k_none) continue;
    const std::uint32_t p = h.radii[radius_of[t]].parent;
    const std::uint32_t expected = truth[t].parent == k_none ? k_none : radius_of[truth[t].parent];
    m.wrong_parents += p != expected;
  }
  for (std::uint32_t r = 0; r < h.radii.size(); ++r)
    m.extra += ring_of[r] == k_none && h.radii[r].diameter > 0;
  return m;
}

}  // namespace copse
