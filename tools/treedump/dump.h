// What can be known of a file, however damaged it is.
#pragma once

#include "lib/formats/tree_file/tree_file.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace copse {

struct SectionState {
  SectionInfo info;
  std::string damage;  // empty when its checksum is right
};

struct Dump {
  std::filesystem::path path;
  Container container;
  std::vector<SectionState> sections;
  std::optional<TreeFile> file;  // none when header or table do not fit together
  Tree tree;                     // what could be read of `file`; element values are not checked
  std::optional<Error> problem;  // the first thing that is wrong
};

// Opens a file and reads the sections `wanted` (all when empty), each on its own, so that a damaged one does
// not hide the others. An error only when the container itself cannot be opened.
Result<Dump> open_dump(const std::filesystem::path& path, const std::vector<std::string>& wanted);

// "trunk triangles"; for a name that this version does not know: "unknown to this version".
std::string_view describe_section(std::string_view name);

// "raw", "zstd".
std::string_view encoding_name(Encoding encoding);

// "still tree (.tree)", "sensitive tree (.stree)", "ecosystem (.eco)".
std::string_view kind_name(FileKind kind);

}  // namespace copse
