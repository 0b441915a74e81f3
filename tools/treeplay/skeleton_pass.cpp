#include "tools/treeplay/skeleton_pass.h"

#include "tools/treeplay/shaders.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace copse::treeplay {

Result<SkeletonPass> SkeletonPass::make() {
  using namespace shaders;
  SkeletonPass pass;
  auto line = Program::make("line", k_common, k_line_vertex, k_line_fragment);
  if (!line) return std::unexpected(line.error());
  auto disc = Program::make("disc", k_common, k_disc_vertex, k_disc_fragment);
  if (!disc) return std::unexpected(disc.error());
  auto sphere = Program::make("sphere", k_common, k_sphere_vertex, k_sphere_fragment);
  if (!sphere) return std::unexpected(sphere.error());
  pass.line_ = std::move(*line);
  pass.disc_ = std::move(*disc);
  pass.sphere_ = std::move(*sphere);
  return pass;
}

// Eight colours that stay apart in print and for most colour-blind eyes; deeper levels begin again.
SkeletonPass::Colour SkeletonPass::colour_of_level(std::uint32_t level) {
  static constexpr std::array<Colour, 8> k_palette{{{94, 60, 38, 255},
                                                    {213, 94, 0, 255},
                                                    {230, 159, 0, 255},
                                                    {0, 140, 95, 255},
                                                    {0, 114, 178, 255},
                                                    {130, 90, 190, 255},
                                                    {204, 90, 150, 255},
                                                    {60, 170, 205, 255}}};
  return k_palette[level % k_palette.size()];
}

// Hues by the golden angle: neighbours in the list differ most.
SkeletonPass::Colour SkeletonPass::colour_of_group(std::uint32_t group) {
  if (group == k_none) return {90, 150, 60, 255};
  const double hue = std::fmod(group * 0.61803398875, 1.0) * 6;
  const auto channel = [&](double shift) {
    const double h = std::fmod(hue + shift, 6.0);
    const double v = std::clamp(std::min(h, 4 - h), 0.0, 1.0);
    return static_cast<std::uint8_t>(std::lround(60 + 150 * v));
  };
  return {channel(2), channel(0), channel(4), 255};
}

namespace {

void attribute(GLuint index, GLint size, GLenum type, std::size_t stride, std::size_t at) {
  glEnableVertexAttribArray(index);
  glVertexAttribPointer(index, size, type, type == GL_UNSIGNED_BYTE, static_cast<GLsizei>(stride),
                        reinterpret_cast<const void*>(at));  // NOLINT: an offset, as GL wants it
  glVertexAttribDivisor(index, 1);
}

template <class T>
void fill(const VertexArray& array, const Buffer& buffer, const std::vector<T>& elements, GLenum usage) {
  glBindVertexArray(array.get());
  glBindBuffer(GL_ARRAY_BUFFER, buffer.get());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(elements.size() * sizeof(T)), elements.data(), usage);
}

}  // namespace

void SkeletonPass::disc_attributes() {
  attribute(0, 3, GL_FLOAT, sizeof(Disc), offsetof(Disc, centre));
  attribute(1, 1, GL_FLOAT, sizeof(Disc), offsetof(Disc, radius));
  attribute(2, 4, GL_UNSIGNED_BYTE, sizeof(Disc), offsetof(Disc, tint));
}

