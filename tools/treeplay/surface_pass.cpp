#include "tools/treeplay/surface_pass.h"

#include "tools/treeplay/shaders.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

namespace copse::treeplay {

Result<SurfacePass> SurfacePass::make() {
  using namespace shaders;
  SurfacePass pass;
  const std::string fading = std::string(k_common) + std::string(k_fade);
  auto coverage = Program::make("coverage", fading, k_surface_vertex, k_coverage_fragment);
  if (!coverage) return std::unexpected(coverage.error());
  auto light = Program::make("surface", k_common, k_surface_vertex, k_surface_fragment);
  if (!light) return std::unexpected(light.error());
  auto shadow = Program::make("shadow", k_common, k_shadow_vertex, k_shadow_fragment);
  if (!shadow) return std::unexpected(shadow.error());
  pass.coverage_ = std::move(*coverage);
  pass.light_ = std::move(*light);
  pass.shadow_ = std::move(*shadow);
  return pass;
}

std::size_t SurfacePass::upload_image(const std::vector<MipLevel>& mips) {
  images_.push_back(make_texture());
  glBindTexture(GL_TEXTURE_2D, images_.back().get());
  GLint largest = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
  GLint level = 0;
  for (const MipLevel& mip : mips) {
    if (mip.width > largest || mip.height > largest) continue;  // begins with the largest that fits
    glTexImage2D(GL_TEXTURE_2D, level++, GL_SRGB8_ALPHA8, mip.width, mip.height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                 mip.rgba.data());
  }
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, level - 1);
  return images_.size() - 1;
}

// One texel, of the colour of a texture that is missing (white where there is none).
std::size_t SurfacePass::flat_image(const Float3& linear_colour) {
  images_.push_back(make_texture());
  glBindTexture(GL_TEXTURE_2D, images_.back().get());
  const std::array<float, 4> texel{linear_colour.x, linear_colour.y, linear_colour.z, 1};
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA16F, 1, 1, 0, GL_RGBA, GL_FLOAT, texel.data());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
  return images_.size() - 1;
}

namespace {

// Repeating a texture that is never repeated lets its top edge shine through at its bottom: cards would have
// a line along the edge. So a range repeats only if its coordinates say so (but for rounding).
bool leaves_unit_square(const TreeGeometry& g, const DrawRange& range) {
  const auto begin = g.indices.begin() + range.first_index;
  return std::any_of(begin, begin + range.index_count, [&](std::uint32_t i) {
    const Float2& t = g.vertices[i].texcoord;
    return !(t.x >= -1e-4f && t.x <= 1 + 1e-4f && t.y >= -1e-4f && t.y <= 1 + 1e-4f);
  });
}

Sampler make_wrap_sampler(GLint wrap) {
  Sampler sampler = make_sampler();
  glSamplerParameteri(sampler.get(), GL_TEXTURE_WRAP_S, wrap);
  glSamplerParameteri(sampler.get(), GL_TEXTURE_WRAP_T, wrap);
  glSamplerParameteri(sampler.get(), GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glSamplerParameteri(sampler.get(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  return sampler;
}

}  // namespace

Result<void> SurfacePass::upload(const Scene& scene) {
  repeating_ = make_wrap_sampler(GL_REPEAT);
  clamping_ = make_wrap_sampler(GL_CLAMP_TO_EDGE);
  const TreeGeometry& g = scene.geometry;
  array_ = make_vertex_array();
  vertices_ = make_buffer();
  indices_ = make_buffer();
  glBindVertexArray(array_.get());
  glBindBuffer(GL_ARRAY_BUFFER, vertices_.get());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(g.vertices.size() * sizeof(DrawVertex)),
               g.vertices.data(), GL_STATIC_DRAW);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.get());
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(g.indices.size() * sizeof(std::uint32_t)),
               g.indices.data(), GL_STATIC_DRAW);
  const auto attribute = [](GLuint index, GLint size, std::size_t at) {
    glEnableVertexAttribArray(index);
    glVertexAttribPointer(index, size, GL_FLOAT, GL_FALSE, sizeof(DrawVertex),
                          reinterpret_cast<const void*>(at));  // NOLINT: an offset, as GL wants it
  };
  attribute(0, 3, offsetof(DrawVertex, position));
  attribute(1, 3, offsetof(DrawVertex, normal));
  attribute(2, 2, offsetof(DrawVertex, texcoord));

