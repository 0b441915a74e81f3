#include "lib/analysis/lod/leaf_surfaces.h"

#include "lib/analysis/lod/crown_hull.h"
#include "lib/analysis/lod/edge_collapse.h"
#include "lib/analysis/lod/patch.h"
#include "lib/analysis/lod/spectrum_builder.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <tuple>

namespace copse {
namespace {

using Face = std::array<std::uint32_t, 3>;

constexpr double k_margin = 0.01;   // of the crown's width, out of its hull
constexpr double k_largest = 2;     // a lump is scaled by no more
constexpr double k_stale = 0.005;   // a lump whose area is wrong by more is scaled again,
constexpr double k_changed = 0.01;  // once as large a share of its triangles has changed
constexpr double k_closed = 0.07;   // share of border edges: below it, what is open is where no one looks
constexpr double k_border = 3;      // of a plane across a border
constexpr double k_near = 1e-3;     // of a quadric's weight: of staying where it is
constexpr double k_turn = 0.2;      // cosine: a vertex is not put where a face turns by more
constexpr double k_lost = 0.005;    // of all leaves' area: where so much cannot be held, edges are done
constexpr double k_flat = 0.999;    // cosine: a corner whose normal is so near the face's is shaded flat

double area_of(const Double3& a, const Double3& b, const Double3& c) {
  const Double3 n = cross(b - a, c - a);
  return 0.5 * std::sqrt(dot(n, n));
}

// ---- which triangles are of lumps

// The places of the triangles' corners, leaf by leaf: one number for equal coordinates.
std::vector<Face> places_of(const LeafPieces& pieces, std::vector<Double3>& places) {
  struct Corner {
    std::uint32_t leaf;
    Float3 at;
    std::uint32_t corner;
    auto key() const { return std::tie(leaf, at.x, at.y, at.z); }
  };
  std::vector<Corner> corners;
  for (const LeafPiece& piece : pieces.list)
    for (std::uint32_t i = piece.first; i < piece.last; ++i)
      for (std::uint32_t c = 0; c < 3; ++c) {
        const std::uint32_t t = pieces.triangles[i];
        corners.push_back(
            {piece.leaf, pieces.part.vertices[pieces.part.triangles[t][c]].position, 3 * t + c});
      }
  std::sort(corners.begin(), corners.end(), [](const Corner& x, const Corner& y) {
    return x.key() != y.key() ? x.key() < y.key() : x.corner < y.corner;
  });
  std::vector<Face> out(pieces.part.triangles.size(), Face{k_none, k_none, k_none});
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (i == 0 || corners[i].key() != corners[i - 1].key()) places.push_back(to_double(corners[i].at));
    out[corners[i].corner / 3][corners[i].corner % 3] = static_cast<std::uint32_t>(places.size() - 1);
  }
  return out;
}

// Whether leaves of so many triangles that they may hold lumps are half of the area; quick.
bool may_be_lumps(const LeafPieces& pieces) {
  double all = 0, large = 0;
  for (std::size_t p = 0, next = 0; p < pieces.list.size(); p = next) {
    double area = 0;
    std::size_t triangles = 0;
    for (next = p; next < pieces.list.size() && pieces.list[next].leaf == pieces.list[p].leaf; ++next) {
      const LeafPiece& piece = pieces.list[next];
      for (std::uint32_t i = piece.first; i < piece.last; ++i) {
        const auto& t = pieces.part.triangles[pieces.triangles[i]];
        const auto at = [&](int c) { return to_double(pieces.part.vertices[t[c]].position); };
        const double one = area_of(at(0), at(1), at(2));
        all += one, area += piece.card ? 0 : one, triangles += piece.card ? 0 : 1;
      }
    }
    large += triangles >= k_lump_triangles ? area : 0;
  }
  return large > 0.499 * all;
}

struct Surface {
  std::vector<std::uint32_t> triangles;
  double area = 0;
  double border = 0;  // share of its edges
  bool lump = false;
};

class Surfaces {
 public:
  explicit Surfaces(const LeafPieces& pieces) : pieces_(pieces), faces(places_of(pieces, places)) {
    piece_of.assign(faces.size(), k_none);
    for (std::uint32_t p = 0; p < pieces.list.size(); ++p)
      for (std::uint32_t i = pieces.list[p].first; i < pieces.list[p].last; ++i)
        piece_of[pieces.triangles[i]] = p;
    connect();
    for (Surface& s : list) s.lump = is_lump(s);
  }

