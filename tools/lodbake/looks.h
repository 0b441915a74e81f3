// The textures of a tree as masks: what its leaves look like when levels are compared.
#pragma once

#include "lib/analysis/measure/picture.h"
#include "lib/formats/import/image.h"
#include "lib/formats/tree/tree.h"
#include "tools/common/tool.h"

#include <filesystem>
#include <vector>

namespace copse::lodbake {

class TreeLooks {
 public:
  // Images that cannot be read count as opaque; each is warned about. Keeps references to `tree` and
  // `context`.
  TreeLooks(const Tree& tree, const std::filesystem::path& file, Context& context);
  Looks looks() const { return {tree_.materials, masks_}; }
  // Reads them again, one at a time.
  ImageSource images() const;

 private:
  std::optional<Image> read(std::uint32_t texture, bool warn) const;

  const Tree& tree_;
  std::filesystem::path file_;
  Context& context_;
  std::vector<AlphaMask> masks_;
};

}  // namespace copse::lodbake
