#include "lib/formats/import/companions.h"

#include "lib/formats/import/text.h"

#include <fmt/format.h>

namespace copse {
namespace {

// The last part of a path, whichever separator it uses.
std::string last_part(const std::string& reference) {
  return reference.substr(reference.find_last_of("/\\") + 1);
}

bool is_absolute(const std::string& reference) {
  const bool drive = reference.size() > 1 && reference[1] == ':';
  return drive || reference.starts_with('/') || reference.starts_with('\\');
}

}  // namespace

Result<Bytes> Companions::open(const std::string& reference, MeshBuilder& builder) const {
  if (!folder)
    return refuse(builder.file(), fmt::format("needs the file {}", in_quotes(reference)),
                  "read it from a file, not from memory");
  std::filesystem::path path = below(*folder, reference);
  if (path.empty() && is_absolute(reference)) path = below(*folder, last_part(reference));
  if (path.empty())
    return refuse(builder.file(),
                  fmt::format("names {}, which is not below its own folder", in_quotes(reference)),
                  "put the file beside the mesh");
  Result<Bytes> bytes = open_bytes(path);
  if (!bytes) return bytes;
  builder.files.push_back(path);
  return is_gzip(*bytes) ? inflate_gzip(*bytes, path.string()) : bytes;
}

std::string texture_uri(const std::string& reference, MeshBuilder& builder) {
  std::string uri = below({}, reference).generic_string();
  if (uri.empty() && is_absolute(reference)) {
    uri = below({}, last_part(reference)).generic_string();
    if (!uri.empty())
      builder.notes.add("absolute names of images",
                        fmt::format("the image {} is looked for beside the mesh", in_quotes(reference)));
  }
  if (uri.empty())
    builder.notes.add(
        "images left out",
        fmt::format("the image {} is not below the mesh's folder; put it there", in_quotes(reference)));
  return to_utf8(uri);
}

}  // namespace copse