  // The share of the area that is of lumps.
  double share() const {
    double all = 0, lumps = 0;
    for (const Surface& s : list) all += s.area, lumps += s.lump ? s.area : 0;
    return all > 0 ? lumps / all : 0;
  }

 private:
  void connect() {
    std::vector<std::uint32_t> parent(places.size());
    std::iota(parent.begin(), parent.end(), 0u);
    const auto find = [&](std::uint32_t v) {
      while (parent[v] != v) v = parent[v] = parent[parent[v]];
      return v;
    };
    const auto unite = [&](std::uint32_t a, std::uint32_t b) {
      a = find(a), b = find(b);
      parent[std::max(a, b)] = std::min(a, b);
    };
    for (const Face& f : faces)
      if (f[0] != k_none) unite(f[0], f[1]), unite(f[0], f[2]);
    std::vector<std::uint32_t> number(places.size(), k_none);
    for (const LeafPiece& piece : pieces_.list)
      for (std::uint32_t i = piece.first; i < piece.last; ++i) {
        const Face& f = faces[pieces_.triangles[i]];
        std::uint32_t& n = number[find(f[0])];
        if (n == k_none) n = static_cast<std::uint32_t>(list.size()), list.emplace_back();
        list[n].triangles.push_back(pieces_.triangles[i]);
        list[n].area += area_of(places[f[0]], places[f[1]], places[f[2]]);
      }
  }

  bool is_lump(Surface& s) const {
    if (s.triangles.size() < k_lump_triangles || !(s.area > 0)) return false;
    std::vector<std::array<std::uint32_t, 2>> edges;
    for (const std::uint32_t t : s.triangles) {
      if (pieces_.list[piece_of[t]].card) return false;
      for (int c = 0; c < 3; ++c) {
        const std::uint32_t a = faces[t][c], b = faces[t][(c + 1) % 3];
        edges.push_back({std::min(a, b), std::max(a, b)});
      }
    }
    std::sort(edges.begin(), edges.end());
    std::size_t all = 0, border = 0;
    for (std::size_t i = 0, j = 0; i < edges.size(); i = j, ++all) {
      for (j = i; j < edges.size() && edges[j] == edges[i];) ++j;
      border += j - i == 1;
    }
    s.border = double(border) / double(all);
    return s.border <= k_lump_border;
  }

  const LeafPieces& pieces_;

 public:
  std::vector<Double3> places;
  std::vector<Face> faces;              // of every triangle, its places
  std::vector<std::uint32_t> piece_of;  // every triangle
  std::vector<Surface> list;
};

// ---- the collapse

// The sum of squared distances from planes, and the place where it is least.
struct Quadric {
  Symmetric3 a;
  Double3 b{};
  double weight = 0;

