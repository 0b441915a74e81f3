// The input as it is drawn: with its textures, and what their alpha cuts out.
#pragma once

#include "lib/analysis/measure/drawn_mesh.h"
#include "tools/bvfit/input.h"

#include <vector>

namespace copse::bvfit {

// The mesh of the input, of a tree with its own materials; empty for points alone. In the coordinates of
// Input::points.
Mesh mesh_of(const Input& input);

// Reads textures that are files into the mesh, as PNG or JPEG. What cannot be read is left out, with a
// warning.
void embed_textures(Mesh& mesh, Context& context);

struct DrawnInput {
  Mesh mesh;
  std::vector<bool> is_leaf;     // a triangle
  std::vector<AlphaMask> masks;  // a material
};
// A texture that cannot be read counts as opaque, with a warning.
DrawnInput drawn_input(const Input& input, Context& context);

}  // namespace copse::bvfit
