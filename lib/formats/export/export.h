// Writes a mesh as OBJ (+ MTL + textures), PLY or GLB. Deterministic; text numbers round-trip.
#pragma once

#include "lib/formats/mesh.h"
#include "lib/formats/result.h"
#include "lib/formats/tree/tree.h"

#include <cstdint>
#include <string>
#include <vector>

namespace copse {

enum class ExportFormat { obj, ply, glb };

struct ExportOptions {
  // GLB only: KHR_draco_mesh_compression. Positions are quantized to this many bits of the longest side of a
  // primitive's box (1 to 30), normals to 10 bits, texture coordinates to 12.
  bool draco = false;
  int draco_position_bits = 14;
  // GLB only: the level of detail of each part of the mesh, 0 the finest; empty: there is one. Levels become
  // nodes that stand for one another (MSFT_lod): the scene holds level 0 alone. `screen_coverage`: for every
  // level the share of the screen's height above which it is drawn (MSFT_screencoverage), or empty.
  std::vector<std::uint32_t> level_of_part = {};
  std::vector<double> screen_coverage = {};
};

struct ExportedFile {
  std::string name;  // of the file alone: "oak.obj", "oak.mtl", "oak_leaf.png"
  std::string bytes;
};

// The main file first, `name` as given; a material library and embedded textures beside it where the format
// cannot hold them. PLY holds one material-less mesh. GLB embeds textures that are embedded in `mesh` and
// refers to the others; its positions are float32, relative to a node's translation when the mesh lies far
// from the origin.
//
// Errors (refused): an index of `mesh` out of range; for GLB also coordinates beyond float32 and 4 GiB.
// Time O(corners), expected; memory: the files, and about 24 bytes a corner while PLY or GLB is made.
Result<std::vector<ExportedFile>> export_mesh(const Mesh& mesh, ExportFormat format, const std::string& name,
                                              const ExportOptions& options = {});

// The format that an extension names (".obj", ".PLY"); a usage error that lists the three otherwise.
Result<ExportFormat> export_format_of(const std::string& name);

// The whole geometry of a tree (full detail) as a mesh: trunk first, then leaves, one part a material.
// Precondition: the tree is sound (tree_file.h); what was left out of it is left out here too.
Mesh to_mesh(const Tree& tree);

}  // namespace copse
