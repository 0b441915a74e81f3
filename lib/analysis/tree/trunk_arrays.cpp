#include "lib/analysis/tree/trunk_arrays.h"

#include "lib/analysis/tree/constant_step.h"
#include "lib/analysis/tree/corner_columns.h"

#include <algorithm>
#include <numeric>

namespace copse {
namespace {

using Indices = std::vector<std::uint32_t>;

// Radii breadth first: roots, then children, each parent's together and in their old order.
struct Order {
  Indices stored;                    // old index -> new index
  Indices original;                  // new index -> old index
  Indices first_child, child_count;  // by old index; first_child is a new index
  std::uint32_t roots = 0;
};

Order breadth_first(const std::vector<RadiusNode>& radii) {
  const std::size_t n = radii.size();
  Order order;
  order.child_count.assign(n, 0);
  for (const RadiusNode& r : radii) {
    if (r.parent != k_none) ++order.child_count[r.parent];
  }
  Indices start(n + 1, 0), children(n);
  std::partial_sum(order.child_count.begin(), order.child_count.end(), start.begin() + 1);
  Indices next(start.begin(), start.end() - 1);
  order.original.reserve(n);
  for (std::uint32_t r = 0; r < n; ++r) {
    if (radii[r].parent == k_none) {
      order.original.push_back(r);
    } else {
      children[next[radii[r].parent]++] = r;
    }
  }
  order.roots = static_cast<std::uint32_t>(order.original.size());
  order.first_child.assign(n, k_none);
  for (std::size_t i = 0; i < order.original.size(); ++i) {
    const std::uint32_t r = order.original[i];
    if (order.child_count[r] > 0) order.first_child[r] = static_cast<std::uint32_t>(order.original.size());
    order.original.insert(order.original.end(), children.begin() + start[r], children.begin() + start[r + 1]);
  }
  order.stored.resize(n);
  for (std::uint32_t i = 0; i < n; ++i) order.stored[order.original[i]] = i;
  return order;
}

// The radius (old index) that each vertex of the trunk hangs on. Ring vertices are given; the others (cap
// centres, lumps) take the radius of the nearest owned vertex, counted in edges, found by growing from all
// rings at once.
Indices owners(const TrunkMesh& trunk, const Hierarchy& hierarchy) {
  const std::size_t n = trunk.positions.size();
  Indices owner(n, k_none);
  Indices queue;
  for (std::uint32_t r = 0; r < hierarchy.radii.size(); ++r) {
    for (std::uint32_t v = hierarchy.first_vertex[r]; v < hierarchy.first_vertex[r + 1]; ++v) {
      owner[hierarchy.ring_vertices[v]] = r;
      queue.push_back(hierarchy.ring_vertices[v]);
    }
  }
  Indices used(n, 0);
  for (const Triangle& t : trunk.triangles) {
    for (const std::uint32_t v : t) ++used[v];
  }
  std::size_t missing = 0;
  for (std::size_t v = 0; v < n; ++v) missing += used[v] > 0 && owner[v] == k_none;
  if (missing == 0) return owner;

  Indices start(n + 1, 0), around;
  std::partial_sum(used.begin(), used.end(), start.begin() + 1);
  around.resize(start[n]);
  Indices next(start.begin(), start.end() - 1);
  for (std::uint32_t t = 0; t < trunk.triangles.size(); ++t) {
    for (const std::uint32_t v : trunk.triangles[t]) around[next[v]++] = t;
  }
  for (std::size_t i = 0; i < queue.size(); ++i) {
    const std::uint32_t v = queue[i];
    for (std::uint32_t a = start[v]; a < start[v + 1]; ++a) {
      for (const std::uint32_t w : trunk.triangles[around[a]]) {
        if (owner[w] == k_none) owner[w] = owner[v], queue.push_back(w);
      }
    }
  }
  // A piece without any ring: the nearest centre. Rare, and small whenever it happens.
  for (std::size_t v = 0; v < n; ++v) {
    if (used[v] == 0 || owner[v] != k_none) continue;
    double best = std::numeric_limits<double>::infinity();
    for (std::uint32_t r = 0; r < hierarchy.radii.size(); ++r) {
      const double d = distance(hierarchy.radii[r].centre, trunk.positions[v]);
      if (d < best) best = d, owner[v] = r;
    }
  }
  return owner;
}

// The segment (child radius, old index) that each triangle is stored with.
class SegmentChooser {
 public:
  explicit SegmentChooser(const Hierarchy& hierarchy)
      : radii_(hierarchy.radii), below_(radii_.size(), k_none) {
    for (std::uint32_t r = 0; r < radii_.size(); ++r) {
      if (!is_segment(r)) continue;
      if (first_ == k_none) first_ = r;
      if (below_[radii_[r].parent] == k_none) below_[radii_[r].parent] = r;
    }
    // A root or joint without a segment of its own hands its triangles down, and if there is nothing below,
    // up.
    for (std::uint32_t r = static_cast<std::uint32_t>(radii_.size()); r-- > 0;) {
      const std::uint32_t p = radii_[r].parent;
      if (p != k_none && below_[p] == k_none) below_[p] = below_[r];
    }
    for (std::uint32_t r = 0; r < radii_.size(); ++r) {
      if (below_[r] == k_none && radii_[r].parent != k_none) below_[r] = nearest(radii_[r].parent);
    }
  }
  bool is_segment(std::uint32_t r) const { return radii_[r].parent != k_none && !radii_[r].joint; }
  std::uint32_t nearest(std::uint32_t r) const {
    if (is_segment(r)) return r;
    return below_[r] != k_none ? below_[r] : first_;
  }

