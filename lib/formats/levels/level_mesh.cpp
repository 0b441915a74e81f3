#include "lib/formats/levels/level_mesh.h"

#include <algorithm>
#include <map>

namespace copse {
namespace {

// Three index lists of a mesh, all or none of which are there.
void match_corner_lists(Mesh& mesh) {
  const Triangle none{k_none, k_none, k_none};
  mesh.normal_triangles.resize(mesh.triangles.size(), none);
  mesh.texcoord_triangles.resize(mesh.triangles.size(), none);
}

}  // namespace

void append_state(Mesh& mesh, const Spectrum& spectrum, std::uint32_t steps, const std::string& name,
                  const Double3& origin) {
  match_corner_lists(mesh);
  const std::uint32_t n = std::min(steps, spectrum.steps());
  std::vector<std::uint32_t> position(spectrum.vertices.size(), k_none);
  const auto normals = static_cast<std::uint32_t>(mesh.normals.size()),
             texcoords = static_cast<std::uint32_t>(mesh.texcoords.size()),
             positions = static_cast<std::uint32_t>(mesh.positions.size());
  std::uint32_t used = 0;
  const auto number = [&](std::uint32_t v) {
    if (position[v] != k_none) return position[v];
    const SpectrumVertex& vertex = spectrum.vertices[v];
    mesh.positions.push_back(origin + to_double(vertex.position));
    mesh.normals.push_back(vertex.normal);
    mesh.texcoords.push_back(vertex.texcoord);
    return position[v] = used++;
  };
  std::map<std::uint32_t, std::uint32_t> parts;
  for (std::size_t e = 0; e < spectrum.elements.size(); ++e) {
    const SpectrumElement& element = spectrum.elements[e];
    if (n < element.birth || n >= element.death) continue;
    const auto [part, is_new] =
        parts.try_emplace(element.material, static_cast<std::uint32_t>(mesh.parts.size()));
    if (is_new) mesh.parts.push_back({.object = name, .group = name, .material = element.material});
    for (std::uint32_t t = spectrum.first_triangle[e]; t < spectrum.first_triangle[e + 1]; ++t) {
      Triangle at{};
      for (std::size_t c = 0; c < 3; ++c) at[c] = number(spectrum.triangles[t][c]);
      mesh.triangles.push_back({positions + at[0], positions + at[1], positions + at[2]});
      mesh.normal_triangles.push_back({normals + at[0], normals + at[1], normals + at[2]});
      mesh.texcoord_triangles.push_back({texcoords + at[0], texcoords + at[1], texcoords + at[2]});
      mesh.part_of.push_back(part->second);
    }
  }
}

Mesh level_mesh(const LodSpectra& spectra, const LodLevel& level, const Double3& origin) {
  Mesh mesh;
  append_state(mesh, spectra.trunk, level.trunk_steps, "trunk", origin);
  append_state(mesh, spectra.leaves, level.leaf_steps, "leaves", origin);
  return mesh;
}

}  // namespace copse
