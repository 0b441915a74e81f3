// Draws the triangles of a scene: shadow maps, then for every frame depth and coverage, then light.
#pragma once

#include "tools/treeplay/gl.h"
#include "tools/treeplay/scene.h"
#include "tools/treeplay/texture_reader.h"

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

namespace copse::treeplay {

class SurfacePass {
 public:
  static Result<SurfacePass> make();
  // The scene's vertices and indices. A tree or a mesh is one group, shown once where it stands; the groups
  // of an ecosystem are added one by one.
  Result<void> upload(const Scene& scene);

  // Groups of ranges that are drawn together, once for each copy that is shown; they are numbered from 0.
  // Reads the textures that no group had before.
  using Ranges = std::span<const DrawRange>;
  void add_groups(const Scene& scene, std::span<const Ranges> groups);

  // Other triangles of the same vertices: ranges as many as the scene's, in its order.
  void replace(const std::vector<std::uint32_t>& indices, const std::vector<DrawRange>& ranges);

  // The last vertices of the scene, from `first` on, moved.
  void replace(std::size_t first, const std::vector<DrawVertex>& vertices);

  // The copies of every group, by its number, that the next draws show (groups behind the last: none), and
  // the triangles of ranges of the part `ground`. Uploads them.
  void show(const std::vector<std::vector<DrawCopy>>& copies, const std::vector<std::uint32_t>& ground);

  // Into the bound depth-only framebuffer.
  void draw_shadow(const Mat4& clip) const;
  // Depth first, so that the costly second pass runs once a fragment: `clip` takes camera-relative positions.
  // `corner`: of the tile in the picture, in fragments.
  void draw_coverage(const Mat4& clip, const Float3& offset, const Float2& corner, bool multisampled) const;
  // The program's uniforms of the common part must have been set. ghost: 0 as it is, 1 faded away.
  void draw_light(const Mat4& clip, const Float3& offset, bool lit, float ghost, float haze_distance) const;
  const Program& light_program() const { return light_; }

 private:
  struct Range {
    std::uint32_t group = 0;
    bool ground = false;
    GLsizei count = 0;
    const void* first = nullptr;  // offset into the index buffer
    Material material;
    std::size_t image = 0;  // into images_
    float thin = 0;
    bool repeats = false;  // its texture coordinates leave [0, 1]
  };
  void draw(const Program& program, bool with_light) const;
  void upload_textures(const Scene& scene, std::span<const Ranges> groups);
  void add_group(const Scene& scene, Ranges ranges);
  std::size_t upload_image(const std::vector<MipLevel>& mips);
  std::size_t flat_image(const Float3& linear_colour);

  Program coverage_, light_, shadow_;
  VertexArray array_;
  // Of a group, in the buffer of copies that is bound.
  struct Shown {
    GLsizei count = 0;
    std::size_t first = 0;
  };
  void point_at(std::size_t first_copy) const;
  Buffer vertices_, indices_, copies_, ground_indices_;
  GLsizei ground_count_ = 0;
  std::vector<Shown> shown_;        // one a group
  std::vector<DrawCopy> gathered_;  // of show(), kept for its memory
  std::vector<Texture2> images_;
  // A texture's mip levels depend on the alpha cutoff, so a pair of both is an image; none: it cannot be
  // read.
  std::map<WantedTexture, std::optional<std::size_t>> uploaded_;
  Sampler repeating_, clamping_;
  std::vector<Range> ranges_;
};

}  // namespace copse::treeplay