 private:
  const std::vector<RadiusNode>& radii_;
  Indices below_;
  std::uint32_t first_ = k_none;
};

Indices choose_segments(const TrunkMesh& trunk, const Hierarchy& hierarchy, const Indices& owner,
                        std::uint32_t& unexplained) {
  const SegmentChooser chooser(hierarchy);
  Indices segment(trunk.triangles.size());
  unexplained = 0;
  for (std::size_t t = 0; t < segment.size(); ++t) {
    segment[t] = hierarchy.segment_of[t];
    if (segment[t] == k_none) ++unexplained;
    if (segment[t] != k_none && chooser.is_segment(segment[t])) continue;
    std::uint32_t deepest = 0;
    for (const std::uint32_t v : trunk.triangles[t]) deepest = std::max(deepest, owner[v]);
    segment[t] = chooser.nearest(deepest);
  }
  return segment;
}

struct Segments {
  Indices child;           // old index of the child radius, in stored order
  Indices first_triangle;  // offsets into `triangles`
  Indices triangles;       // trunk triangles in stored order
};

Segments sort_segments(const Hierarchy& hierarchy, const Order& order, const Indices& segment_of) {
  Segments s;
  const auto diameter = [&](std::uint32_t r) {
    const RadiusNode& node = hierarchy.radii[r];
    return static_cast<float>(std::max(node.diameter, hierarchy.radii[node.parent].diameter));
  };
  for (const std::uint32_t r : order.original) {
    if (hierarchy.radii[r].parent != k_none && !hierarchy.radii[r].joint) s.child.push_back(r);
  }
  std::stable_sort(s.child.begin(), s.child.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return diameter(a) < diameter(b); });
  Indices rank(hierarchy.radii.size(), k_none);
  for (std::uint32_t i = 0; i < s.child.size(); ++i) rank[s.child[i]] = i;
  s.first_triangle.assign(s.child.size() + 1, 0);
  for (const std::uint32_t r : segment_of) ++s.first_triangle[rank[r] + 1];
  std::partial_sum(s.first_triangle.begin(), s.first_triangle.end(), s.first_triangle.begin());
  Indices next = s.first_triangle;
  s.triangles.resize(segment_of.size());
  for (std::uint32_t t = 0; t < segment_of.size(); ++t) s.triangles[next[rank[segment_of[t]]]++] = t;
  return s;
}

struct StoredRadii {
  std::vector<Radius> radii;
  std::vector<Double3> centres;  // as a reader will accumulate them
  bool monotone = true;
};

StoredRadii store_radii(const Hierarchy& hierarchy, const Order& order, const Double3& origin,
                        const Indices& group_of_radius) {
  StoredRadii out;
  out.radii.resize(order.original.size());
  out.centres.resize(order.original.size());
  for (std::uint32_t i = 0; i < order.original.size(); ++i) {
    const std::uint32_t old = order.original[i];
    const RadiusNode& node = hierarchy.radii[old];
    Radius& r = out.radii[i];
    const Double3 centre = node.centre - origin;
    Double3 base{};
    if (node.parent != k_none) {
      const std::uint32_t p = order.stored[node.parent];
      base = out.centres[p];
      r.distance = static_cast<float>(distance(node.centre, hierarchy.radii[node.parent].centre));
      if (static_cast<float>(node.diameter) > out.radii[p].diameter) out.monotone = false;
    }
    r.centre = to_float(centre - base);
    out.centres[i] = base + to_double(r.centre);
    r.diameter = static_cast<float>(node.diameter);
    r.flags = (node.joint ? Radius::joint : 0u);
    r.child_count = order.child_count[old];
    r.first_child = order.first_child[old];
    if (r.child_count == 0) {
      r.flags |= Radius::terminal;
      if (!group_of_radius.empty() && group_of_radius[old] != k_none) {
        r.child_count = 1;
        r.first_child = group_of_radius[old];
      }
    }
  }
  return out;
}

// Vertices grouped by the radius that they hang on: ring vertices first and in ring order, then the rest.
struct VertexOrder {
  Indices first;   // radii + 1 offsets, by stored radius
  Indices vertex;  // trunk vertex of each stored one
  Indices stored;  // stored index of each trunk vertex
};

VertexOrder order_vertices(const TrunkMesh& trunk, const Hierarchy& hierarchy, const Order& order,
                           const Indices& owner) {
  VertexOrder out;
  const std::size_t radii = hierarchy.radii.size();
  out.first.assign(radii + 1, 0);
  for (const std::uint32_t o : owner) {
    if (o != k_none) ++out.first[order.stored[o] + 1];
  }
  std::partial_sum(out.first.begin(), out.first.end(), out.first.begin());
  out.vertex.assign(out.first[radii], k_none);
  out.stored.assign(trunk.positions.size(), k_none);
  Indices next = out.first;
  const auto place = [&](std::uint32_t v, std::uint32_t radius) {
    out.stored[v] = next[order.stored[radius]]++;
    out.vertex[out.stored[v]] = v;
  };
  for (std::uint32_t r = 0; r < radii; ++r) {
    for (std::uint32_t i = hierarchy.first_vertex[r]; i < hierarchy.first_vertex[r + 1]; ++i) {
      place(hierarchy.ring_vertices[i], r);
    }
  }
  for (std::uint32_t v = 0; v < owner.size(); ++v) {
    if (owner[v] != k_none && out.stored[v] == k_none) place(v, owner[v]);
  }
  return out;
}

std::vector<Float3> store_vectors(const TrunkMesh& trunk, const VertexOrder& vertices, const Double3& origin,
                                  StoredRadii& radii) {
  std::vector<Float3> vectors(vertices.vertex.size());
  for (std::size_t r = 0; r < radii.radii.size(); ++r) {
    double outer = 0;
    for (std::uint32_t v = vertices.first[r]; v < vertices.first[r + 1]; ++v) {
      vectors[v] = to_float(trunk.positions[vertices.vertex[v]] - origin - radii.centres[r]);
      outer = std::max(outer, length(to_double(vectors[v])));
    }
    // hypot is good to an ulp of double; one more ulp of float32 is far above that.
    radii.radii[r].outer_radius = round_up(outer * (1 + 1e-15));
  }
  return vectors;
}

struct AreaDensity {
  Double3 centre;
  double mean = 0;
};

AreaDensity area_density(const TrunkMesh& trunk, const Double3& origin) {
  double total = 0;
  Double3 weighted{}, plain{};
  for (const Triangle& t : trunk.triangles) {
    const Double3 a = trunk.positions[t[0]] - origin, b = trunk.positions[t[1]] - origin,
                  c = trunk.positions[t[2]] - origin;
    const double area = 0.5 * length(cross(b - a, c - a));
    const Double3 centroid = (a + b + c) / 3.0;
    total += area, weighted += centroid * area, plain += centroid;
  }
  const auto n = static_cast<double>(trunk.triangles.size());
  if (n == 0) return {};
  return {total > 0 ? weighted / total : plain / n, total / n};  // hazard H15: no area at all
}

void store_lines(const Segments& segments, const Hierarchy& hierarchy, const Order& order,
                 const StoredRadii& radii, TreeKind kind, Trunk& trunk) {
  std::vector<float> diameters;
  std::vector<double> accumulated;
  std::vector<std::array<std::uint32_t, 2>> lines;
  Indices line_vertex(radii.radii.size(), k_none);
  std::vector<Float3> line_vertices;
  const auto end = [&](std::uint32_t radius) {
    if (kind == TreeKind::sensitive) return radius;
    if (line_vertex[radius] == k_none) {
      line_vertex[radius] = static_cast<std::uint32_t>(line_vertices.size());
      line_vertices.push_back(to_float(radii.centres[radius]));
    }
    return line_vertex[radius];
  };
  double sum = 0;
  for (const std::uint32_t old : segments.child) {
    const std::uint32_t child = order.stored[old], parent = order.stored[hierarchy.radii[old].parent];
    const std::uint32_t first = end(parent);
    lines.push_back({first, end(child)});
    diameters.push_back(std::max(radii.radii[child].diameter, radii.radii[parent].diameter));
    sum += distance(hierarchy.radii[old].centre, hierarchy.radii[hierarchy.radii[old].parent].centre);
    accumulated.push_back(sum);
  }
  trunk.lines = std::move(lines);
  trunk.diameters = std::move(diameters);
  trunk.accumulated_lengths = std::move(accumulated);
  trunk.line_vertices = std::move(line_vertices);
}

void store_triangles(const Mesh& mesh, const TrunkMesh& source, const Segments& segments,
                     const VertexOrder& vertices, Trunk& trunk) {
  CornerColumns columns(mesh, segments.triangles.size());
  std::vector<CornerTriangle> triangles(segments.triangles.size());
  Indices materials(segments.triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const std::uint32_t t = segments.triangles[i], original = source.source[t];
    triangles[i] = columns.corners(original);
    for (int c = 0; c < 3; ++c) triangles[i].vertex[c] = vertices.stored[source.triangles[t][c]];
    materials[i] = mesh.parts[mesh.part_of[original]].material;
  }
  trunk.triangles = std::move(triangles);
  trunk.normals = std::move(columns.normals);
  trunk.texcoords = std::move(columns.texcoords);
  store_materials(std::move(materials), trunk.material, trunk.materials);
}

}  // namespace

