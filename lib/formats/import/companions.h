// The files that a mesh file names: material libraries, buffers, images. Only those below its folder are
// touched.
#pragma once

#include "lib/formats/import/mesh_builder.h"
#include "lib/formats/import/source.h"

#include <filesystem>
#include <optional>
#include <string>

namespace copse {

struct Companions {
  std::optional<std::filesystem::path> folder;  // nothing may be opened without one

  // Opens (and inflates) what `reference` names and notes it in builder.files.
  Result<Bytes> open(const std::string& reference, MeshBuilder& builder) const;
};

// `reference` to an image as Texture::uri: relative, below the folder, '/' between its parts. An absolute
// name as exporters write it ("C:\art\leaf.png") becomes its last part, with a warning; one that climbs out
// of the folder becomes empty, with a warning.
std::string texture_uri(const std::string& reference, MeshBuilder& builder);

}  // namespace copse
