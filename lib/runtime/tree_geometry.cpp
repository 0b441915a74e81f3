#include "lib/runtime/tree_geometry.h"

#include <algorithm>
#include <bit>
#include <numeric>

namespace copse {

namespace {

// One part of a tree or mesh, however it is stored: corners in the order in which they are to be drawn.
struct PartView {
  std::span<const Float3> positions, normals;
  std::span<const Float2> texcoords;
  std::vector<CornerTriangle> triangles;
  std::vector<std::uint32_t> materials;  // one a triangle
  DrawPart part = DrawPart::trunk;
};

Double3 face_vector(const PartView& part, const CornerTriangle& t) {
  const Double3 a = to_double(part.positions[t.vertex[0]]);
  return cross(to_double(part.positions[t.vertex[1]]) - a, to_double(part.positions[t.vertex[2]]) - a);
}

double angle_at(const PartView& part, const CornerTriangle& t, std::size_t corner) {
  const Double3 p = to_double(part.positions[t.vertex[corner]]);
  const Double3 u = to_double(part.positions[t.vertex[(corner + 1) % 3]]) - p;
  const Double3 v = to_double(part.positions[t.vertex[(corner + 2) % 3]]) - p;
  return std::atan2(length(cross(u, v)), dot(u, v));
}

bool needs_normals(const PartView& part) {
  return std::any_of(part.triangles.begin(), part.triangles.end(), [](const CornerTriangle& t) {
    return t.normal[0] == k_none || t.normal[1] == k_none || t.normal[2] == k_none;
  });
}

// The angle-weighted sum of the face normals round each vertex, not normalized.
std::vector<Double3> smooth_normals(const PartView& part) {
  std::vector<Double3> sum(part.positions.size());
  for (const CornerTriangle& t : part.triangles) {
    const Double3 face = normalized(face_vector(part, t), {});
    for (std::size_t c = 0; c < 3; ++c) sum[t.vertex[c]] += face * angle_at(part, t, c);
  }
  return sum;
}

Float3 computed_normal(const Double3& sum, const Double3& face_of_corner) {
  const Double3 face = normalized(face_of_corner);
  const Double3 smooth = normalized(sum, face);
  return to_float(dot(smooth, face) > 0.5 ? smooth : face);
}

// Gives equal corners one vertex: an open hash table from (vertex, normal, texture coordinate), by value, to
// the vertex that was made for it. Vertices are numbered by first use, so the table's layout never shows.
class CornerTable {
 public:
  CornerTable(std::vector<DrawVertex>& vertices, std::size_t expected)
      : vertices_(vertices), slots_(std::bit_ceil(2 * expected + 16), k_none) {}

  std::uint32_t index_of(std::uint32_t source, const DrawVertex& vertex) {
    if (2 * (sources_.size() + 1) > slots_.size()) grow();
    for (std::size_t slot = hash(source, vertex);; ++slot) {
      std::uint32_t& entry = slots_[slot & (slots_.size() - 1)];
      if (entry == k_none) {
        entry = static_cast<std::uint32_t>(sources_.size());
        sources_.push_back(source);
        vertices_.push_back(vertex);
        return static_cast<std::uint32_t>(vertices_.size() - 1);
      }
      const std::size_t at = vertices_.size() - sources_.size() + entry;
      if (sources_[entry] == source && vertices_[at] == vertex) return static_cast<std::uint32_t>(at);
    }
  }

 private:
  static std::uint64_t mix(std::uint64_t h, float f) {
    h = (h ^ std::bit_cast<std::uint32_t>(f + 0.0f)) * 0x9e3779b97f4a7c15u;  // + 0: -0 equals 0
    return h ^ (h >> 29);
  }
  static std::size_t hash(std::uint32_t source, const DrawVertex& v) {
    std::uint64_t h = (source + 1) * 0xbf58476d1ce4e5b9u;
    for (const float f : {v.normal.x, v.normal.y, v.normal.z, v.texcoord.x, v.texcoord.y}) h = mix(h, f);
    return static_cast<std::size_t>(h ^ (h >> 32));
  }
  void grow() {
    std::vector<std::uint32_t> larger(slots_.size() * 2, k_none);
    const std::size_t base = vertices_.size() - sources_.size();
    for (std::uint32_t entry = 0; entry < sources_.size(); ++entry) {
      std::size_t slot = hash(sources_[entry], vertices_[base + entry]);
      while (larger[slot & (larger.size() - 1)] != k_none) ++slot;
      larger[slot & (larger.size() - 1)] = entry;
    }
    slots_ = std::move(larger);
  }

