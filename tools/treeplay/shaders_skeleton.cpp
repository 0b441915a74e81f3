#include "tools/treeplay/shaders.h"

namespace copse::treeplay::shaders {

// A line is a flat quad that faces the eye; the fragment shader cuts it to a capsule whose radius changes
// along the way and shades it like a rod.
const std::string_view k_line_vertex = R"(
vec3 to_linear(vec3 s) {
  return mix(s / 12.92, pow((s + 0.055) / 1.055, vec3(2.4)), vec3(greaterThan(s, vec3(0.04045))));
}
layout(location = 0) in vec3 from;
layout(location = 1) in vec3 to;
layout(location = 2) in vec2 radii;
layout(location = 3) in vec4 tint;
uniform mat4 clip;
uniform vec3 offset;
uniform float fragment_angle;  // of one fragment's height, radians
uniform float thinnest;        // half-width in fragments
uniform float scale;           // of the radii
out vec2 v_at;                 // along, across; metres from `from`
flat out float v_length;
flat out vec2 v_radii;
flat out vec3 v_across, v_towards;
flat out vec4 v_tint;
void main() {
  vec3 a = from + offset, b = to + offset;
  vec3 towards = -normalize(a + b + vec3(1e-30));
  vec3 axis = b - a;
  vec3 across = cross(axis, towards);
  float size = length(across);
  across = size > 1e-6 * length(axis) && size > 0.0 ? across / size
           : normalize(cross(abs(towards.y) < 0.9 ? vec3(0, 1, 0) : vec3(1, 0, 0), towards));
  vec3 along = cross(towards, across);
  float least = thinnest * fragment_angle;
  v_radii = max(radii * scale, least * vec2(length(a), length(b)));
  v_length = dot(axis, along);
  v_across = across;
  v_towards = towards;
  v_tint = vec4(to_linear(tint.rgb), tint.a);
  float widest = max(v_radii.x, v_radii.y) + fragment_angle * max(length(a), length(b));
  bool end = (gl_VertexID & 1) != 0;
  float side = (gl_VertexID & 2) != 0 ? 1.0 : -1.0;
  v_at = vec2(end ? v_length + widest : -widest, side * widest);
  vec3 p = (end ? b + along * widest : a - along * widest) + across * side * widest;
  gl_Position = clip * vec4(p, 1.0);
}
)";

const std::string_view k_line_fragment = R"(
uniform bool lit;
in vec2 v_at;
flat in float v_length;
flat in vec2 v_radii;
flat in vec3 v_across, v_towards;
flat in vec4 v_tint;
out vec4 colour;

// The distance to the outline of a ball that rolls from one end to the other while its radius changes: two arcs
// and their common tangent. When one ball swallows the other, the larger one.
float outline(vec2 p, float length_, vec2 r) {
  float taper = length_ > 0.0 ? (r.x - r.y) / length_ : 2.0;
  if (abs(taper) >= 1.0) return r.x > r.y ? length(p) - r.x : distance(p, vec2(length_, 0.0)) - r.y;
  float slope = sqrt(1.0 - taper * taper);
  vec2 q = vec2(p.x, abs(p.y));
  float along = slope * q.x - taper * q.y;
  if (along < 0.0) return length(q) - r.x;
  if (along > slope * length_) return distance(q, vec2(length_, 0.0)) - r.y;
  return taper * q.x + slope * q.y - r.x;
}

void main() {
  float s = v_length > 0.0 ? clamp(v_at.x / v_length, 0.0, 1.0) : 0.0;
  float r = mix(v_radii.x, v_radii.y, s);
  float d = outline(v_at, v_length, v_radii);
  float covered = clamp(0.5 - d / max(fwidth(d), 1e-30), 0.0, 1.0);
  if (covered <= 0.0) discard;
  float out_there = clamp(v_at.y / r, -1.0, 1.0);
  vec3 n = v_across * out_there + v_towards * sqrt(max(0.0, 1.0 - out_there * out_there));
  float light = lit ? 0.55 + 0.30 * dot(n, sun_direction) + 0.25 * dot(n, v_towards) : 1.0;
  colour = vec4(v_tint.rgb * light, covered);
}
)";

