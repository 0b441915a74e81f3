#include "lib/analysis/trunk/strict_model.h"

#include <algorithm>
#include <array>
#include <numeric>

#include <fmt/format.h>

namespace copse {
namespace {

using Indices = std::vector<std::uint32_t>;

void note(Breach& breach, std::uint32_t element) {
  breach.elements.push_back(element);
}

void keep(std::vector<Breach>& all, Breach breach) {
  if (breach.elements.empty()) return;
  std::ranges::sort(breach.elements);
  all.push_back(std::move(breach));
}

Breach breach(const char* rule, std::string what, const char* element) {
  return {rule, std::move(what), element, {}};
}

Triangle welded_corners(const Triangle& t, std::span<const std::uint32_t> welded) {
  return {welded[t[0]], welded[t[1]], welded[t[2]]};
}

// Rule 1: triangles only.
void check_faces(const Mesh& mesh, std::vector<Breach>& all) {
  Breach polygons = breach("1: triangles only", "faces of more than three corners", "face");
  for (std::size_t t = 1; t < mesh.face_of.size(); ++t) {
    const bool second = mesh.face_of[t] == mesh.face_of[t - 1];
    const bool third = second && t > 1 && mesh.face_of[t - 2] == mesh.face_of[t];
    if (second && !third) note(polygons, mesh.face_of[t]);
  }
  keep(all, std::move(polygons));
}

// Rule 2: there is a trunk for leaves to grow on.
void check_for_trunk(std::span<const std::uint32_t> leaf_of, std::vector<Breach>& all) {
  if (std::ranges::find(leaf_of, k_none) != leaf_of.end()) return;
  Breach leafy = breach("2: leaves and a trunk", "triangles, all of them leaves", "triangle");
  leafy.elements.resize(leaf_of.size());
  std::iota(leafy.elements.begin(), leafy.elements.end(), 0u);
  keep(all, std::move(leafy));
}

// Rule 3.1: a leaf is an isolated triangle.
void check_leaves_alone(const Mesh& mesh, std::span<const std::uint32_t> welded,
                        std::span<const std::uint32_t> leaf_of, std::vector<Breach>& all) {
  Indices uses(mesh.positions.size(), 0);
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t v : t) ++uses[welded[v]];
  }
  Breach connected =
      breach("3.1: each leaf is an isolated triangle", "leaf triangles that share a vertex", "triangle");
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& c = mesh.triangles[t];
    if (leaf_of[t] != k_none &&
        std::any_of(c.begin(), c.end(), [&](std::uint32_t v) { return uses[welded[v]] > 1; })) {
      note(connected, t);
    }
  }
  keep(all, std::move(connected));
}

// Rules 3.2, 3.3 and 4.7: material and texture of leaves or trunk.
void check_materials(const Mesh& mesh, std::span<const std::uint32_t> leaf_of, bool leaves,
                     std::vector<Breach>& all) {
  Breach plain = breach(leaves ? "3.2: leaves have a material" : "4.7: the trunk has a material",
                        "triangles without a material", "triangle");
  Breach bare = breach(leaves ? "3.3: leaves have a texture" : "4.7: the trunk has a texture",
                       "triangles without a texture or texture coordinates", "triangle");
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if ((leaf_of[t] != k_none) != leaves) continue;
    const std::uint32_t material = mesh.parts[mesh.part_of[t]].material;
    if (material == k_none) note(plain, t);
    const bool has_texture = material != k_none && mesh.materials[material].texture != k_none;
    const bool has_coordinates =
        !mesh.texcoord_triangles.empty() &&
        std::find(mesh.texcoord_triangles[t].begin(), mesh.texcoord_triangles[t].end(), k_none) ==
            mesh.texcoord_triangles[t].end();
    if (!has_texture || !has_coordinates) note(bare, t);
  }
  keep(all, std::move(plain));
  keep(all, std::move(bare));
}

