// Writes a mesh as OBJ (+ MTL + textures), PLY or GLB. Deterministic; text numbers round-trip.
#pragma once

#include "lib/formats/mesh.h"
#include "lib/formats/result.h"
#include "lib/formats/tree.h"

#include <cstdint>
#include <string>
#include <vector>

namespace copse {

enum class ExportFormat { obj, ply, glb };

struct ExportedFile {
  std::string name;  // of the file alone: "oak.obj", "oak.mtl", "oak_leaf.png"
  std::string bytes;
};

// The main file first, `name` as given; a material library and embedded textures beside it where the format
// cannot hold them. PLY holds one material-less mesh. GLB embeds textures that are embedded in `mesh` and
// refers to the others; its positions are float32, relative to a node's translation when the mesh lies far
// from the origin.
Result<std::vector<ExportedFile>> export_mesh(const Mesh& mesh, ExportFormat format, const std::string& name);

// The whole geometry of a tree (full detail) as a mesh: trunk first, then leaves, one part a material.
Mesh to_mesh(const Tree& tree);

}  // namespace copse