  copies_ = make_buffer();
  ground_indices_ = make_buffer();
  for (GLuint index = 3; index <= 6; ++index) {
    glEnableVertexAttribArray(index);
    glVertexAttribDivisor(index, 1);
  }
  if (!scene.eco) {
    const Ranges all[] = {g.ranges};
    add_groups(scene, all);
    show({{DrawCopy{}}}, {});
  }
  return check_gl("uploading the model");
}

void SurfacePass::add_groups(const Scene& scene, std::span<const Ranges> groups) {
  upload_textures(scene, groups);
  for (const Ranges& ranges : groups) add_group(scene, ranges);
}

void SurfacePass::upload_textures(const Scene& scene, std::span<const Ranges> groups) {
  std::vector<WantedTexture> wanted;
  for (const Ranges& ranges : groups)
    for (const DrawRange& range : ranges) {
      const Material m = material_of(scene, range);
      const WantedTexture texture{m.texture, m.alpha_cutoff};
      if (m.texture < scene.textures.size() && uploaded_.try_emplace(texture).second)
        wanted.push_back(texture);
    }
  const auto read = read_textures(scene, wanted);
  for (std::size_t i = 0; i < wanted.size(); ++i)
    if (read[i]) uploaded_[wanted[i]] = upload_image(*read[i]);
}

void SurfacePass::add_group(const Scene& scene, Ranges ranges) {
  const auto group = static_cast<std::uint32_t>(shown_.size());
  shown_.emplace_back();
  for (const DrawRange& range : ranges) {
    Range r;
    r.group = group;
    r.ground = range.part == DrawPart::ground;
    r.count = static_cast<GLsizei>(range.index_count);
    r.first =
        reinterpret_cast<const void*>(sizeof(std::uint32_t) * std::size_t{range.first_index});  // NOLINT
    r.material = material_of(scene, range);
    const bool cut_out = r.material.alpha_cutoff > 0;
    r.thin = range.part == DrawPart::leaves || (range.part == DrawPart::mesh && cut_out) ? 1.0f : 0.0f;
    r.repeats = r.ground || leaves_unit_square(scene.geometry, range);
    const std::uint32_t t = r.material.texture;
    const auto known = uploaded_.find({t, r.material.alpha_cutoff});
    r.image = known != uploaded_.end() && known->second
                  ? *known->second
                  : flat_image(t == k_none ? Float3{1, 1, 1} : r.material.mean_colour);
    ranges_.push_back(std::move(r));
  }
}

void SurfacePass::replace(const std::vector<std::uint32_t>& indices, const std::vector<DrawRange>& ranges) {
  glBindVertexArray(array_.get());
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.get());
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(indices.size() * sizeof(std::uint32_t)),
               indices.data(), GL_DYNAMIC_DRAW);
  for (std::size_t i = 0; i < ranges_.size(); ++i) {
    ranges_[i].count = static_cast<GLsizei>(ranges[i].index_count);
    ranges_[i].first =
        reinterpret_cast<const void*>(sizeof(std::uint32_t) * std::size_t{ranges[i].first_index});  // NOLINT
  }
}

void SurfacePass::replace(std::size_t first, const std::vector<DrawVertex>& vertices) {
  glBindBuffer(GL_ARRAY_BUFFER, vertices_.get());
  glBufferSubData(GL_ARRAY_BUFFER, static_cast<GLintptr>(first * sizeof(DrawVertex)),
                  static_cast<GLsizeiptr>(vertices.size() * sizeof(DrawVertex)), vertices.data());
}

