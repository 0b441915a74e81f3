#include "tools/treedump/impostor_cross.h"

#include <array>
#include <utility>

namespace copse {
namespace {

constexpr float k_covered = 0.5f;  // of a pixel, to be drawn

std::uint32_t add_material(Mesh& mesh, const ImpostorAtlas& atlas) {
  Texture texture{.uri = {}, .mime = "image/png", .bytes = atlas.albedo.to_vector()};
  Material material{
      .name = "impostor", .diffuse = {1, 1, 1}, .alpha_cutoff = k_covered, .double_sided = true};
  material.texture = static_cast<std::uint32_t>(mesh.textures.size());
  mesh.textures.push_back(std::move(texture));
  mesh.materials.push_back(std::move(material));
  return static_cast<std::uint32_t>(mesh.materials.size() - 1);
}

// The corners of a view's picture, anticlockwise from the lower left one.
void append_view(Mesh& mesh, const ImpostorAtlas& atlas, std::uint32_t view, const Double3& origin) {
  const Double3 toward = impostor_views(atlas.layout, atlas.views)[view];
  const ImpostorFrame frame = impostor_frame(toward);
  const auto column = static_cast<float>(view % atlas.columns()),
             row = static_cast<float>(view / atlas.columns()), columns = static_cast<float>(atlas.columns()),
             rows = static_cast<float>(atlas.rows());
  const auto first = static_cast<std::uint32_t>(mesh.positions.size()),
             texcoords = static_cast<std::uint32_t>(mesh.texcoords.size()),
             normal = static_cast<std::uint32_t>(mesh.normals.size());
  mesh.normals.push_back(to_float(toward));
  for (const auto& [x, y] : {std::array{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
    mesh.positions.push_back(origin + to_double(atlas.centre) +
                             (frame.right * (2 * x - 1) + frame.up * (2 * y - 1)) * atlas.radius);
    mesh.texcoords.push_back(
        {(column + static_cast<float>(x)) / columns, 1 - (row + 1 - static_cast<float>(y)) / rows});
  }
  for (const Triangle& t : {Triangle{0, 1, 2}, Triangle{0, 2, 3}}) {
    mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    mesh.normal_triangles.push_back({normal, normal, normal});
    mesh.texcoord_triangles.push_back({texcoords + t[0], texcoords + t[1], texcoords + t[2]});
    mesh.part_of.push_back(static_cast<std::uint32_t>(mesh.parts.size() - 1));
  }
}

}  // namespace

void append_impostor_cross(Mesh& mesh, const ImpostorAtlas& atlas, const Double3& origin) {
  mesh.parts.push_back({.object = "impostor", .group = "impostor", .material = add_material(mesh, atlas)});
  for (const Double3& toward : {Double3{0, 0, 1}, Double3{1, 0, 0}})
    append_view(mesh, atlas, impostor_blend(atlas.layout, atlas.views, toward).view[0], origin);
}

}  // namespace copse