// The trunk's vertices and who is whose neighbour along an edge.
class TrunkGraph {
 public:
  TrunkGraph(const Mesh& mesh, std::span<const std::uint32_t> welded, std::span<const std::uint32_t> leaf_of)
      : start_(mesh.positions.size() + 1, 0) {
    std::vector<std::array<std::uint32_t, 2>> edges;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      if (leaf_of[i] != k_none) continue;
      const Triangle t = welded_corners(mesh.triangles[i], welded);
      for (int e = 0; e < 3; ++e) {
        const std::uint32_t a = t[e], b = t[(e + 1) % 3];
        if (a != b) edges.push_back({a, b}), edges.push_back({b, a});
      }
    }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    for (const auto& e : edges) ++start_[e[0] + 1], around_.push_back(e[1]);
    std::partial_sum(start_.begin(), start_.end(), start_.begin());
  }
  std::size_t size() const { return start_.size() - 1; }
  bool used(std::uint32_t v) const { return start_[v] < start_[v + 1]; }
  std::span<const std::uint32_t> neighbours(std::uint32_t v) const {
    return std::span(around_).subspan(start_[v], start_[v + 1] - start_[v]);
  }

 private:
  Indices start_, around_;
};

// The thesis' two listings: roots, then children of each radius.
class Reader {
 public:
  Reader(const Mesh& mesh, const TrunkGraph& graph, StrictModel& out)
      : mesh_(mesh), graph_(graph), out_(out), ring_of_(graph.size(), k_none), mark_(graph.size(), 0) {}

  void run(std::span<const std::uint32_t> welded, std::span<const std::uint32_t> leaf_of) {
    find_roots();
    for (std::uint32_t r = 0; r < out_.parent.size(); ++r) find_children(r);
    Breach unreached = check_reached();
    read_unreached(border_edges(welded, leaf_of));
    keep(out_.breaches, std::move(root_sizes_));
    keep(out_.breaches, std::move(sizes_));
    check_joints();
    keep(out_.breaches, std::move(unreached));
    check_bands(welded, leaf_of);
  }

 private:
  // Connected parts of the vertices that carry `stamp`, in the order of `among`; each becomes a radius.
  void add_parts(const Indices& among, std::uint32_t stamp, std::uint32_t parent, Breach& sizes) {
    Indices ring;
    for (const std::uint32_t seed : among) {
      if (mark_[seed] != stamp) continue;
      ring.assign(1, seed);
      mark_[seed] = 0;
      for (std::size_t i = 0; i < ring.size(); ++i) {
        for (const std::uint32_t w : graph_.neighbours(ring[i])) {
          if (mark_[w] == stamp) mark_[w] = 0, ring.push_back(w);
        }
      }
      std::sort(ring.begin(), ring.end());
      const auto radius = static_cast<std::uint32_t>(out_.parent.size());
      for (const std::uint32_t v : ring) ring_of_[v] = radius;
      if (out_.ring_size == 0) out_.ring_size = static_cast<std::uint32_t>(ring.size());
      if (ring.size() != out_.ring_size) note(sizes, ring.front());
      out_.parent.push_back(parent);
      out_.vertices.insert(out_.vertices.end(), ring.begin(), ring.end());
      out_.first_vertex.push_back(static_cast<std::uint32_t>(out_.vertices.size()));
    }
  }

  void find_roots() {
    Indices below;
    const std::uint32_t stamp = ++stamp_;
    for (std::uint32_t v = 0; v < graph_.size(); ++v) {
      if (graph_.used(v) && mesh_.positions[v].y < 0) below.push_back(v), mark_[v] = stamp;
    }
    add_parts(below, stamp, k_none, root_sizes_);
  }

  void find_children(std::uint32_t parent) {
    Indices near;
    const std::uint32_t stamp = ++stamp_;
    for (std::uint32_t i = out_.first_vertex[parent]; i < out_.first_vertex[parent + 1]; ++i) {
      for (const std::uint32_t w : graph_.neighbours(out_.vertices[i])) {
        if (ring_of_[w] == k_none && mark_[w] != stamp) mark_[w] = stamp, near.push_back(w);
      }
    }
    std::sort(near.begin(), near.end());
    add_parts(near, stamp, parent, sizes_);
  }

