#include "lib/formats/levels/part_triangles.h"

#include <span>

namespace copse {
namespace {

struct Surface {
  std::span<const CornerTriangle> triangles;
  std::span<const Float3> vertices, normals;
  std::span<const Float2> texcoords;
};

// Of every vertex, the sum of the normals of its faces, as long as twice their areas.
std::vector<Double3> face_sums(const Surface& surface) {
  std::vector<Double3> sums(surface.vertices.size());
  for (const CornerTriangle& t : surface.triangles) {
    const Double3 a = to_double(surface.vertices[t.vertex[0]]), b = to_double(surface.vertices[t.vertex[1]]),
                  c = to_double(surface.vertices[t.vertex[2]]);
    const Double3 n = cross(b - a, c - a);
    for (const std::uint32_t v : t.vertex) sums[v] += n;
  }
  return sums;
}

bool lacks_normals(const Surface& surface) {
  if (surface.normals.empty()) return true;
  for (const CornerTriangle& t : surface.triangles) {
    for (const std::uint32_t n : t.normal) {
      if (n == k_none) return true;
    }
  }
  return false;
}

// Numbers corners; those of one vertex hang in a chain.
class Unifier {
 public:
  Unifier(const Surface& surface, PartTriangles& out) : surface_(surface), out_(out) {
    head_.assign(surface.vertices.size(), k_none);
    if (lacks_normals(surface)) sums_ = face_sums(surface);
  }

  std::uint32_t corner(const CornerTriangle& t, std::size_t c) {
    const std::uint32_t v = t.vertex[c], n = surface_.normals.empty() ? k_none : t.normal[c],
                        x = surface_.texcoords.empty() ? k_none : t.texcoord[c];
    for (std::uint32_t i = head_[v]; i != k_none; i = chain_[i].next) {
      if (chain_[i].normal == n && chain_[i].texcoord == x) return i;
    }
    const auto number = static_cast<std::uint32_t>(chain_.size());
    chain_.push_back({n, x, head_[v]});
    head_[v] = number;
    out_.vertices.push_back({surface_.vertices[v],
                             n != k_none ? surface_.normals[n] : to_float(normalized(sums_[v])),
                             x != k_none ? surface_.texcoords[x] : Float2{}});
    out_.position_of.push_back(v);
    return number;
  }

 private:
  struct Link {
    std::uint32_t normal, texcoord, next;
  };
  const Surface& surface_;
  PartTriangles& out_;
  std::vector<std::uint32_t> head_;
  std::vector<Link> chain_;
  std::vector<Double3> sums_;
};

PartTriangles unify(const Surface& surface) {
  PartTriangles out;
  if (surface.vertices.empty()) return out;
  Unifier unifier(surface, out);
  out.triangles.reserve(surface.triangles.size());
  for (const CornerTriangle& t : surface.triangles)
    out.triangles.push_back({unifier.corner(t, 0), unifier.corner(t, 1), unifier.corner(t, 2)});
  return out;
}

}  // namespace

PartTriangles trunk_triangles(const Tree& tree) {
  const std::vector<Float3> vertices = trunk_vertices(tree);
  const Trunk& trunk = tree.trunk;
  PartTriangles out = unify({trunk.triangles, vertices, trunk.normals, trunk.texcoords});
  if (trunk.materials.empty()) {
    out.materials.assign(out.triangles.size(), trunk.material);
  } else {
    out.materials.assign(trunk.materials.begin(),
                         trunk.materials.begin() + static_cast<std::ptrdiff_t>(out.triangles.size()));
  }
  return out;
}

PartTriangles leaf_triangles(const Tree& tree) {
  const Leaves& leaves = tree.leaves;
  PartTriangles out = unify({leaves.triangles, leaves.vertices, leaves.normals, leaves.texcoords});
  out.materials.assign(out.triangles.size(), leaves.material);
  if (leaves.materials.empty()) return out;
  for (std::size_t leaf = 0; leaf < tree.leaf_count(); ++leaf) {
    for (std::size_t t = tree.first_triangle_of_leaf(leaf); t < tree.first_triangle_of_leaf(leaf + 1); ++t)
      if (t < out.materials.size()) out.materials[t] = leaves.materials[leaf];
  }
  return out;
}

}  // namespace copse
