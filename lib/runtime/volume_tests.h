// The tests of a bounding volume that a real-time program makes: point, plane, frustum, ray, box and ball.
//
// All in float, without allocation, and on the safe side: what is told to be outside is outside. The
// inequalities are those of lib/formats/volumes/volume.h with room for the roundings of float, so a point
// that is certified to be inside is never told to be outside, and one that is farther out than
// k_volume_margin of (its distance + the volume's size) is never told to be inside. Squares must neither
// overflow nor underflow: sizes and distances from 1e-15 to 1e15 m (beyond, answers stay on the safe side).
//
// Source: digest 002, section 5 (5.1: the uniform form; the errata of the printed tests are binding).
#pragma once

#include "lib/formats/volumes/volume.h"
#include "lib/runtime/camera.h"

#include <cstdint>
#include <limits>
#include <span>

namespace copse {

inline constexpr float k_volume_margin = 0x1p-17f;

// Keeps what has dot(normal, p) + offset >= 0; |normal| = 1.
struct FloatPlane {
  Float3 normal{0, 1, 0};
  float offset = 0;
};

// What has origin + t direction with 0 <= t <= length; |direction| = 1.
struct FloatRay {
  Float3 origin;
  Float3 direction{0, 0, 1};
  float length = std::numeric_limits<float>::infinity();
};

bool contains(const Volume<float>& volume, const Float3& point);

// outside: wholly on the side that the plane does not keep; inside: wholly on the other; else crossing.
Visibility side_of(const Volume<float>& volume, const FloatPlane& plane);

// The planes whose bit is set in `mask` (bit i: planes[i]); those on whose inner side the volume lies wholly
// are taken out of the mask, so that what is below need not be tested against them. Single-plane tests: a
// volume outside near an edge of the frustum may pass (digest 002, section 5.0).
Visibility in_frustum(const Volume<float>& volume, std::span<const FloatPlane> planes, std::uint32_t& mask);

bool meets_ray(const Volume<float>& volume, const FloatRay& ray);
bool meets_box(const Volume<float>& volume, const FloatBox& box);
bool meets_ball(const Volume<float>& volume, const Float3& centre, float radius);

}  // namespace copse