  void add(const Double3& n, const Double3& on, double w) {
    a.add(n, w), b += n * (dot(n, on) * w), weight += w;
  }
  Quadric& operator+=(const Quadric& o) {
    a += o.a, b += o.b, weight += o.weight;
    return *this;
  }
  // Where the planes leave it open, near `at`.
  Double3 least(const Double3& at) const {
    const double w = k_near * weight;
    const double x = a.m[0] + w, y = a.m[1] + w, z = a.m[2] + w, p = a.m[3], q = a.m[4], r = a.m[5];
    const Double3 right = b + at * w;
    const Double3 c0{x, p, q}, c1{p, y, r}, c2{q, r, z};
    const double det = dot(c0, cross(c1, c2));
    if (!(det > 0)) return at;
    return Double3{dot(right, cross(c1, c2)), dot(right, cross(c2, c0)), dot(right, cross(c0, c1))} / det;
  }
};

CrownHull hull_of(const LeafPieces& pieces) {
  std::vector<Double3> points;
  for (const std::uint32_t t : pieces.triangles)
    for (const std::uint32_t v : pieces.part.triangles[t])
      points.push_back(to_double(pieces.part.vertices[v].position));
  return CrownHull(points, k_margin);
}

// The lumps' triangles, one vertex a place: neither shading nor texture is in the way.
PartTriangles mesh_of(const LeafPieces& pieces, const Surfaces& surfaces) {
  PartTriangles mesh;
  for (std::uint32_t p = 0; p < surfaces.places.size(); ++p) {
    mesh.vertices.push_back({to_float(surfaces.places[p]), {0, 1, 0}, {}});
    mesh.position_of.push_back(p);
  }
  for (const Surface& s : surfaces.list)
    for (const std::uint32_t t : s.triangles)
      if (s.lump)
        mesh.triangles.push_back(surfaces.faces[t]), mesh.materials.push_back(pieces.part.materials[t]);
  return mesh;
}

class Replay {
 public:
  Replay(const LeafPieces& pieces, const Surfaces& surfaces)
      : pieces_(pieces), surfaces_(surfaces), hull_(hull_of(pieces)), builder_(LodMethod::collapse) {
    now_ = shape_ = surfaces.places;
    quadrics_.resize(now_.size());
    faces_ = surfaces.faces, element_.assign(faces_.size(), k_none), lump_of_.assign(faces_.size(), k_none);
    around_.resize(now_.size());
    for (const SpectrumVertex& v : pieces.part.vertices) builder_.vertex(v);
    for (const Surface& s : surfaces.list) {
      if (!s.lump) continue;
      for (const std::uint32_t t : s.triangles) {
        lump_of_[t] = static_cast<std::uint32_t>(lumps_.size());
        element_[t] = builder_.element(pieces.part.materials[t], piece(t).radius,
                                       std::span(&pieces.part.triangles[t], 1));
        for (const std::uint32_t p : faces_[t]) around_[p].push_back(t);
      }
      Lump lump{s.triangles, s.area, s.area, s.area, {}, 0, s.triangles.size(), 1};
      all_ += s.area;
      for (const std::uint32_t t : s.triangles)
        for (const std::uint32_t p : faces_[t]) lump.centre += now_[p] / (3.0 * double(s.triangles.size()));
      add_quadrics(s, lump.centre);
      lumps_.push_back(std::move(lump));
    }
    keep_others();
  }

  SurfaceCollapse run(const EdgeCollapses& collapses) {
    for (std::size_t i = 0; i < collapses.size(); ++i) {
      builder_.step(0);
      for (std::uint32_t w = collapses.first[i]; w < collapses.first[i + 1]; ++w) {
        const std::uint32_t lump = collapse(collapses.wedges[w].thrown, collapses.wedges[w].kept);
        if (lump != k_none) hold_area(lumps_[lump]);
      }
      if (lost_ > k_lost * all_) break;
    }
    return {.spectrum = builder_.finish(),
            .left = left(),
            .lumps = static_cast<std::uint32_t>(lumps_.size()),
            .triangles = static_cast<std::uint32_t>(
                std::count_if(lump_of_.begin(), lump_of_.end(), [](std::uint32_t l) { return l != k_none; })),
            .share = surfaces_.share()};
  }

 private:
  struct Lump {
    std::vector<std::uint32_t> triangles;   // those that are left
    double source = 0, area = 0, held = 0;  // areas: at full detail, now, when it was scaled last
    Double3 centre;
    std::size_t changed = 0;  // triangles, since
    std::size_t alive = 0;
    double by = 1;  // it is scaled
  };

