// Reads a mesh file of any supported kind into a Mesh: OBJ, PLY, OFF, STL, glTF and GLB, gzipped or not.
//
// Hostile input is normal input: whatever the bytes are, the answer is a Mesh whose indices are all in range
// and whose coordinates are all finite, or one Error; in bounded time and in memory proportional to the
// file's size.
#pragma once

#include "lib/formats/mesh.h"
#include "lib/formats/result.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace copse {

enum class MeshFormat { unknown, obj, ply, off, stl, gltf, glb };

struct ImportOptions {
  // Refuse what is otherwise dropped and counted: bad normal or texture indices, faces naming missing
  // vertices, missing material libraries.
  bool strict = false;
  // How many triangles, and how many vertices, a glTF scene may have once its meshes are instanced; as many
  // as its files have bytes are always allowed. Without instances no file reaches that.
  std::uint64_t instance_limit = std::uint64_t{1} << 24;
};

// What was dropped or mended; a warning names each kind once, with the first place and the count.
struct ImportCounts {
  std::uint64_t dropped_faces = 0;      // fewer than 3 distinct corners, or vertices out of range
  std::uint64_t dropped_normals = 0;    // corners whose normal index was out of range
  std::uint64_t dropped_texcoords = 0;  // corners whose texture index was out of range
  std::uint64_t cut_polygons = 0;       // n-gons, n > 3, triangulated
};

// What a source groups triangles by: an object or a group of an OBJ, a node of a glTF scene or one of its
// instances, a solid of an STL. Two of one name are two things.
struct SourceGroup {
  std::string name;               // may be empty
  std::uint32_t parent = k_none;  // an earlier one, k_none at the top
};

struct Import {
  Mesh mesh;
  std::vector<std::uint32_t> undefined_materials;  // faces name them, nothing says how they look; ascending
  std::vector<SourceGroup> groups;                 // empty where the source groups nothing
  std::vector<std::uint32_t> group_of;             // one a triangle, k_none: in no group; empty as `groups`
  MeshFormat format = MeshFormat::unknown;
  ImportCounts counts;
  std::vector<std::string> warnings;
  std::vector<std::filesystem::path> files;  // everything that was read, the mesh first: for depfiles
  std::uint64_t bytes = 0;                   // of the mesh file as stored
};

// Reads `path`; the content decides the format where it can, otherwise the extension (".obj.gz" is an OBJ).
// Material libraries, buffers and images are looked up relative to the file and only below its folder.
Result<Import> import_mesh(const std::filesystem::path& path, const ImportOptions& options = {});

// The same over bytes in memory, for tests and fuzzers. Nothing else is opened.
Result<Import> import_mesh(std::span<const std::uint8_t> bytes, MeshFormat format, const std::string& name,
                           const ImportOptions& options = {});

}  // namespace copse
