// From a scene to an ecosystem: terrain, trees, instances, blocks.
#pragma once

#include "lib/formats/ecosystem/ecosystem.h"
#include "lib/formats/result.h"
#include "lib/runtime/camera_path.h"
#include "tools/common/tool.h"
#include "tools/ecogen/scene.h"

#include <filesystem>
#include <string>
#include <vector>

namespace copse::ecogen {

struct BuildOptions {
  std::filesystem::path folder;  // of the output: names in it are relative to this
  std::filesystem::path document;
  const CameraPath* path = nullptr;  // instances that no frame of it shows are left out
  double aspect = 2.4;               // of its frames at most: width over height
  double lowest_sun = 90;            // degrees above the horizon; how far shadows may fall into a frame
  double view_range = 0;             // m: nothing is drawn farther away; 0: as the page says
  bool pack = false;                 // trees and textures go into the file
};

// What was left out, for the report: "material 'bark'", why, and the bytes by which the ecosystem's file is
// smaller for it, or which the player need not read from other files.
struct LeftOut {
  std::string what, why;
  std::uint64_t bytes = 0, bytes_elsewhere = 0;
};

struct Built {
  Ecosystem eco;
  std::vector<double> farthest;  // of every type: metres from the eye that it is shown at most
  std::vector<LeftOut> left_out;
  std::vector<std::string> texture_places;     // of every texture: where the page names it
  std::vector<std::filesystem::path> sources;  // every file that was read but the trees, in that order
};

// Fills the report of `context` as it goes.
Result<Built> build(const Scene& scene, const BuildOptions& options, Context& context);

}  // namespace copse::ecogen
