// Draws an impostor: one quad that faces the eye, on which the nearest pictures of the tree are blended, each
// read where its depth says that the ray meets the tree, and lit like everything else.
#pragma once

#include "lib/runtime/camera.h"
#include "tools/treeplay/gl.h"
#include "tools/treeplay/tree_levels.h"

namespace copse::treeplay {

class ImpostorPass {
 public:
  static Result<ImpostorPass> make();
  Result<void> upload(const TreeImpostor& impostor);

  // The program's uniforms of the common part must have been set.
  void draw(const Mat4& clip, const Float3& offset, bool lit, bool multisampled) const;
  const Program& program() const { return program_; }

 private:
  Program program_;
  VertexArray no_vertices_;
  Texture2 albedo_, normals_;  // arrays, a layer a view
  Sampler sampler_;
  ImpostorAtlas atlas_;  // without its pictures
  std::vector<Double3> views_;
};

}  // namespace copse::treeplay
