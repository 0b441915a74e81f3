// The command line of treeplay.
#pragma once

#include "lib/formats/result.h"
#include "lib/runtime/camera.h"
#include "lib/runtime/camera_path.h"
#include "tools/treeplay/frame_pattern.h"
#include "tools/treeplay/renderer.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace copse::treeplay {

inline constexpr int k_largest_side = 16384;  // of a picture, pixels
inline constexpr std::uint64_t k_most_frames = 1'000'000;

// As typed.
struct Options {
  std::filesystem::path input;
  std::string frames, size = "1280x720", camera, path, sun = "-48,40", show = "surface", background = "auto";
  std::optional<std::uint64_t> count;
  int samples = 0;  // 0: 16 for pictures, 4 for a window
  bool headless = false, unlit = false, no_ground = false, above_ground = false;
  DetailWish detail;
  BlockHierarchy cull = BlockHierarchy::boxes;
  double fade = 0.1;
  std::filesystem::path stats;
  std::uint64_t exit_after = 0;  // frames after which the window closes; 0: never
};

// As understood.
struct Plan {
  std::optional<FramePattern> frames;
  int width = 0, height = 0;
  std::optional<Camera> camera;  // none: fitted to the model
  bool above_ground = false;     // its heights count from the terrain below
  std::uint64_t count = 1;
  Look look;
  RenderSettings settings;
};

void add_options(CLI::App& app, Options& options);

// Checks everything that can be checked before a file is opened; the faults are of usage.
Result<Plan> understand(const Options& options);

// "EYE,TARGET[,FOV]": six or seven numbers, metres and degrees.
Result<Camera> parse_camera(const std::string& text);

// The path that --path names: orbit, linear or a JSON file; standing still when empty.
Result<CameraPath> make_path(const Options& options, const Camera& camera);

}  // namespace copse::treeplay
