#include "lib/formats/import/gltf/scene.h"

#include "lib/formats/import/gltf/accessor.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace copse {
namespace {

// Rotation by a quaternion (x, y, z, w), which need not be of length 1, after scaling.
Affine compose(const Double3& translation, const std::array<double, 4>& q, const Double3& scale) {
  const double size = std::max({std::abs(q[0]), std::abs(q[1]), std::abs(q[2]), std::abs(q[3])});
  Affine out;
  out.offset = translation;
  if (size > 0) {
    const double qx = q[0] / size, qy = q[1] / size, qz = q[2] / size, qw = q[3] / size;
    const double s = 2 / (qx * qx + qy * qy + qz * qz + qw * qw);
    out.axes[0] = {1 - s * (qy * qy + qz * qz), s * (qx * qy + qz * qw), s * (qx * qz - qy * qw)};
    out.axes[1] = {s * (qx * qy - qz * qw), 1 - s * (qx * qx + qz * qz), s * (qy * qz + qx * qw)};
    out.axes[2] = {s * (qx * qz + qy * qw), s * (qy * qz - qx * qw), 1 - s * (qx * qx + qy * qy)};
  }
  out.axes[0] *= scale.x;
  out.axes[1] *= scale.y;
  out.axes[2] *= scale.z;
  return out;
}

bool read_transform(const JsonValue& node, MeshBuilder& builder, Affine& out) {
  if (node["matrix"].exists()) {
    std::array<double, 16> m{};
    if (!node["matrix"].read(m, builder)) return false;
    if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1)
      builder.notes.add("matrices with a projection",
                        fmt::format("{}.matrix has a last row, which is left out", node.path()));
    out = {{Double3{m[0], m[1], m[2]}, Double3{m[4], m[5], m[6]}, Double3{m[8], m[9], m[10]}},
           {m[12], m[13], m[14]}};
    return true;
  }
  std::array<double, 3> t{}, s{1, 1, 1};
  std::array<double, 4> r{0, 0, 0, 1};
  if (!node["translation"].read(t, builder) || !node["rotation"].read(r, builder) ||
      !node["scale"].read(s, builder))
    return false;
  out = compose({t[0], t[1], t[2]}, r, {s[0], s[1], s[2]});
  return true;
}

class SceneReader {
 public:
  SceneReader(GltfDocument& document, GltfScene& out)
      : document_(document),
        builder_(document.builder()),
        nodes_(document.root()["nodes"]),
        meshes_(document.root()["meshes"].size()),
        out_(out) {}

  bool read() {
    parent_.assign(nodes_.size(), k_none);
    visited_.assign(nodes_.size(), false);
    out_.places.assign(nodes_.size(), {});
    out_.parents.assign(nodes_.size(), k_none);
    std::vector<std::uint32_t> roots;
    if (!find_parents() || !find_roots(roots)) return false;
    for (const std::uint32_t root : roots) {
      if (!visited_[root] && !visit(root)) return false;
    }
    return true;
  }

 private:
  bool child(std::uint32_t node, std::size_t i, std::uint32_t& out) {
    return nodes_.at(node)["children"].at(i).read_index(out, nodes_.size(), builder_);
  }

  bool find_parents() {
    for (std::uint32_t node = 0; node < parent_.size(); ++node) {
      const std::size_t children = nodes_.at(node)["children"].size();
      for (std::size_t i = 0; i < children; ++i) {
        std::uint32_t c = k_none;
        if (!child(node, i, c)) return false;
        if (parent_[c] != k_none)
          builder_.notes.add("nodes with two parents",
                             fmt::format("nodes[{}] is a child of nodes[{}] and nodes[{}]; it is read once",
                                         c, parent_[c], node));
        else
          parent_[c] = node;
      }
    }
    return true;
  }

  bool find_roots(std::vector<std::uint32_t>& roots) {
    const JsonValue scenes = document_.root()["scenes"];
    if (scenes.size() == 0) {
      for (std::uint32_t node = 0; node < parent_.size(); ++node) {
        if (parent_[node] == k_none) roots.push_back(node);
      }
      return true;
    }
    std::uint32_t scene = 0;
    if (!document_.root()["scene"].read_index(scene, scenes.size(), builder_)) return false;
    if (scenes.size() > 1)
      builder_.notes.add("scenes not read",
                         fmt::format("of {} scenes only scenes[{}] is read", scenes.size(), scene));
    const JsonValue listed = scenes.at(scene)["nodes"];
    std::vector<std::uint32_t> names;
    std::vector<char> is_listed(parent_.size(), 0);
    for (std::size_t i = 0; i < listed.size(); ++i) {
      std::uint32_t node = k_none;
      if (!listed.at(i).read_index(node, nodes_.size(), builder_)) return false;
      names.push_back(node);
      is_listed[node] = 1;
    }
    below_listed_.assign(parent_.size(), unknown);
    for (const std::uint32_t node : names) {
      if (parent_[node] != k_none)
        builder_.notes.add("scene nodes that have a parent",
                           fmt::format("scenes[{}] names nodes[{}], which is a child of nodes[{}]", scene,
                                       node, parent_[node]));
      // One that hangs below another one of the list is reached from there.
      if (!is_below_listed(node, is_listed)) roots.push_back(node);
    }
    return true;
  }

