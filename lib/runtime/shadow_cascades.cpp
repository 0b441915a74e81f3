#include "lib/runtime/shadow_cascades.h"

#include <algorithm>
#include <cmath>

namespace copse {
namespace {

// The box of the scene as the light sees it: coordinates along its axes, relative to the origin.
DoubleBox seen_by(const CameraFrame& light, const DoubleBox& scene, const Double3& origin) {
  DoubleBox box;
  for (int c = 0; c < 8; ++c) {
    const Double3 p = Double3{c & 1 ? scene.max.x : scene.min.x, c & 2 ? scene.max.y : scene.min.y,
                              c & 4 ? scene.max.z : scene.min.z} -
                      origin;
    box.grow(Double3{dot(p, light.right), dot(p, light.up), dot(p, light.back)});
  }
  return box;
}

struct Ball {
  double along = 0, radius = 0;  // its centre lies on the line of sight
};

// The smallest ball round a slice whose far corners are `spread` times their distance off the line of sight.
Ball round_slice(double begin, double end, double spread) {
  const double along = std::min(end, (begin + end) / 2 * (1 + spread * spread));
  return {along, std::hypot(end - along, end * spread)};
}

class Maker {
 public:
  Maker(const View& view, const Double3& sun, const DoubleBox& scene, const Double3& origin, int texels)
      : view_(view),
        origin_(origin),
        texels_(texels),
        light_(frame_of({.eye = sun, .target = {}, .up = {0, 1, 0}, .fov = 1})),
        scene_(seen_by(light_, scene, origin)) {
    const Double3 e = scene_.extent();
    // A border of four texels on every side, so that filters find nothing beyond it.
    scene_width_ = std::max(e.x, e.y) * texels / (texels - 8.0);
  }

  double scene_width() const { return scene_width_; }

  double width_of(double begin, double end) const {
    // Eight texels more: the border, and the step to the next whole texel.
    return 2 * round_slice(begin, end, spread()).radius * texels_ / (texels_ - 10.0);
  }

  ShadowCascade slice(double begin, double end) const {
    const double width = width_of(begin, end), texel = width / texels_;
    const Double3 centre = view_.eye - view_.frame.back * round_slice(begin, end, spread()).along - origin_;
    const auto whole = [&](double at) { return std::floor(at / texel + 0.5) * texel; };
    return map(begin, end, whole(dot(centre, light_.right)), whole(dot(centre, light_.up)), width);
  }

  ShadowCascade whole_scene(double begin, double end) const {
    const Double3 c = scene_.centre();
    return map(begin, end, c.x, c.y, scene_width_);
  }

 private:
  double spread() const { return std::hypot(view_.tan_half_x, view_.tan_half_y); }

  ShadowCascade map(double begin, double end, double x, double y, double width) const {
    ShadowCascade c;
    c.begin = begin, c.end = end, c.width = width;
    const double slack = 1e-3 * std::max(width, scene_.extent().z), half = width / 2;
    const double front = -scene_.max.z - slack, rear = -scene_.min.z + slack;
    c.depth = rear - front;
    c.clip = multiply(orthographic(x - half, x + half, y - half, y + half, front, rear),
                      rotation_into(light_.right, light_.up, light_.back));
    const Double3 eye = view_.eye - origin_;
    const auto plane = [&](const Double3& axis, double at) { return Plane{axis, dot(axis, eye) - at}; };
    c.casters = {plane(light_.right, x - half), plane(-light_.right, -x - half), plane(light_.up, y - half),
                 plane(-light_.up, -y - half),  plane(light_.back, -rear),       plane(-light_.back, front)};
    return c;
  }

  const View& view_;
  Double3 origin_;
  int texels_;
  CameraFrame light_;
  DoubleBox scene_;
  double scene_width_ = 0;
};

}  // namespace

ShadowCascades shadow_cascades(const View& view, const Double3& sun, const DoubleBox& scene,
                               const Double3& origin, const CascadeWish& wish) {
  ShadowCascades out;
  const Maker maker(view, sun, scene, origin, wish.texels);
  const double ratio = wish.farthest / wish.nearest, step = wish.farthest - wish.nearest;
  const auto border = [&](std::size_t i) {
    const double share = static_cast<double>(i) / static_cast<double>(wish.count);
    return 0.85 * wish.nearest * std::pow(ratio, share) + 0.15 * (wish.nearest + step * share);
  };
  // The first one also serves what is nearer than that.
  for (std::size_t i = 0; i < wish.count && !out.whole; ++i) {
    const double begin = i == 0 ? 0 : border(i), end = border(i + 1);
    out.whole = maker.scene_width() <= maker.width_of(begin, end);
    out.cascades[out.count++] = out.whole ? maker.whole_scene(begin, wish.farthest) : maker.slice(begin, end);
  }
  return out;
}

}  // namespace copse