  // Rule 4.4: an edge joins a radius to itself, its parent or its child, and to nothing else.
  void check_joints() {
    Breach joints = breach("4.4: a radius has exactly one parent",
                           "vertices joined to a radius that is neither theirs, "
                           "nor its parent, nor its child",
                           "vertex");
    for (std::uint32_t v = 0; v < graph_.size(); ++v) {
      if (ring_of_[v] == k_none) continue;
      const std::uint32_t r = ring_of_[v];
      const auto near = graph_.neighbours(v);
      const bool wrong = std::any_of(near.begin(), near.end(), [&](std::uint32_t w) {
        const std::uint32_t s = ring_of_[w];
        return s != k_none && s != r && out_.parent[s] != r && out_.parent[r] != s;
      });
      if (wrong) note(joints, v);
    }
    keep(out_.breaches, std::move(joints));
  }

  Breach check_reached() const {
    if (out_.parent.empty()) {
      Breach rootless = breach("4.6: a root radius has negative y",
                               "no vertex of the trunk lies below y = 0; the first of it", "vertex");
      for (std::uint32_t v = 0; v < graph_.size(); ++v) {
        if (graph_.used(v)) note(rootless, v);
      }
      return rootless;
    }
    Breach loose = breach("4.1: the trunk is cylinders joined to one another",
                          "vertices that no root reaches along the edges", "vertex");
    for (std::uint32_t v = 0; v < graph_.size(); ++v) {
      if (graph_.used(v) && ring_of_[v] == k_none) note(loose, v);
    }
    return loose;
  }

  using Edge = std::array<std::uint32_t, 2>;

