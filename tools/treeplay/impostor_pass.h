// Draws impostors: of each instance one quad that faces the eye, on which the nearest pictures of its tree
// are blended, each read where its depth says that the ray meets the tree; or, of one that is small on
// screen, the nearest picture alone as it was taken. Depth and coverage first, then light where the depth is
// equal, as for surfaces.
#pragma once

#include "lib/runtime/camera.h"
#include "tools/treeplay/gl.h"
#include "tools/treeplay/impostor_copy.h"
#include "tools/treeplay/texture_reader.h"

#include <vector>

namespace copse::treeplay {

class ImpostorPass {
 public:
  static Result<ImpostorPass> make();
  // Answers its number, from 0.
  Result<std::size_t> upload(const ImpostorAtlas& atlas, const ImpostorImages& images);

  // The instances of an impostor that the next draws show, those with one picture apart. Uploads them.
  Result<void> show(std::size_t impostor, const ImpostorCopies& copies);

  // `pixel`: tangent of the angle that a pixel covers; `corner`: of the tile in the picture, in fragments.
  void draw_coverage(const Mat4& clip, const Float3& offset, const Float2& corner, float pixel,
                     bool multisampled) const;
  // The uniforms of the common part must have been set.
  void draw_light(const Mat4& clip, const Float3& offset, float pixel, bool lit, float haze_distance) const;
  const Program& light_program() const { return light_; }
  const Program& single_light_program() const { return single_light_; }
  // Into the bound depth-only framebuffer: what is shown with one picture, chosen for an eye at the sun.
  void draw_shadow(const Mat4& clip) const;

 private:
  struct Uploaded {
    ImpostorAtlas atlas;       // without its pictures
    Texture2 albedo, normals;  // arrays, a layer a view
    Texture2 frames;           // right, up and toward of every view
    Buffer blended;            // their copies
    VertexArray blended_array;
    Texture2 single;  // four texels each, as many a row as fit
    GLsizei blended_count = 0, single_count = 0;
  };
  void draw(const Program& program, bool single) const;

  Program coverage_, light_, single_coverage_, single_light_;
  std::vector<Uploaded> uploaded_;
  VertexArray no_vertices_;
  int copies_a_row_ = 0;
  Sampler sampler_;
};

}  // namespace copse::treeplay
