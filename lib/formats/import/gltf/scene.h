// Which meshes the default scene of a glTF asset shows, and where.
#pragma once

#include "lib/formats/import/gltf/document.h"

#include <array>
#include <cstdint>
#include <vector>

namespace copse {

// x -> m x + t, columns first as in glTF.
struct Affine {
  std::array<Double3, 3> axes{Double3{1, 0, 0}, Double3{0, 1, 0}, Double3{0, 0, 1}};
  Double3 offset;

  Double3 vector(const Double3& v) const { return axes[0] * v.x + axes[1] * v.y + axes[2] * v.z; }
  Double3 point(const Double3& p) const { return vector(p) + offset; }
  double determinant() const { return dot(axes[0], cross(axes[1], axes[2])); }
  // For normals: the cofactors, which are the inverse transpose times the determinant, and exist even without
  // it.
  Double3 normal(const Double3& n) const {
    return cross(axes[1], axes[2]) * n.x + cross(axes[2], axes[0]) * n.y + cross(axes[0], axes[1]) * n.z;
  }
  friend Affine operator*(const Affine& a, const Affine& b) {
    return {{a.vector(b.axes[0]), a.vector(b.axes[1]), a.vector(b.axes[2])}, a.point(b.offset)};
  }
  friend bool operator==(const Affine&, const Affine&) = default;
};

struct GltfInstance {
  std::uint32_t mesh = k_none;
  std::uint32_t node = k_none;
};

struct GltfScene {
  std::vector<Affine> places;          // of all nodes; the identity for those that the scene does not show
  std::vector<std::uint32_t> parents;  // of all nodes, as they are shown; k_none of a root
  std::vector<GltfInstance> instances;
};

// The nodes of the default scene (the first one when none is said; all roots when there is no scene) that
// have a mesh, in depth-first order. A node is shown once, whatever the file says: that bounds cycles too.
bool read_scene(GltfDocument& document, GltfScene& out);

// EXT_mesh_gpu_instancing: the transforms of a node's instances, within the node; one identity without it.
bool read_instancing(GltfDocument& document, std::uint32_t node, std::vector<Affine>& out);

}  // namespace copse
