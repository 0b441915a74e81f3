// Every promise of import.h about what a Mesh holds, for tests and fuzzers.
#pragma once

#include "lib/formats/import/import.h"

#include <cmath>

namespace copse::testing {

inline bool in_range(const std::vector<Triangle>& triangles, std::size_t count, bool optional) {
  for (const Triangle& t : triangles) {
    for (const std::uint32_t i : t) {
      if (i >= count && !(optional && i == k_none)) return false;
    }
  }
  return true;
}

// What is broken, or null.
inline const char* broken_promise(const Mesh& mesh) {
  for (const Double3& p : mesh.positions) {
    if (!is_finite(p)) return "a position is not finite";
  }
  for (const Float3& n : mesh.normals) {
    if (!is_finite(n)) return "a normal is not finite";
  }
  for (const Float2& t : mesh.texcoords) {
    if (!std::isfinite(t.x) || !std::isfinite(t.y)) return "a texture coordinate is not finite";
  }
  const std::size_t count = mesh.triangles.size();
  const auto fits = [count](const auto& v) { return v.empty() || v.size() == count; };
  if (mesh.part_of.size() != count) return "not every triangle has a part";
  if (!fits(mesh.normal_triangles) || !fits(mesh.texcoord_triangles) || !fits(mesh.face_of))
    return "arrays of one entry a triangle differ in length";
  if (!in_range(mesh.triangles, mesh.positions.size(), false)) return "a triangle names a missing position";
  if (!in_range(mesh.normal_triangles, mesh.normals.size(), true)) return "a corner names a missing normal";
  if (!in_range(mesh.texcoord_triangles, mesh.texcoords.size(), true))
    return "a corner names a missing texture coordinate";
  for (const Triangle& t : mesh.triangles) {
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) return "a triangle has a corner twice";
  }
  for (const std::uint32_t part : mesh.part_of) {
    if (part >= mesh.parts.size()) return "a triangle names a missing part";
  }
  for (const Part& part : mesh.parts) {
    if (part.material != k_none && part.material >= mesh.materials.size())
      return "a part names a missing material";
  }
  for (const Material& m : mesh.materials) {
    if (m.texture != k_none && m.texture >= mesh.textures.size()) return "a material names a missing texture";
  }
  return nullptr;
}

inline const char* broken_promise(const Import& import) {
  for (std::size_t g = 0; g < import.groups.size(); ++g) {
    if (import.groups[g].parent != k_none && import.groups[g].parent >= g)
      return "a group's parent is no earlier one";
  }
  if (import.group_of.size() != (import.groups.empty() ? 0 : import.mesh.triangles.size()))
    return "not every triangle is told its group";
  for (const std::uint32_t group : import.group_of) {
    if (group != k_none && group >= import.groups.size()) return "a triangle names a missing group";
  }
  return broken_promise(import.mesh);
}

}  // namespace copse::testing
