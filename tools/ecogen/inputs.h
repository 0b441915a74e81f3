// The files that a scene names, read once each: maps, tints, trees.
#pragma once

#include "lib/analysis/ecosystem/populate.h"
#include "lib/formats/ecosystem/ecosystem.h"
#include "tools/common/tool.h"
#include "tools/ecogen/scene.h"

#include <filesystem>
#include <map>
#include <memory>
#include <vector>

namespace copse::ecogen {

class Inputs {
 public:
  explicit Inputs(Context& context) : context_(context) {}

  // They live as long as this does.
  Result<const ValueMap*> map(const MapSource& source);
  Result<const TintMap*> tint(const std::filesystem::path& file);
  Result<const ValueMap*> map(const std::optional<MapSource>& source);  // null when there is none

  // Of all maps and tints, in the order in which they were read first, each once.
  const std::vector<std::filesystem::path>& files() const { return files_; }

 private:
  void take(const std::filesystem::path& file);
  Context& context_;
  std::vector<std::filesystem::path> files_;
  std::map<MapSource, std::unique_ptr<ValueMap>> maps_;
  std::map<std::filesystem::path, std::unique_ptr<TintMap>> tints_;
};

// Of a tree its box, the bounding volumes of all of it, and the hash of its file.
Result<TreeType> read_type(const TypeSource& source, Context& context);

}  // namespace copse::ecogen
