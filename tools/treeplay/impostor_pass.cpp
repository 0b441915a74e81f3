#include "tools/treeplay/impostor_pass.h"

#include "tools/treeplay/shaders.h"

#include <algorithm>
#include <string>

#include <fmt/format.h>

namespace copse::treeplay {
namespace {

// The units after those that the renderer binds itself.
constexpr int k_albedo_unit = 5, k_normal_unit = 6;

// A layer for each view, so that no mip level mixes two of them.
Texture2 make_layers(const ImpostorAtlas& atlas, const Image& image, GLint format) {
  Texture2 texture = make_texture();
  const auto size = static_cast<GLsizei>(atlas.size);
  glBindTexture(GL_TEXTURE_2D_ARRAY, texture.get());
  glTexImage3D(GL_TEXTURE_2D_ARRAY, 0, format, size, size,
               static_cast<GLsizei>(atlas.columns() * atlas.rows()), 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, image.width);
  for (std::uint32_t view = 0; view < atlas.columns() * atlas.rows(); ++view) {
    const std::size_t x = std::size_t{view % atlas.columns()} * atlas.size,
                      y = std::size_t{view / atlas.columns()} * atlas.size;
    glTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, static_cast<GLint>(view), size, size, 1, GL_RGBA,
                    GL_UNSIGNED_BYTE, &image.rgba[4 * (y * static_cast<std::size_t>(image.width) + x)]);
  }
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
  glGenerateMipmap(GL_TEXTURE_2D_ARRAY);
  return texture;
}

void bind(int unit, const Texture2& texture, const Sampler& sampler) {
  glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
  glBindTexture(GL_TEXTURE_2D_ARRAY, texture.get());
  glBindSampler(static_cast<GLuint>(unit), sampler.get());
}

}  // namespace

Result<ImpostorPass> ImpostorPass::make() {
  ImpostorPass pass;
  auto program =
      Program::make("impostor", shaders::k_common, shaders::k_impostor_vertex, shaders::k_impostor_fragment);
  if (!program) return std::unexpected(program.error());
  pass.program_ = std::move(*program);
  pass.no_vertices_ = make_vertex_array();
  return pass;
}

Result<void> ImpostorPass::upload(const TreeImpostor& impostor) {
  atlas_ = impostor.atlas;
  atlas_.albedo = atlas_.normal = {};
  views_ = impostor_views(atlas_.layout, atlas_.views);
  GLint most = 0;
  glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &most);
  if (views_.size() > static_cast<std::size_t>(most))
    return refuse("",
                  fmt::format("the impostor has {} views, the graphics driver takes {}", views_.size(), most),
                  "bake it with fewer --impostor-views");
  albedo_ = make_layers(atlas_, impostor.albedo, GL_SRGB8_ALPHA8);
  normals_ = make_layers(atlas_, impostor.normals, GL_RGBA8);
  sampler_ = make_sampler();
  glSamplerParameteri(sampler_.get(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glSamplerParameteri(sampler_.get(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glSamplerParameteri(sampler_.get(), GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glSamplerParameteri(sampler_.get(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  return check_gl("uploading the impostor");
}

void ImpostorPass::draw(const Mat4& clip, const Float3& offset, bool lit, bool multisampled) const {
  const Double3 eye = to_double(offset) * -1.0 - to_double(atlas_.centre);  // from the sphere's centre
  const ImpostorBlend blend = impostor_blend(atlas_.layout, atlas_.views, eye);
  bind(k_albedo_unit, albedo_, sampler_), bind(k_normal_unit, normals_, sampler_);
  program_.use();
  program_.set("albedo_layers", k_albedo_unit), program_.set("normal_layers", k_normal_unit);
  program_.set("clip", clip), program_.set("offset", offset);
  program_.set("centre", atlas_.centre), program_.set("radius", atlas_.radius);
  program_.set("lit", lit ? 1 : 0), program_.set("multisampled", multisampled ? 1 : 0);
  for (std::size_t k = 0; k < 3; ++k) {
    const Double3& toward = views_[blend.view[k]];
    const ImpostorFrame frame = impostor_frame(toward);
    const auto name = [&](const char* what) { return fmt::format("{}[{}]", what, k); };
    program_.set(name("layer").c_str(), static_cast<float>(blend.view[k]));
    program_.set(name("weight").c_str(), static_cast<float>(blend.weight[k]));
    program_.set(name("view_right").c_str(), to_float(frame.right));
    program_.set(name("view_up").c_str(), to_float(frame.up));
    program_.set(name("view_toward").c_str(), to_float(toward));
  }
  glBindVertexArray(no_vertices_.get());
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

}  // namespace copse::treeplay