Result<void> SkeletonPass::upload(const Skeleton& skeleton) {
  std::vector<Line> lines;
  for (const SkeletonLine& l : skeleton.lines) {
    // A branch is as thick where it begins as where it comes out; a joint is a thread.
    const float from = l.joint ? 0 : l.diameter_a / 2;
    lines.push_back({l.a, l.b, from, l.joint ? 0 : l.diameter_b / 2,
                     l.joint ? Colour{150, 150, 150, 255} : colour_of_level(l.level)});
  }
  for (const GroupSphere& g : skeleton.groups) {
    if (g.hangs) lines.push_back({g.terminal, g.centre, 0, 0, {165, 165, 165, 255}});
  }
  std::vector<Disc> discs;
  for (const SkeletonPoint& p : skeleton.points) {
    // A dark dot on the line, so that both can be seen.
    Colour tint = colour_of_level(p.level);
    for (std::size_t c = 0; c < 3; ++c) tint[c] = p.root ? 0 : static_cast<std::uint8_t>(tint[c] * 3 / 5);
    discs.push_back({p.centre, 0.3f * p.diameter, tint});
  }
  for (const LeafPoint& p : skeleton.leaves) {
    discs.push_back({p.centre, 0.13f * p.diameter, colour_of_group(p.group)});
  }
  for (std::uint32_t g = 0; g < skeleton.groups.size(); ++g) {
    spheres_.push_back({skeleton.groups[g].centre, skeleton.groups[g].radius, colour_of_group(g)});
  }
  sorted_ = spheres_;
  by_distance_.resize(spheres_.size());
  if (auto done = upload(lines, discs); !done) return done;
  sphere_array_ = make_vertex_array();
  sphere_buffer_ = make_buffer();
  fill(sphere_array_, sphere_buffer_, spheres_, GL_DYNAMIC_DRAW);
  disc_attributes();
  return check_gl("uploading the skeleton");
}

Result<void> SkeletonPass::upload(const std::vector<Line>& lines, const std::vector<Disc>& discs) {
  line_count_ = lines.size();
  disc_count_ = discs.size();
  for (VertexArray* array : {&line_array_, &disc_array_})
    if (!*array) *array = make_vertex_array();
  for (Buffer* buffer : {&line_buffer_, &disc_buffer_})
    if (!*buffer) *buffer = make_buffer();
  fill(line_array_, line_buffer_, lines, GL_DYNAMIC_DRAW);
  attribute(0, 3, GL_FLOAT, sizeof(Line), offsetof(Line, from));
  attribute(1, 3, GL_FLOAT, sizeof(Line), offsetof(Line, to));
  attribute(2, 2, GL_FLOAT, sizeof(Line), offsetof(Line, radius_from));
  attribute(3, 4, GL_UNSIGNED_BYTE, sizeof(Line), offsetof(Line, tint));
  fill(disc_array_, disc_buffer_, discs, GL_DYNAMIC_DRAW);
  disc_attributes();
  return check_gl("uploading lines and points");
}

void SkeletonPass::set_common(const Program& program, const Frame& frame) {
  program.use();
  program.set("clip", frame.clip);
  program.set("offset", frame.offset);
  program.set("right", to_float(frame.view->frame.right));
  program.set("up", to_float(frame.view->frame.up));
  program.set("fragment_angle", frame.fragment_angle);
  program.set("thinnest", frame.thinnest);
  program.set("scale", frame.scale);
  program.set("lit", frame.lit ? 1 : 0);
  program.set("sun_direction", frame.sun);
}

void SkeletonPass::draw_lines(const Frame& frame) const {
  set_common(line_, frame);
  glBindVertexArray(line_array_.get());
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(line_count_));
  set_common(disc_, frame);
  glBindVertexArray(disc_array_.get());
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(disc_count_));
}

void SkeletonPass::draw_spheres(const Frame& frame) {
  for (std::uint32_t i = 0; i < spheres_.size(); ++i) {
    by_distance_[i] = {-length(to_double(spheres_[i].centre + frame.offset)), i};
  }
  std::sort(by_distance_.begin(), by_distance_.end());
  for (std::size_t i = 0; i < spheres_.size(); ++i) sorted_[i] = spheres_[by_distance_[i].second];
  glBindBuffer(GL_ARRAY_BUFFER, sphere_buffer_.get());
  glBufferSubData(GL_ARRAY_BUFFER, 0, static_cast<GLsizeiptr>(sorted_.size() * sizeof(Disc)), sorted_.data());
  set_common(sphere_, frame);
  glBindVertexArray(sphere_array_.get());
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(spheres_.size()));
}

}  // namespace copse::treeplay