  // Whether a proper ancestor of `node` is listed. Every node is climbed through once.
  bool is_below_listed(std::uint32_t node, const std::vector<char>& is_listed) {
    std::vector<std::uint32_t> chain;
    std::uint32_t at = node;
    State answer = no;
    while (true) {
      if (below_listed_[at] == climbing) break;  // a cycle
      if (below_listed_[at] != unknown) {
        answer = below_listed_[at];
        break;
      }
      below_listed_[at] = climbing;
      chain.push_back(at);
      if (parent_[at] == k_none) break;
      at = parent_[at];
    }
    // Downwards again: below a listed node everything is.
    for (auto it = chain.rbegin(); it != chain.rend(); ++it) {
      if (parent_[*it] != k_none && is_listed[parent_[*it]] != 0 && below_listed_[parent_[*it]] != climbing)
        answer = yes;
      below_listed_[*it] = answer;
    }
    return below_listed_[node] == yes;
  }

  bool visit(std::uint32_t root) {
    struct Step {
      std::uint32_t node, parent;
    };
    std::vector<Step> stack{{root, k_none}};
    while (!stack.empty()) {
      const Step step = stack.back();
      stack.pop_back();
      if (visited_[step.node]) continue;
      visited_[step.node] = true;
      const JsonValue node = nodes_.at(step.node);
      Affine local;
      if (!read_transform(node, builder_, local)) return false;
      out_.parents[step.node] = step.parent;
      out_.places[step.node] = step.parent == k_none ? local : out_.places[step.parent] * local;
      std::uint32_t mesh = k_none;
      if (!node["mesh"].read_index(mesh, meshes_, builder_)) return false;
      if (mesh != k_none) out_.instances.push_back({mesh, step.node});
      for (std::size_t i = node["children"].size(); i-- > 0;) {
        std::uint32_t c = k_none;
        if (!child(step.node, i, c)) return false;
        if (!visited_[c]) stack.push_back({c, step.node});
      }
    }
    return true;
  }

  enum State : std::uint8_t { unknown, climbing, yes, no };

  GltfDocument& document_;
  MeshBuilder& builder_;
  JsonValue nodes_;
  std::size_t meshes_;
  GltfScene& out_;
  std::vector<std::uint32_t> parent_;
  std::vector<bool> visited_;
  std::vector<State> below_listed_;
};

}  // namespace

bool read_scene(GltfDocument& document, GltfScene& out) {
  return SceneReader(document, out).read();
}

bool read_instancing(GltfDocument& document, std::uint32_t node, std::vector<Affine>& out) {
  out.assign(1, {});
  const JsonValue extension = document.root()["nodes"].at(node)["extensions"]["EXT_mesh_gpu_instancing"];
  if (!extension.exists()) return true;
  MeshBuilder& builder = document.builder();
  const auto read = [&](const char* name, std::uint32_t components, std::vector<double>& numbers) {
    std::uint32_t index = k_none;
    GltfAccessor accessor;
    if (!extension["attributes"][name].read_index(index, document.root()["accessors"].size(), builder))
      return false;
    if (index == k_none) return true;
    if (!open_accessor(document, index, accessor)) return false;
    if (accessor.components != components)
      return builder.refuse(fmt::format("{} does not suit {}", accessor.path, name), k_gltf_remedy);
    numbers.resize(accessor.count * components);
    read_numbers(accessor, components, std::span<double>(numbers));
    return true;
  };
  std::vector<double> t, r, s;
  if (!read("TRANSLATION", 3, t) || !read("ROTATION", 4, r) || !read("SCALE", 3, s)) return false;
  const std::size_t count = std::max({t.size() / 3, r.size() / 4, s.size() / 3});
  const auto agrees = [&](std::size_t have) { return have == 0 || have == count; };
  if (!agrees(t.size() / 3) || !agrees(r.size() / 4) || !agrees(s.size() / 3))
    return builder.refuse(extension.path() + ": its attributes have different counts", k_gltf_remedy);
  if (count == 0) return true;
  out.clear();
  for (std::size_t i = 0; i < count; ++i) {
    const Double3 translation = t.empty() ? Double3{} : Double3{t[3 * i], t[3 * i + 1], t[3 * i + 2]};
    const Double3 scale = s.empty() ? Double3{1, 1, 1} : Double3{s[3 * i], s[3 * i + 1], s[3 * i + 2]};
    const std::array<double, 4> rotation =
        r.empty() ? std::array<double, 4>{0, 0, 0, 1}
                  : std::array<double, 4>{r[4 * i], r[4 * i + 1], r[4 * i + 2], r[4 * i + 3]};
    out.push_back(compose(translation, rotation, scale));
  }
  return true;
}

}  // namespace copse
