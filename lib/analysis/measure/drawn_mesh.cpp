#include "lib/analysis/measure/drawn_mesh.h"

#include <cmath>
#include <unordered_map>

namespace copse {
namespace {

struct CornerKey {
  std::uint32_t vertex, normal, texcoord;
  friend bool operator==(const CornerKey&, const CornerKey&) = default;
};

struct CornerHash {
  std::size_t operator()(const CornerKey& k) const {
    return ((k.vertex * 0x9e3779b97f4a7c15u) ^ (k.normal * 0xc2b2ae3d27d4eb4fu)) +
           k.texcoord * 0x165667b19e3779f9u;
  }
};

// Puts corners together; looked up by key only, so the hash table's order never shows.
class Unifier {
 public:
  Unifier(std::span<const Float3> vertices, std::span<const Float3> normals,
          std::span<const Float2> texcoords)
      : vertices_(vertices), normals_(normals), texcoords_(texcoords) {}

  void add(const CornerTriangle& t, std::uint32_t material) {
    Triangle out{};
    for (int c = 0; c < 3; ++c) out[c] = index({t.vertex[c], t.normal[c], t.texcoord[c]});
    mesh_.triangles.push_back(out);
    mesh_.material.push_back(material);
  }
  DrawnMesh take() { return std::move(mesh_); }

 private:
  std::uint32_t index(const CornerKey& key) {
    const auto [at, fresh] = seen_.try_emplace(key, static_cast<std::uint32_t>(mesh_.positions.size()));
    if (fresh) {
      mesh_.positions.push_back(to_double(vertices_[key.vertex]));
      if (!normals_.empty()) mesh_.normals.push_back(key.normal == k_none ? Float3{} : normals_[key.normal]);
      if (!texcoords_.empty())
        mesh_.texcoords.push_back(key.texcoord == k_none ? Float2{} : texcoords_[key.texcoord]);
    }
    return at->second;
  }

