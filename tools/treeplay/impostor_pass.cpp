#include "tools/treeplay/impostor_pass.h"

#include "tools/treeplay/shaders.h"

#include <algorithm>
#include <cstddef>
#include <string>

#include <fmt/format.h>

namespace copse::treeplay {
namespace {

// The units after those that the renderer binds itself.
constexpr int k_albedo_unit = 5, k_normal_unit = 6, k_frames_unit = 7, k_copies_unit = 8;

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

void bind(int unit, GLenum target, const Texture2& texture, GLuint sampler) {
  glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
  glBindTexture(target, texture.get());
  glBindSampler(static_cast<GLuint>(unit), sampler);
}

VertexArray make_copies_array(const Buffer& copies) {
  VertexArray array = make_vertex_array();
  glBindVertexArray(array.get());
  glBindBuffer(GL_ARRAY_BUFFER, copies.get());
  const auto attribute = [](GLuint index, GLint size, GLenum type, std::size_t at) {
    glEnableVertexAttribArray(index);
    glVertexAttribDivisor(index, 1);
    glVertexAttribPointer(index, size, type, type == GL_UNSIGNED_BYTE, sizeof(ImpostorCopy),
                          reinterpret_cast<const void*>(at));  // NOLINT: an offset, as GL wants it
  };
  for (GLuint row = 0; row < 3; ++row)
    attribute(3 + row, 4, GL_FLOAT, offsetof(ImpostorCopy, copy.rows) + row * sizeof(Float4));
  attribute(6, 4, GL_UNSIGNED_BYTE, offsetof(ImpostorCopy, copy.tint));
  attribute(7, 3, GL_FLOAT, offsetof(ImpostorCopy, view));
  attribute(8, 3, GL_FLOAT, offsetof(ImpostorCopy, weight));
  return array;
}

// A texture of plain texels, to fetch from.
Texture2 make_table(GLsizei width, GLsizei height, GLint format, GLenum channels, const void* texels) {
  Texture2 texture = make_texture();
  glBindTexture(GL_TEXTURE_2D, texture.get());
  glTexImage2D(GL_TEXTURE_2D, 0, format, width, height, 0, channels, GL_FLOAT, texels);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  return texture;
}

Texture2 make_frames(const std::vector<Double3>& views) {
  std::vector<Float3> texels;
  for (const Double3& toward : views) {
    const ImpostorFrame frame = impostor_frame(toward);
    for (const Double3& axis : {frame.right, frame.up, toward}) texels.push_back(to_float(axis));
  }
  return make_table(3, static_cast<GLsizei>(views.size()), GL_RGB32F, GL_RGB, texels.data());
}

}  // namespace

Result<ImpostorPass> ImpostorPass::make() {
  using namespace shaders;
  ImpostorPass pass;
  const std::string single{k_common}, single_fading = single + std::string(k_fade),
                                      blended = single + std::string(k_impostor_common),
                                      blended_fading = single_fading + std::string(k_impostor_common);
  struct Source {
    const char* name;
    const std::string& common;
    std::string_view vertex, fragment;
    Program& program;
  };
  const Source programs[] = {
      {"impostor coverage", blended_fading, k_impostor_vertex, k_impostor_coverage_fragment, pass.coverage_},
      {"impostor", blended, k_impostor_vertex, k_impostor_light_fragment, pass.light_},
      {"picture coverage", single_fading, k_picture_vertex, k_picture_coverage_fragment,
       pass.single_coverage_},
      {"picture", single, k_picture_vertex, k_picture_light_fragment, pass.single_light_}};
  for (const Source& w : programs) {
    auto made = Program::make(w.name, w.common, w.vertex, w.fragment);
    if (!made) return std::unexpected(made.error());
    w.program = std::move(*made);
  }
  pass.no_vertices_ = make_vertex_array();
  GLint largest = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
  pass.copies_a_row_ = largest / 4;
  pass.sampler_ = make_sampler();
  const GLuint sampler = pass.sampler_.get();
  glSamplerParameteri(sampler, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glSamplerParameteri(sampler, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glSamplerParameteri(sampler, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glSamplerParameteri(sampler, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  return pass;
}

Result<std::size_t> ImpostorPass::upload(const ImpostorAtlas& atlas, const ImpostorImages& images) {
  const std::vector<Double3> views = impostor_views(atlas.layout, atlas.views);
  GLint most = 0;
  glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &most);
  if (views.size() > static_cast<std::size_t>(most))
    return refuse("",
                  fmt::format("the impostor has {} views, the graphics driver takes {}", views.size(), most),
                  "bake it with fewer --impostor-views");
  Uploaded u;
  u.atlas = atlas;
  u.atlas.albedo = u.atlas.normal = {};
  u.albedo = make_layers(atlas, images.albedo, GL_SRGB8_ALPHA8);
  u.normals = make_layers(atlas, images.normals, GL_RGBA8);
  u.frames = make_frames(views);
  u.blended = make_buffer();
  u.blended_array = make_copies_array(u.blended);
  uploaded_.push_back(std::move(u));
  if (auto done = check_gl("uploading the impostor"); !done) return std::unexpected(done.error());
  return uploaded_.size() - 1;
}

Result<void> ImpostorPass::show(std::size_t impostor, const ImpostorCopies& copies) {
  Uploaded& u = uploaded_[impostor];
  u.blended_count = static_cast<GLsizei>(copies.blended.size());
  glBindBuffer(GL_ARRAY_BUFFER, u.blended.get());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(copies.blended.size() * sizeof(ImpostorCopy)),
               copies.blended.data(), GL_DYNAMIC_DRAW);
  u.single_count = static_cast<GLsizei>(copies.single.size());
  if (copies.single.empty()) return {};
  const auto a_row = static_cast<std::size_t>(copies_a_row_);
  const std::size_t rows = (copies.single.size() - 1) / a_row + 1;
  const std::size_t columns = std::min(copies.single.size(), a_row);
  if (rows > 4 * a_row)
    return refuse("",
                  fmt::format("{} trees far away are more than the graphics driver takes", u.single_count),
                  "limit what is seen by a view_range");
  // Whole rows: the last one is filled up.
  std::vector<PictureCopy> filled;
  if (rows > 1) filled = copies.single, filled.resize(rows * a_row);
  u.single = make_table(static_cast<GLsizei>(4 * columns), static_cast<GLsizei>(rows), GL_RGBA32F, GL_RGBA,
                        rows > 1 ? filled.data() : copies.single.data());
  return check_gl("uploading the trees far away");
}

void ImpostorPass::draw(const Program& program, bool single) const {
  program.set("albedo_layers", k_albedo_unit), program.set("normal_layers", k_normal_unit);
  program.set("view_frames", k_frames_unit), program.set("copies", k_copies_unit);
  program.set("copies_a_row", copies_a_row_);
  for (const Uploaded& u : uploaded_) {
    const GLsizei count = single ? u.single_count : u.blended_count;
    if (count == 0) continue;
    bind(k_albedo_unit, GL_TEXTURE_2D_ARRAY, u.albedo, sampler_.get());
    bind(k_normal_unit, GL_TEXTURE_2D_ARRAY, u.normals, sampler_.get());
    bind(k_frames_unit, GL_TEXTURE_2D, u.frames, 0);
    program.set("centre", u.atlas.centre), program.set("radius", u.atlas.radius);
    if (single) {
      bind(k_copies_unit, GL_TEXTURE_2D, u.single, 0);
      glBindVertexArray(no_vertices_.get());
      glDrawArrays(GL_TRIANGLES, 0, 6 * count);
    } else {
      glBindVertexArray(u.blended_array.get());
      glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, count);
    }
  }
}

void ImpostorPass::draw_coverage(const Mat4& clip, const Float3& offset, const Float2& corner, float pixel,
                                 bool multisampled) const {
  for (const Program* p : {&coverage_, &single_coverage_}) {
    p->use();
    p->set("clip", clip), p->set("offset", offset), p->set("pixel", pixel);
    p->set("tile_corner", corner), p->set("multisampled", multisampled ? 1 : 0);
    draw(*p, p == &single_coverage_);
  }
}

void ImpostorPass::draw_light(const Mat4& clip, const Float3& offset, float pixel, bool lit,
                              float haze_distance) const {
  for (const Program* p : {&light_, &single_light_}) {
    p->use();
    p->set("clip", clip), p->set("offset", offset), p->set("pixel", pixel);
    p->set("lit", lit ? 1 : 0), p->set("haze_distance", haze_distance);
    draw(*p, p == &single_light_);
  }
}

void ImpostorPass::draw_shadow(const Mat4& clip) const {
  single_coverage_.use();
  single_coverage_.set("clip", clip), single_coverage_.set("offset", Float3{});
  single_coverage_.set("multisampled", 0);
  draw(single_coverage_, true);
}

}  // namespace copse::treeplay