  std::vector<DrawVertex>& vertices_;
  std::vector<std::uint32_t> sources_;  // of the vertices that this table has added
  std::vector<std::uint32_t> slots_;
};

// The triangles of a part by ascending material, otherwise in their order.
std::vector<std::uint32_t> by_material(const PartView& part) {
  std::vector<std::uint32_t> order(part.triangles.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return part.materials[a] != part.materials[b] ? part.materials[a] < part.materials[b] : a < b;
  });
  return order;
}

Float3 unit(const Float3& stored, const Double3& face) {
  return to_float(normalized(to_double(stored), normalized(face)));
}

void append(TreeGeometry& geometry, const PartView& part) {
  const std::vector<Double3> smooth = needs_normals(part) ? smooth_normals(part) : std::vector<Double3>{};
  CornerTable table(geometry.vertices, part.positions.size());
  geometry.indices.reserve(geometry.indices.size() + 3 * part.triangles.size());
  for (const std::uint32_t i : by_material(part)) {
    const CornerTriangle& t = part.triangles[i];
    const std::uint32_t material = part.materials[i];
    const auto first = static_cast<std::uint32_t>(geometry.indices.size());
    if (geometry.ranges.empty() || geometry.ranges.back().material != material ||
        geometry.ranges.back().part != part.part) {
      geometry.ranges.push_back({part.part, material, first, 0});
    }
    const Double3 face = face_vector(part, t);
    for (std::size_t c = 0; c < 3; ++c) {
      DrawVertex v;
      v.position = part.positions[t.vertex[c]];
      v.normal = t.normal[c] == k_none ? computed_normal(smooth[t.vertex[c]], face)
                                       : unit(part.normals[t.normal[c]], face);
      if (t.texcoord[c] != k_none) v.texcoord = part.texcoords[t.texcoord[c]];
      geometry.bounds.grow(v.position);
      geometry.indices.push_back(table.index_of(t.vertex[c], v));
    }
    geometry.ranges.back().index_count += 3;
  }
}

PartView trunk_part(const Tree& tree, std::span<const Float3> vertices) {
  const Trunk& trunk = tree.trunk;
  PartView part{vertices, trunk.normals, trunk.texcoords, trunk.triangles.to_vector(), {}, DrawPart::trunk};
  part.materials = trunk.materials.empty() ? std::vector<std::uint32_t>(part.triangles.size(), trunk.material)
                                           : trunk.materials.to_vector();
  return part;
}

PartView leaf_part(const Tree& tree) {
  const Leaves& leaves = tree.leaves;
  PartView part{leaves.vertices, leaves.normals, leaves.texcoords, {}, {}, DrawPart::leaves};
  part.triangles.reserve(leaves.triangles.size());
  part.materials.reserve(leaves.triangles.size());
  const bool grouped = leaves.order.size() == tree.leaf_count();
  for (std::size_t i = 0; i < tree.leaf_count(); ++i) {
    const std::size_t leaf = grouped ? leaves.order[i] : i;
    for (std::size_t t = tree.first_triangle_of_leaf(leaf); t < tree.first_triangle_of_leaf(leaf + 1); ++t) {
      part.triangles.push_back(leaves.triangles[t]);
      part.materials.push_back(leaves.materials.empty() ? leaves.material : leaves.materials[leaf]);
    }
  }
  return part;
}

Double3 origin_for(const DoubleBox& box) {
  if (box.empty()) return {};
  const Double3 centre = box.centre();
  return length(centre) > 1000 * length(box.extent()) ? centre : Double3{};
}

CornerTriangle corners(const Mesh& mesh, std::size_t t) {
  CornerTriangle c;
  c.vertex = mesh.triangles[t];
  if (!mesh.normal_triangles.empty()) c.normal = mesh.normal_triangles[t];
  if (!mesh.texcoord_triangles.empty()) c.texcoord = mesh.texcoord_triangles[t];
  return c;
}

}  // namespace

TreeGeometry make_geometry(const Tree& tree) {
  TreeGeometry geometry;
  geometry.origin = tree.header.origin;
  const std::vector<Float3> vertices = trunk_vertices(tree);
  append(geometry, trunk_part(tree, vertices));
  append(geometry, leaf_part(tree));
  return geometry;
}

TreeGeometry make_geometry(const Mesh& mesh) {
  TreeGeometry geometry;
  geometry.origin = origin_for(bounds(mesh));
  std::vector<Float3> positions(mesh.positions.size());
  std::transform(mesh.positions.begin(), mesh.positions.end(), positions.begin(),
                 [&](const Double3& p) { return to_float(p - geometry.origin); });
  PartView part{positions, mesh.normals, mesh.texcoords, {}, {}, DrawPart::mesh};
  part.triangles.resize(mesh.triangles.size());
  part.materials.resize(mesh.triangles.size(), k_none);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    part.triangles[t] = corners(mesh, t);
    if (!mesh.part_of.empty()) part.materials[t] = mesh.parts[mesh.part_of[t]].material;
  }
  append(geometry, part);
  return geometry;
}

}  // namespace copse
