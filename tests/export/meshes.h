// Small meshes with everything that an exporter must not lose.
#pragma once

#include "lib/formats/mesh.h"

namespace copse {

// The bytes of a PNG of one pixel.
inline std::vector<std::uint8_t> png_bytes() {
  return {0x89, 'P',  'N',  'G',  0x0d, 0x0a, 0x1a, 0x0a, 0,    0,   0,    0x0d, 'I',  'H',
          'D',  'R',  0,    0,    0,    1,    0,    0,    0,    1,   8,    6,    0,    0,
          0,    0x1f, 0x15, 0xc4, 0x89, 0,    0,    0,    0x0d, 'I', 'D',  'A',  'T',  0x78,
          0x9c, 0x63, 0xf8, 0xcf, 0xc0, 0xf0, 0x1f, 0,    5,    0,   1,    0xff, 0x56, 0xc7,
          0x2f, 0x0d, 0,    0,    0,    0,    'I',  'E',  'N',  'D', 0xae, 0x42, 0x60, 0x82};
}

// Two objects, three parts, two materials: a square of two triangles that share an edge (trunk) and two leaf
// triangles, one of them without normals and texture coordinates, one of a material of its own.
inline Mesh small_mesh() {
  Mesh m;
  m.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.1, 2.000000001, 0}, {1, 2, 0.3}, {0.5, 3, 0}};
  m.normals = {{0, 0, 2}, {0, 0, 0}};
  m.texcoords = {{0, 0}, {1, 0}, {1, 0.25f}, {0, 1}};
  m.triangles = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {6, 5, 4}};
  m.normal_triangles = {{0, 0, 0}, {0, 0, 0}, {0, k_none, 1}, {k_none, k_none, k_none}};
  m.texcoord_triangles = {{0, 1, 2}, {0, 2, 3}, {0, 1, k_none}, {k_none, k_none, k_none}};
  m.part_of = {0, 0, 1, 2};
  m.parts = {{.object = "trunk", .group = "wood", .material = 0},
             {.object = "crown", .group = "leaves", .material = 1},
             {.object = "crown", .group = "leaves", .material = 0}};
  Material bark{.name = "bark", .diffuse = {0.25f, 0.2f, 0.1f}};
  Material leaf{.name = "leaf <1>", .specular = {0.1f, 0.1f, 0.1f}, .emission = {4, 2, 0}, .shininess = 30};
  leaf.alpha_cutoff = 0.4f;
  leaf.double_sided = true;
  leaf.texture = 1;
  bark.texture = 0;
  m.materials = {bark, leaf};
  m.textures = {{.uri = "tex/bark 1.png", .mime = {}, .bytes = {}},
                {.uri = {}, .mime = {}, .bytes = png_bytes()}};
  return m;
}

}  // namespace copse