  std::span<const Float3> vertices_, normals_;
  std::span<const Float2> texcoords_;
  std::unordered_map<CornerKey, std::uint32_t, CornerHash> seen_;
  DrawnMesh mesh_;
};

double wrap(double t) {
  const double f = t - std::floor(t);
  return std::isfinite(f) ? f : 0;
}

AlphaMask mask_of(const Material& material, const TextureImage& image) {
  AlphaMask mask{image.width, image.height, {}};
  const double cutoff = material.alpha_cutoff > 0 ? material.alpha_cutoff : 0.5;
  mask.opaque.resize(static_cast<std::size_t>(image.width) * image.height);
  bool all = true;
  for (std::size_t i = 0; i < mask.opaque.size(); ++i) {
    mask.opaque[i] = image.rgba[4 * i + 3] / 255.0 * material.alpha >= cutoff;
    all = all && mask.opaque[i];
  }
  return all ? AlphaMask{} : mask;
}

}  // namespace

// Most coordinates need no wrapping, and floor is a call.
static double inside_tile(double x) {
  return x >= 0 && x < 1 ? x : wrap(x);
}

bool AlphaMask::passes(double u, double v) const {
  if (opaque.empty()) return true;
  const int x = std::min(static_cast<int>(inside_tile(u) * width), width - 1);
  const int y = std::min(static_cast<int>(inside_tile(1 - v) * height), height - 1);
  return opaque[static_cast<std::size_t>(y) * width + x] != 0;
}

std::vector<AlphaMask> alpha_masks(std::span<const Material> materials, const ImageSource& images) {
  std::vector<AlphaMask> masks(materials.size());
  for (std::size_t m = 0; m < materials.size(); ++m) {
    if (materials[m].texture == k_none || !images) continue;
    if (const auto image = images(materials[m].texture)) masks[m] = mask_of(materials[m], *image);
  }
  return masks;
}

DrawnMesh drawn_leaves(const Tree& tree) {
  const Leaves& leaves = tree.leaves;
  Unifier unify(leaves.vertices, leaves.normals, leaves.texcoords);
  for (std::size_t l = 0; l < tree.leaf_count(); ++l) {
    const std::uint32_t material = leaves.materials.empty() ? leaves.material : leaves.materials[l];
    const std::size_t end = std::min(tree.first_triangle_of_leaf(l + 1), leaves.triangles.size());
    for (std::size_t t = tree.first_triangle_of_leaf(l); t < end; ++t)
      unify.add(leaves.triangles[t], material);
  }
  return unify.take();
}

DrawnMesh drawn_trunk(const Tree& tree) {
  const std::vector<Float3> vertices = trunk_vertices(tree);
  Unifier unify(vertices, tree.trunk.normals, tree.trunk.texcoords);
  for (std::size_t t = 0; t < tree.trunk.triangles.size(); ++t)
    unify.add(tree.trunk.triangles[t],
              tree.trunk.materials.empty() ? tree.trunk.material : tree.trunk.materials[t]);
  return unify.take();
}

namespace {

template <class Drawn>
DrawnMesh drawn_where(const Spectrum& spectrum, Drawn drawn) {
  DrawnMesh mesh;
  std::vector<std::uint32_t> at(spectrum.vertices.size(), k_none);
  for (std::size_t e = 0; e < spectrum.elements.size(); ++e) {
    const SpectrumElement& element = spectrum.elements[e];
    if (!drawn(e)) continue;
    for (std::uint32_t t = spectrum.first_triangle[e]; t < spectrum.first_triangle[e + 1]; ++t) {
      Triangle corners{};
      for (int c = 0; c < 3; ++c) {
        const std::uint32_t v = spectrum.triangles[t][c];
        if (at[v] == k_none) {
          at[v] = static_cast<std::uint32_t>(mesh.positions.size());
          mesh.positions.push_back(to_double(spectrum.vertices[v].position));
          mesh.normals.push_back(spectrum.vertices[v].normal);
          mesh.texcoords.push_back(spectrum.vertices[v].texcoord);
        }
        corners[c] = at[v];
      }
      mesh.triangles.push_back(corners);
      mesh.material.push_back(element.material);
    }
  }
  return mesh;
}

}  // namespace

DrawnMesh drawn_state(const Spectrum& spectrum, std::uint32_t steps) {
  return drawn_where(spectrum, [&](std::size_t e) {
    return spectrum.elements[e].birth <= steps && spectrum.elements[e].death > steps;
  });
}

DrawnMesh drawn_elements(const Spectrum& spectrum, std::span<const std::uint8_t> drawn) {
  return drawn_where(spectrum, [&](std::size_t e) { return drawn[e] != 0; });
}

void append(DrawnMesh& mesh, const DrawnMesh& more) {
  const auto base = static_cast<std::uint32_t>(mesh.positions.size());
  const auto pad = [&](auto& to, const auto& from, std::size_t before, std::size_t after) {
    if (to.empty() && from.empty()) return;
    to.resize(before);
    to.insert(to.end(), from.begin(), from.end());
    to.resize(after);
  };
  const std::size_t after = base + more.positions.size();
  pad(mesh.normals, more.normals, base, after);
  pad(mesh.texcoords, more.texcoords, base, after);
  mesh.positions.insert(mesh.positions.end(), more.positions.begin(), more.positions.end());
  for (const Triangle& t : more.triangles) mesh.triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
  mesh.material.insert(mesh.material.end(), more.material.begin(), more.material.end());
}

double area(const DrawnMesh& mesh, std::uint32_t triangle) {
  const Triangle& t = mesh.triangles[triangle];
  const Double3 a = mesh.positions[t[0]];
  return 0.5 * length(cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a));
}

double area(const DrawnMesh& mesh) {
  double sum = 0;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) sum += area(mesh, t);
  return sum;
}

DoubleBox bounds(const DrawnMesh& mesh) {
  DoubleBox box;
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t) box.grow(mesh.positions[v]);
  return box;
}

}  // namespace copse