TrunkArrays make_trunk_arrays(const Mesh& mesh, const TrunkMesh& trunk, const Hierarchy& hierarchy,
                              TreeKind kind, const Double3& origin,
                              const std::vector<std::uint32_t>& group_of_radius) {
  TrunkArrays out;
  const Order order = breadth_first(hierarchy.radii);
  Indices owner = owners(trunk, hierarchy);
  Segments segments =
      sort_segments(hierarchy, order, choose_segments(trunk, hierarchy, owner, out.unexplained));
  StoredRadii radii = store_radii(hierarchy, order, origin, group_of_radius);
  const VertexOrder vertices = order_vertices(trunk, hierarchy, order, owner);
  owner = {};
  std::vector<Float3> vectors = store_vectors(trunk, vertices, origin, radii);

  out.segment_factor = constant_step(segments.first_triangle);
  store_lines(segments, hierarchy, order, radii, kind, out.trunk);
  store_triangles(mesh, trunk, segments, vertices, out.trunk);
  if (out.segment_factor == 0 && !segments.child.empty())
    out.trunk.first_triangle = std::move(segments.first_triangle);

  // What a reader will rebuild, in its own arithmetic: the bounds contain those very floats.
  std::vector<Float3> positions(kind == TreeKind::still ? vectors.size() : 0);
  for (std::size_t r = 0; r < radii.radii.size(); ++r) {
    for (std::uint32_t v = vertices.first[r]; v < vertices.first[r + 1]; ++v) {
      const Float3 position = to_float(radii.centres[r] + to_double(vectors[v]));
      if (!positions.empty()) positions[v] = position;
      out.bounds.grow(position);
    }
  }
  const AreaDensity density = area_density(trunk, origin);
  out.area_density_centre = to_float(density.centre);
  out.mean_area = static_cast<float>(density.mean);
  out.stored_radius = order.stored;
  if (kind == TreeKind::still) {
    out.trunk.vertices = std::move(positions);
    return out;
  }
  out.roots = order.roots;
  out.monotone = radii.monotone && !radii.radii.empty();
  out.ring_size = constant_step(vertices.first);
  if (out.ring_size == 0 && !radii.radii.empty()) out.hierarchy.first_vector = vertices.first;
  out.hierarchy.radii = std::move(radii.radii);
  out.hierarchy.vectors = std::move(vectors);
  return out;
}

}  // namespace copse
