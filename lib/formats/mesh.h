// A triangle mesh as it was imported: nothing welded, nothing reordered, every corner with its own indices.
#pragma once

#include "lib/formats/material.h"
#include "lib/formats/vec.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace copse {

using Triangle = std::array<std::uint32_t, 3>;  // counter-clockwise seen from the front

// Where a triangle comes from: what globs such as --trunk and --leaf are matched against.
struct Part {
  std::string object;               // OBJ `o`, glTF node or mesh name
  std::string group;                // OBJ `g`, glTF primitive's parent mesh
  std::uint32_t material = k_none;  // index into Mesh::materials
  friend bool operator==(const Part&, const Part&) = default;
};

struct Mesh {
  std::vector<Double3> positions;  // finite; double, so that a mesh 1e7 m from the origin keeps its shape
  std::vector<Float3> normals;
  std::vector<Float2> texcoords;  // origin at the lower left, v up (OBJ); glTF is flipped on import

  std::vector<Triangle> triangles;           // indices into positions, all in range
  std::vector<Triangle> normal_triangles;    // empty, or one a triangle; k_none at a corner without
  std::vector<Triangle> texcoord_triangles;  // empty, or one a triangle; k_none at a corner without
  std::vector<std::uint32_t> part_of;        // index into parts, one a triangle
  // The polygon of the source file that a triangle was cut from (0-based, in file order), for messages and
  // for telling a quad from two triangles. Empty: every triangle is a polygon of its own.
  std::vector<std::uint32_t> face_of;

  std::vector<Part> parts;
  std::vector<Material> materials;
  std::vector<Texture> textures;
};

DoubleBox bounds(const Mesh& mesh);

enum class UpAxis { y, z };

// Brings a mesh into copse's frame: +Z up becomes +Y up by (x, y, z) -> (x, z, -y), then positions times
// `scale`.
void orient(Mesh& mesh, UpAxis up, double scale);

}  // namespace copse