// GL 3.3 has no base instance: the attributes of a group's copies begin elsewhere instead.
void SurfacePass::point_at(std::size_t first_copy) const {
  glBindBuffer(GL_ARRAY_BUFFER, copies_.get());
  const std::size_t base = first_copy * sizeof(DrawCopy);
  for (GLuint row = 0; row < 3; ++row)
    glVertexAttribPointer(3 + row, 4, GL_FLOAT, GL_FALSE, sizeof(DrawCopy),
                          reinterpret_cast<const void*>(base + row * sizeof(Float4)));  // NOLINT
  glVertexAttribPointer(6, 4, GL_UNSIGNED_BYTE, GL_TRUE, sizeof(DrawCopy),
                        reinterpret_cast<const void*>(base + offsetof(DrawCopy, tint)));  // NOLINT
}

void SurfacePass::show(const std::vector<std::vector<DrawCopy>>& copies,
                       const std::vector<std::uint32_t>& ground) {
  gathered_.clear();
  for (std::size_t i = 0; i < shown_.size(); ++i) {
    const std::size_t count = i < copies.size() ? copies[i].size() : 0;
    shown_[i] = {static_cast<GLsizei>(count), gathered_.size()};
    if (count > 0) gathered_.insert(gathered_.end(), copies[i].begin(), copies[i].end());
  }
  glBindBuffer(GL_ARRAY_BUFFER, copies_.get());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(gathered_.size() * sizeof(DrawCopy)),
               gathered_.data(), GL_DYNAMIC_DRAW);
  ground_count_ = static_cast<GLsizei>(ground.size());
  if (ground.empty()) return;
  // An index buffer is bound to a vertex array.
  glBindVertexArray(array_.get());
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, ground_indices_.get());
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(ground.size() * sizeof(std::uint32_t)),
               ground.data(), GL_DYNAMIC_DRAW);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.get());
}

void SurfacePass::draw(const Program& program, bool with_light) const {
  glBindVertexArray(array_.get());
  glActiveTexture(GL_TEXTURE0);
  std::uint32_t group = k_none;
  for (const Range& r : ranges_) {
    const Shown& shown = shown_[r.group];
    if (shown.count == 0) continue;
    if (r.group != group) point_at(shown.first);
    group = r.group;
    glBindTexture(GL_TEXTURE_2D, images_[r.image].get());
    glBindSampler(0, r.repeats ? repeating_.get() : clamping_.get());
    if (with_light) {
      program.set("diffuse", r.material.diffuse);
      program.set("specular", r.material.specular);
      program.set("emission", r.material.emission);
      program.set("shininess", r.material.shininess);
      program.set("thin", r.thin);
      program.set("ground", r.ground ? 1 : 0);
    } else {
      program.set("cutoff", r.material.alpha_cutoff);
      program.set("opacity", r.material.alpha);
    }
    if (r.ground) glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, ground_indices_.get());
    glDrawElementsInstanced(GL_TRIANGLES, r.ground ? ground_count_ : r.count, GL_UNSIGNED_INT, r.first,
                            shown.count);
    if (r.ground) glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.get());
  }
  glBindSampler(0, 0);
}

void SurfacePass::draw_shadow(const Mat4& clip) const {
  shadow_.use();
  shadow_.set("image", 0);
  shadow_.set("clip", clip);
  draw(shadow_, false);
}

void SurfacePass::draw_coverage(const Mat4& clip, const Float3& offset, const Float2& corner,
                                bool multisampled) const {
  coverage_.use();
  coverage_.set("tile_corner", corner);
  coverage_.set("image", 0);
  coverage_.set("clip", clip);
  coverage_.set("offset", offset);
  coverage_.set("multisampled", multisampled ? 1 : 0);
  draw(coverage_, false);
}

void SurfacePass::draw_light(const Mat4& clip, const Float3& offset, bool lit, float ghost,
                             float haze_distance) const {
  light_.use();
  light_.set("image", 0);
  light_.set("clip", clip);
  light_.set("offset", offset);
  light_.set("lit", lit ? 1 : 0);
  light_.set("ghost", ghost);
  light_.set("haze_distance", haze_distance);
  draw(light_, true);
}

}  // namespace copse::treeplay
