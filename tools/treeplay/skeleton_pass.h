// Draws a skeleton: lines as capsules and points as balls, both flat quads that face the camera, because GL
// core drivers may cap line widths and point sizes at one pixel; leaf groups as glass spheres.
#pragma once

#include "lib/runtime/camera.h"
#include "tools/treeplay/gl.h"
#include "tools/treeplay/primitives.h"
#include "tools/treeplay/scene.h"

#include <array>
#include <cstdint>
#include <vector>

namespace copse::treeplay {

class SkeletonPass {
 public:
  using Colour = Tint;
  using Line = FlatLine;
  using Disc = FlatDisc;

  static Result<SkeletonPass> make();
  Result<void> upload(const Skeleton& skeleton);
  // Any lines and discs instead of a skeleton's, also frame after frame.
  Result<void> upload(const std::vector<Line>& lines, const std::vector<Disc>& discs);

  struct Frame {
    Mat4 clip;
    Float3 offset;
    const View* view = nullptr;
    float fragment_angle = 0;  // of a fragment's height, radians
    float thinnest = 1;        // half the least width of a line, in fragments
    float scale = 1;           // of the lines' and points' widths
    bool lit = true;
    Float3 sun;
  };
  void draw_lines(const Frame& frame) const;
  void draw_spheres(const Frame& frame);  // blended, the farthest first; allocates nothing

  std::uint64_t lines() const { return line_count_; }
  std::uint64_t points() const { return disc_count_; }
  std::uint64_t spheres() const { return spheres_.size(); }

 private:
  static Colour colour_of_level(std::uint32_t level);
  static Colour colour_of_group(std::uint32_t group);
  static void set_common(const Program& program, const Frame& frame);
  static void disc_attributes();

  Program line_, disc_, sphere_;
  VertexArray line_array_, disc_array_, sphere_array_;
  Buffer line_buffer_, disc_buffer_, sphere_buffer_;
  std::uint64_t line_count_ = 0, disc_count_ = 0;
  std::vector<Disc> spheres_, sorted_;
  std::vector<std::pair<double, std::uint32_t>> by_distance_;
};

}  // namespace copse::treeplay