  const LeafPiece& piece(std::uint32_t t) const { return pieces_.list[surfaces_.piece_of[t]]; }

  void keep_others() {
    for (const LeafPiece& p : pieces_.list) {
      std::vector<Face> whole;
      for (std::uint32_t i = p.first; i < p.last; ++i)
        if (lump_of_[pieces_.triangles[i]] == k_none)
          whole.push_back(pieces_.part.triangles[pieces_.triangles[i]]);
      if (!whole.empty()) builder_.element(p.material, p.radius, whole);
    }
  }

  double area(std::uint32_t t) const {
    return area_of(now_[faces_[t][0]], now_[faces_[t][1]], now_[faces_[t][2]]);
  }

  // Of the faces' planes, and of planes across the border, which hold it where it is.
  void add_quadrics(const Surface& s, const Double3& centre) {
    struct Edge {
      std::array<std::uint32_t, 2> ends;
      std::uint32_t triangle;
    };
    std::vector<Edge> edges;
    for (const std::uint32_t t : s.triangles) {
      const Face& f = faces_[t];
      const Double3 n = normal(t, shape_);
      for (std::size_t c = 0; c < 3; ++c) {
        quadrics_[f[c]].add(n, now_[f[0]] - centre, area(t));
        edges.push_back({{std::min(f[c], f[(c + 1) % 3]), std::max(f[c], f[(c + 1) % 3])}, t});
      }
    }
    if (s.border < k_closed) return;
    std::sort(edges.begin(), edges.end(), [](const Edge& x, const Edge& y) {
      return x.ends != y.ends ? x.ends < y.ends : x.triangle < y.triangle;
    });
    for (std::size_t i = 0, j = 0; i < edges.size(); i = j) {
      for (j = i; j < edges.size() && edges[j].ends == edges[i].ends;) ++j;
      if (j - i > 1) continue;
      const auto [p, q] = edges[i].ends;
      const Double3 along = now_[q] - now_[p];
      const Double3 across = normalized(cross(along, normal(edges[i].triangle, shape_)), {});
      for (const std::uint32_t v : edges[i].ends)
        quadrics_[v].add(across, now_[p] - centre, k_border * dot(along, along));
    }
  }

  // The lump of the two places.
  std::uint32_t collapse(std::uint32_t thrown, std::uint32_t kept) {
    std::vector<std::uint32_t>& ring = around_[kept];
    ring.insert(ring.end(), around_[thrown].begin(), around_[thrown].end());
    around_[thrown] = {};
    std::sort(ring.begin(), ring.end());
    ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
    std::erase_if(ring, [&](std::uint32_t t) { return element_[t] == k_none; });
    if (ring.empty()) return k_none;
    const std::uint32_t number = lump_of_[ring.front()];
    Lump& lump = lumps_[number];
    lost_ += lump.area;
    for (const std::uint32_t t : ring) {
      lump.area -= area(t);
      builder_.remove(element_[t]);
      Face& f = faces_[t];
      for (std::uint32_t& p : f) p = p == thrown ? kept : p;
      if (f[0] == f[1] || f[1] == f[2] || f[2] == f[0]) element_[t] = k_none, --lump.alive;
    }
    lump.changed += ring.size();
    std::erase_if(ring, [&](std::uint32_t t) { return element_[t] == k_none; });
    quadrics_[kept] += quadrics_[thrown];
    place(kept, lump);
    for (const std::uint32_t t : ring) lump.area += area(t), element_[t] = draw(t);
    lost_ -= lump.area;
    return number;
  }

  // Where the planes of all that it stands for are nearest, if no face turns over.
  void place(std::uint32_t p, const Lump& lump) {
    const Double3 before = shape_[p];
    std::vector<Double3> normals;
    for (const std::uint32_t t : around_[p]) normals.push_back(normal(t, shape_));
    shape_[p] = lump.centre + quadrics_[p].least(before - lump.centre);
    for (std::size_t i = 0; i < normals.size(); ++i)
      if (!(dot(normals[i], normal(around_[p][i], shape_)) > k_turn)) shape_[p] = before;
    put(p, lump);
  }

