// What the writers of lib/formats/export share.
#pragma once

#include "lib/formats/export/export.h"

#include <string>
#include <string_view>
#include <vector>

namespace copse {

Result<std::vector<ExportedFile>> export_obj(const Mesh& mesh, const std::string& name);
Result<std::vector<ExportedFile>> export_ply(const Mesh& mesh, const std::string& name);
Result<std::vector<ExportedFile>> export_glb(const Mesh& mesh, const std::string& name,
                                             const ExportOptions& options);

// Whether there is an image: its bytes, or a name to find it by.
bool has_image(const Texture& texture);

// "image/png", "image/jpeg", "image/webp", ...: what the bytes say, else what the texture says, else empty.
std::string image_mime(const Texture& texture);

// "oak.obj" -> "oak".
std::string stem_of(const std::string& name);

// The file beside `name` that holds texture number `index`: "oak_texture0.png".
std::string texture_file_name(const std::string& name, std::size_t index, const Texture& texture);

// Names that stand on a line of their own: no control characters, no blanks at the ends, no two alike, none
// empty.
std::vector<std::string> line_names(const std::vector<Material>& materials);
std::string line_name(std::string_view name, std::string_view fallback);

}  // namespace copse