  // Of triangles that no root reaches, the edges that have one triangle, both ways.
  std::vector<Edge> border_edges(std::span<const std::uint32_t> welded,
                                 std::span<const std::uint32_t> leaf_of) const {
    std::vector<Edge> all, border;
    for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) {
      if (leaf_of[i] != k_none) continue;
      const Triangle t = welded_corners(mesh_.triangles[i], welded);
      if (ring_of_[t[0]] != k_none) continue;
      for (int e = 0; e < 3; ++e)
        all.push_back({std::min(t[e], t[(e + 1) % 3]), std::max(t[e], t[(e + 1) % 3])});
    }
    std::ranges::sort(all);
    for (std::size_t i = 0, end = 0; i < all.size(); i = end) {
      for (end = i + 1; end < all.size() && all[end] == all[i];) ++end;
      if (end - i == 1 && all[i][0] != all[i][1])
        border.push_back(all[i]), border.push_back({all[i][1], all[i][0]});
    }
    std::ranges::sort(border);
    return border;
  }

  // What no root reaches breaks the rules already; its rings are read from the lowest open end of each part,
  // so that this does not hide what else is wrong with them.
  void read_unreached(const std::vector<Edge>& border) {
    Indices part, end;
    for (std::uint32_t seed = 0; seed < graph_.size(); ++seed) {
      if (!graph_.used(seed) || ring_of_[seed] != k_none || mark_[seed] == k_none) continue;
      part.assign(1, seed);
      mark_[seed] = k_none;
      for (std::size_t i = 0; i < part.size(); ++i) {
        for (const std::uint32_t w : graph_.neighbours(part[i])) {
          if (mark_[w] != k_none && ring_of_[w] == k_none) mark_[w] = k_none, part.push_back(w);
        }
      }
      lowest_end(part, border, end);
      if (end.empty()) continue;
      const std::uint32_t stamp = ++stamp_;
      for (const std::uint32_t v : end) mark_[v] = stamp;
      const auto first = static_cast<std::uint32_t>(out_.parent.size());
      add_parts(end, stamp, k_none, sizes_);
      for (std::uint32_t r = first; r < out_.parent.size(); ++r) find_children(r);
    }
  }

  // The closed border of the part that holds its lowest border vertex; empty where the part is closed.
  void lowest_end(const Indices& part, const std::vector<Edge>& border, Indices& end) {
    const auto edges_of = [&](std::uint32_t v) {
      return std::ranges::equal_range(border, v, {}, [](const Edge& e) { return e[0]; });
    };
    std::uint32_t lowest = k_none;
    for (const std::uint32_t v : part) {
      if (edges_of(v).empty()) continue;
      const auto height = [&](std::uint32_t w) { return std::pair(mesh_.positions[w].y, w); };
      if (lowest == k_none || height(v) < height(lowest)) lowest = v;
    }
    end.clear();
    if (lowest == k_none) return;
    end.push_back(lowest);
    const std::uint32_t stamp = ++stamp_;
    mark_[lowest] = stamp;
    for (std::size_t i = 0; i < end.size(); ++i) {
      for (const Edge& e : edges_of(end[i])) {
        if (mark_[e[1]] != stamp) mark_[e[1]] = stamp, end.push_back(e[1]);
      }
    }
    std::ranges::sort(end);
  }

  // Rule 4.1: two radii are joined by a cylinder, two triangles a side; radii that are no closed rings
  // (strips of grass) have a side less than vertices.
  void check_bands(std::span<const std::uint32_t> welded, std::span<const std::uint32_t> leaf_of) {
    Indices band(out_.parent.size(), 0);
    for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) {
      if (leaf_of[i] != k_none) continue;
      const Triangle t = welded_corners(mesh_.triangles[i], welded);
      std::array<std::uint32_t, 3> rings{ring_of_[t[0]], ring_of_[t[1]], ring_of_[t[2]]};
      if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0] || std::ranges::max(rings) == k_none) continue;
      for (const std::uint32_t r : {std::ranges::max(rings), std::ranges::min(rings)}) {
        if (out_.parent[r] != k_none && std::ranges::find(rings, out_.parent[r]) != rings.end()) {
          ++band[r];
          break;
        }
      }
    }
    Breach open =
        breach("4.1: the trunk is cylinders joined to one another",
               "radii that no closed band of triangles joins to their parent, with a vertex", "vertex");
    const auto size = [&](std::uint32_t r) { return out_.first_vertex[r + 1] - out_.first_vertex[r]; };
    for (std::uint32_t r = 0; r < out_.parent.size(); ++r) {
      const std::uint32_t k = out_.ring_size;
      if (out_.parent[r] == k_none || size(r) != k || size(out_.parent[r]) != k) continue;
      if (band[r] != 2 * k && band[r] != 2 * (k - 1)) note(open, out_.vertices[out_.first_vertex[r]]);
    }
    keep(out_.breaches, std::move(open));
  }

  const Mesh& mesh_;
  const TrunkGraph& graph_;
  StrictModel& out_;
  Indices ring_of_, mark_;
  std::uint32_t stamp_ = 0;
  Breach root_sizes_ =
      breach("4.6: each hierarchy has one root radius of k vertices",
             "root radii of another number of vertices than the first one, with the vertex", "vertex");
  Breach sizes_ =
      breach("4.5: every radius has k vertices",
             "radii of another number of vertices than the first root, with the vertex", "vertex");
};

}  // namespace

std::string to_text(const Breach& breach) {
  const Indices& e = breach.elements;
  std::string text = fmt::format("rule {}: {}: {} ({}", breach.rule, breach.what, e.size(), breach.element);
  for (std::size_t i = 0, end = 0; i < e.size(); i = end) {
    for (end = i + 1; end < e.size() && e[end] - e[i] == end - i;) ++end;
    text += fmt::format("{}{}", i == 0 ? " " : ", ", e[i]);
    if (end - i > 1) text += fmt::format("-{}", e[end - 1]);
  }
  return text + ")";
}

StrictModel read_strict_model(const Mesh& mesh, std::span<const std::uint32_t> welded,
                              std::span<const std::uint32_t> leaf_of) {
  StrictModel out;
  check_faces(mesh, out.breaches);
  check_for_trunk(leaf_of, out.breaches);
  check_leaves_alone(mesh, welded, leaf_of, out.breaches);
  check_materials(mesh, leaf_of, true, out.breaches);
  const TrunkGraph graph(mesh, welded, leaf_of);
  Reader(mesh, graph, out).run(welded, leaf_of);
  check_materials(mesh, leaf_of, false, out.breaches);
  return out;
}

}  // namespace copse