  // Scales the vertex with its lump, within the crown's hull.
  void put(std::uint32_t p, const Lump& lump) { now_[p] = scaled(p, lump.centre, lump.by); }

  // As the lump's triangle looks now: with its own texture; flat where it was flat.
  std::array<SpectrumVertex, 3> corners(std::uint32_t t) const {
    std::array<SpectrumVertex, 3> out;
    const Double3 face = normal(t, now_), before = source_normal(t);
    for (int c = 0; c < 3; ++c) {
      out[c] = pieces_.part.vertices[pieces_.part.triangles[t][c]];
      out[c].position = to_float(now_[faces_[t][c]]);
      const bool flat = std::abs(dot(to_double(out[c].normal), before)) > k_flat;
      if (!flat || !(dot(face, face) > 0)) continue;
      out[c].normal = to_float(dot(to_double(out[c].normal), before) < 0 ? -face : face);
    }
    return out;
  }
  Double3 normal(std::uint32_t t, const std::vector<Double3>& at) const {
    const Face& f = faces_[t];
    return normalized(cross(at[f[1]] - at[f[0]], at[f[2]] - at[f[0]]), {});
  }
  Double3 source_normal(std::uint32_t t) const {
    const Face& f = surfaces_.faces[t];
    const auto& at = surfaces_.places;
    return normalized(cross(at[f[1]] - at[f[0]], at[f[2]] - at[f[0]]), {});
  }

  std::uint32_t draw(std::uint32_t t) {
    const auto c = corners(t);
    const Face f{builder_.vertex(c[0]), builder_.vertex(c[1]), builder_.vertex(c[2])};
    return builder_.element(pieces_.part.materials[t], piece(t).radius, std::span(&f, 1));
  }

  void hold_area(Lump& lump) {
    if (std::abs(lump.area - lump.held) <= k_stale * lump.source ||
        double(lump.changed) < k_changed * double(lump.alive))
      return;
    std::erase_if(lump.triangles, [&](std::uint32_t t) { return element_[t] == k_none; });
    lost_ += lump.area;
    std::vector<std::uint32_t> used;
    for (const std::uint32_t t : lump.triangles) used.insert(used.end(), faces_[t].begin(), faces_[t].end());
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    double& by = lump.by;
    for (int round = 0; round < 8; ++round) {
      for (const std::uint32_t p : used) now_[p] = scaled(p, lump.centre, by);
      lump.area = 0;
      for (const std::uint32_t t : lump.triangles) lump.area += area(t);
      if (!(lump.area > 0) || std::abs(lump.area - lump.source) < 1e-4 * lump.source) break;
      by = std::min(by * std::sqrt(lump.source / lump.area), k_largest);
    }
    for (const std::uint32_t p : used) put(p, lump);
    lost_ -= lump.area;
    for (const std::uint32_t t : lump.triangles) builder_.remove(element_[t]), element_[t] = draw(t);
    lump.held = lump.area, lump.changed = 0;
  }

  // Within the crown's hull.
  Double3 scaled(std::uint32_t p, const Double3& centre, double by) const {
    Double3 at = centre + (shape_[p] - centre) * by;
    at += hull_.way_back(std::span(&at, 1), k_margin * hull_.width());
    return at;
  }