const std::string_view k_disc_vertex = R"(
vec3 to_linear(vec3 s) {
  return mix(s / 12.92, pow((s + 0.055) / 1.055, vec3(2.4)), vec3(greaterThan(s, vec3(0.04045))));
}
layout(location = 0) in vec3 centre;
layout(location = 1) in float radius;
layout(location = 2) in vec4 tint;
uniform mat4 clip;
uniform vec3 offset;
uniform vec3 right, up;
uniform float fragment_angle, thinnest, scale;
out vec2 v_at;  // in radii
flat out vec3 v_towards;
flat out vec4 v_tint;
void main() {
  vec3 c = centre + offset;
  float r = max(radius * scale, thinnest * fragment_angle * length(c));
  float grown = 1.0 + fragment_angle * length(c) / max(r, 1e-30);
  v_at = (vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0) * grown;
  v_towards = -normalize(c);
  v_tint = vec4(to_linear(tint.rgb), tint.a);
  // In front of the lines that end here.
  vec3 p = c * (1.0 - r / max(length(c), r)) + (right * v_at.x + up * v_at.y) * r * (1.0 - r / max(length(c), r));
  gl_Position = clip * vec4(p, 1.0);
}
)";

const std::string_view k_disc_fragment = R"(
uniform vec3 right, up;
uniform bool lit;
in vec2 v_at;
flat in vec3 v_towards;
flat in vec4 v_tint;
out vec4 colour;
void main() {
  float d = length(v_at) - 1.0;
  float covered = clamp(0.5 - d / max(fwidth(d), 1e-30), 0.0, 1.0);
  if (covered <= 0.0) discard;
  vec3 n = right * v_at.x + up * v_at.y + v_towards * sqrt(max(0.0, 1.0 - dot(v_at, v_at)));
  float light = lit ? 0.6 + 0.25 * dot(n, sun_direction) + 0.25 * dot(n, v_towards) : 1.0;
  colour = vec4(v_tint.rgb * light, covered);
}
)";

// A sphere as glass: clear in the middle, coloured at the rim. Its outline is exact in perspective.
const std::string_view k_sphere_vertex = R"(
vec3 to_linear(vec3 s) {
  return mix(s / 12.92, pow((s + 0.055) / 1.055, vec3(2.4)), vec3(greaterThan(s, vec3(0.04045))));
}
layout(location = 0) in vec3 centre;
layout(location = 1) in float radius;
layout(location = 2) in vec4 tint;
uniform mat4 clip;
uniform vec3 offset;
uniform float fragment_angle;
out vec3 v_relative;
flat out vec3 v_centre;
flat out float v_radius;
flat out vec4 v_tint;
void main() {
  v_centre = centre + offset;
  v_radius = radius;
  v_tint = vec4(to_linear(tint.rgb), tint.a);
  float away = length(v_centre);
  vec3 towards = -v_centre / max(away, 1e-30);
  vec3 side = normalize(cross(abs(towards.y) < 0.9 ? vec3(0, 1, 0) : vec3(1, 0, 0), towards));
  vec3 over = cross(towards, side);
  // The cone from the eye that touches the sphere, cut at the sphere's centre; none from inside.
  float outline = away > radius * 1.0001 ? radius * away / sqrt(away * away - radius * radius) : 0.0;
  outline += outline > 0.0 ? fragment_angle * away * 2.0 : 0.0;
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
  v_relative = v_centre + (side * corner.x + over * corner.y) * outline;
  gl_Position = clip * vec4(v_relative, 1.0);
}
)";

const std::string_view k_sphere_fragment = R"(
in vec3 v_relative;
flat in vec3 v_centre;
flat in float v_radius;
flat in vec4 v_tint;
out vec4 colour;
void main() {
  vec3 ray = normalize(v_relative);
  float along = dot(ray, v_centre);
  float miss = length(v_centre - ray * along) / v_radius;  // 1 at the outline
  float covered = clamp(0.5 + (1.0 - miss) / max(fwidth(miss), 1e-30), 0.0, 1.0);
  if (covered <= 0.0) discard;
  float inside = sqrt(max(0.0, 1.0 - miss * miss));
  vec3 n = (ray * (along - inside * v_radius) - v_centre) / v_radius;
  float rim = pow(1.0 - inside, 2.0);
  float light = 0.85 + 0.25 * dot(n, sun_direction);
  colour = vec4(v_tint.rgb * light, covered * mix(0.05, 0.7, rim));
}
)";

}  // namespace copse::treeplay::shaders
