#include "lib/formats/ecosystem/type_hash.h"

#include "lib/formats/container/mapped_file.h"
#include "lib/formats/hash.h"

#include <fmt/format.h>

namespace copse {

std::string changed_tree(const TreeType& type, const std::filesystem::path& tree) {
  const auto file = MappedFile::open(tree);
  if (!file) return file.error().what;
  const std::uint64_t found = xxh3(file->bytes());
  if (found == type.hash) return {};
  return fmt::format("is not the file that the ecosystem was made with: hash {} expected, {} found",
                     hash_text(type.hash), hash_text(found));
}

std::vector<std::string> changed_trees(const Ecosystem& eco, const std::filesystem::path& folder) {
  std::vector<std::string> lines;
  for (const TreeType& type : eco.types) {
    if (!type.packed.empty()) continue;
    const std::filesystem::path tree = folder / type.uri;
    if (const std::string what = changed_tree(type, tree); !what.empty())
      lines.push_back(fmt::format("type '{}': {}: {}", type.name, tree.string(), what));
  }
  return lines;
}

}  // namespace copse