  LeafPieces left() const {
    LeafPieces out;
    out.opacity = pieces_.opacity;
    std::vector<std::uint32_t> number(now_.size(), k_none);
    std::uint32_t positions = 0;
    const auto add = [&](const SpectrumVertex& v, std::uint32_t place) {
      if (number[place] == k_none) number[place] = positions++;
      out.part.vertices.push_back(v), out.part.position_of.push_back(number[place]);
      return static_cast<std::uint32_t>(out.part.vertices.size() - 1);
    };
    const auto triangle = [&](std::uint32_t t, const std::array<SpectrumVertex, 3>& c) {
      out.triangles.push_back(static_cast<std::uint32_t>(out.part.triangles.size()));
      const Face& f = faces_[t];
      out.part.triangles.push_back({add(c[0], f[0]), add(c[1], f[1]), add(c[2], f[2])});
      out.part.materials.push_back(pieces_.part.materials[t]);
    };
    for (const LeafPiece& p : pieces_.list) {
      for (std::uint32_t i = p.first; i < p.last; ++i) {
        const std::uint32_t t = pieces_.triangles[i];
        if (element_[t] == k_none) continue;
        LeafPiece own = p;
        own.first = static_cast<std::uint32_t>(out.triangles.size()), own.last = own.first + 1;
        own.material = pieces_.part.materials[t], own.cut = LeafCut::triangle;
        triangle(t, corners(t));
        out.list.push_back(own);
      }
      LeafPiece rest = p;
      rest.first = static_cast<std::uint32_t>(out.triangles.size());
      for (std::uint32_t i = p.first; i < p.last; ++i) {
        const std::uint32_t t = pieces_.triangles[i];
        if (lump_of_[t] != k_none) continue;
        const Face& f = pieces_.part.triangles[t];
        triangle(t, {pieces_.part.vertices[f[0]], pieces_.part.vertices[f[1]], pieces_.part.vertices[f[2]]});
      }
      rest.last = static_cast<std::uint32_t>(out.triangles.size());
      if (rest.first != rest.last) out.list.push_back(rest);
    }
    return out;
  }

  const LeafPieces& pieces_;
  const Surfaces& surfaces_;
  CrownHull hull_;
  SpectrumBuilder builder_;
  std::vector<Double3> shape_, now_;  // of every place: before the lump is scaled, and then
  std::vector<Quadric> quadrics_;
  std::vector<Face> faces_;
  std::vector<std::uint32_t> element_, lump_of_;    // of every triangle
  std::vector<std::vector<std::uint32_t>> around_;  // every place: triangles, of which some are gone
  std::vector<Lump> lumps_;
  double all_ = 0, lost_ = 0;  // areas: of all lumps, and what is missing of it
};

}  // namespace

std::optional<SurfaceCollapse> collapse_surfaces(const LeafPieces& pieces) {
  if (!may_be_lumps(pieces)) return {};
  const Surfaces surfaces(pieces);
  if (!(surfaces.share() > 0.5)) return {};
  const EdgeCollapses collapses =
      collapse_edges(mesh_of(pieces, surfaces), {.attribute_weight = 0, .max_error = 1});
  return Replay(pieces, surfaces).run(collapses);
}

Spectrum joined(const Spectrum& first, const Spectrum& then) {
  SpectrumBuilder builder(then.method);
  const std::uint32_t steps = first.steps();
  for (std::uint32_t n = 1; n <= steps + then.steps(); ++n) builder.step(0);
  const auto add = [&](const Spectrum& s, std::uint32_t later, std::uint32_t last) {
    std::vector<std::uint32_t> number;
    for (const SpectrumVertex& v : s.vertices) number.push_back(builder.vertex(v));
    std::vector<Face> faces;
    for (std::size_t e = 0; e < s.elements.size(); ++e) {
      SpectrumElement element = s.elements[e];
      element.birth += later;
      element.death = element.death == k_none ? last : element.death + later;
      faces.clear();
      for (std::uint32_t t = s.first_triangle[e]; t < s.first_triangle[e + 1]; ++t)
        faces.push_back({number[s.triangles[t][0]], number[s.triangles[t][1]], number[s.triangles[t][2]]});
      builder.element(element, faces);
    }
  };
  if (steps > 0) add(first, 0, steps);
  add(then, steps, k_none);
  return builder.finish();
}

}  // namespace copse
