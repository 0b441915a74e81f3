// gltfpack, where it is installed, as a peer of --sweep: a tree goes out as a GLB, comes back simplified, and
// is judged like every other level.
#pragma once

#include "lib/analysis/measure/drawn_mesh.h"
#include "lib/formats/result.h"
#include "lib/formats/tree/tree.h"

#include <filesystem>
#include <memory>
#include <optional>

namespace copse::lodbake {

class Gltfpack {
 public:
  // Nothing when no gltfpack can be run. Writes the tree into a folder of its own, which goes with it.
  static std::optional<Gltfpack> find(const Tree& tree);
  Gltfpack(Gltfpack&&) noexcept = default;
  Gltfpack& operator=(Gltfpack&&) noexcept = default;

  // At most this share of the triangles if it can (-si), its error limit off; `aggressive`: whatever the
  // quality (-sa). Positions stay float32 (-noq). Relative to the tree's origin. Nothing when it fails.
  std::optional<DrawnMesh> level(double share, bool aggressive) const;

 private:
  struct Folder {
    std::filesystem::path path;
    ~Folder();
  };
  Gltfpack() = default;

  std::unique_ptr<Folder> folder_;
  Double3 origin_;
};

}  // namespace copse::lodbake
