#include "tools/treeplay/shaders.h"

namespace copse::treeplay::shaders {

// The quad through the middle of the sphere that hides it, as seen from the eye. "tree" is the tree's own
// frame.
const std::string_view k_impostor_vertex = R"(
layout(location = 3) in vec4 row_x;  // of the instance: from its tree's frame to "local"
layout(location = 4) in vec4 row_y;
layout(location = 5) in vec4 row_z;
layout(location = 6) in vec4 tint;
layout(location = 7) in vec3 view;
layout(location = 8) in vec3 weight;
uniform sampler2D view_frames;  // right, up and toward of every view
uniform mat4 clip;
uniform vec3 offset, centre;
uniform float radius;
uniform float pixel;            // tangent of the angle that one covers
out vec3 v_tree;
flat out vec3 f_eye;            // in the tree's frame
flat out vec3 f_right[3], f_up[3], f_toward[3], f_view, f_weight, f_tint;
flat out vec4 f_x, f_y, f_z;
flat out int f_steps;           // towards where a ray meets the tree
flat out float f_pixels;        // which are drawn
vec3 decode(vec3 c) { return mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), vec3(greaterThan(c, vec3(0.04045)))); }
invariant gl_Position;  // both passes must agree to the bit
void main() {
  float square = dot(row_x.xyz, row_x.xyz);  // of the scale
  vec3 gap = -offset - vec3(row_x.w, row_y.w, row_z.w);
  f_eye = (row_x.xyz * gap.x + row_y.xyz * gap.y + row_z.xyz * gap.z) / square;
  vec3 eye = f_eye - centre;
  float away = max(length(eye), 1e-30);
  vec3 towards = eye / away;
  vec3 right = normalize(cross(abs(towards.y) < 0.999 ? vec3(0, 1, 0) : vec3(0, 0, 1), towards));
  vec3 up = cross(towards, right);
  float reach = away > 1.01 * radius ? radius * away / sqrt(away * away - radius * radius) : 8.0 * radius;
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
  v_tree = centre + (right * corner.x + up * corner.y) * reach;
  for (int k = 0; k < 3; ++k) {
    int row = int(view[k] + 0.5);
    f_right[k] = texelFetch(view_frames, ivec2(0, row), 0).xyz;
    f_up[k] = texelFetch(view_frames, ivec2(1, row), 0).xyz;
    f_toward[k] = texelFetch(view_frames, ivec2(2, row), 0).xyz;
  }
  f_view = view;
  f_weight = weight;
  f_tint = decode(tint.rgb);
  f_pixels = floor(255.0 * tint.a + 0.5);
  f_x = row_x; f_y = row_y; f_z = row_z;
  f_steps = 2.0 * radius > 96.0 * away * pixel ? 4 : 2;
  vec4 p = vec4(v_tree, 1.0);
  vec3 local = vec3(dot(row_x, p), dot(row_y, p), dot(row_z, p));
  gl_Position = clip * vec4(local + offset, 1.0);
}
)";

// What a ray meets. In front of the fragment shaders below.
const std::string_view k_impostor_common = R"(
uniform sampler2DArray albedo_layers, normal_layers;
uniform vec3 centre;
uniform float radius;
in vec3 v_tree;
flat in vec3 f_eye;
flat in vec3 f_right[3], f_up[3], f_toward[3], f_view, f_weight, f_tint;
flat in vec4 f_x, f_y, f_z;
flat in int f_steps;

struct Met {
  vec4 colour;   // premultiplied; alpha is the share that is covered
  vec3 normal;   // in the tree's frame, any length
  vec3 place;    // as well
  vec3 along;    // of the ray
};

// Where a point of a view's plane lies in its picture, whose rows start at the top.
vec2 place_in(int k, vec3 p) {
  return vec2(dot(p, f_right[k]), -dot(p, f_up[k])) / radius * 0.5 + 0.5;
}

Met meet(bool want_normal) {
  Met met;
  met.along = normalize(v_tree - f_eye);
  vec3 from = v_tree - centre;
  met.colour = vec4(0.0);
  met.normal = vec3(0.0);
  float height = 0.0;  // along the ray, of what is met
  for (int k = 0; k < 3; ++k) {
    float slope = dot(met.along, f_toward[k]);
    vec2 flat_place = place_in(k, from);
    vec2 dx = dFdx(flat_place), dy = dFdy(flat_place);
    if (f_weight[k] <= 0.0 || abs(slope) < 1e-3) continue;
    vec2 at = flat_place;
    float t = 0.0, depth = 0.0;
    for (int i = 0; i < f_steps; ++i) {
      t = (depth - dot(from, f_toward[k])) / slope;
      at = place_in(k, from + met.along * t);
      depth = (2.0 * textureGrad(normal_layers, vec3(at, f_view[k]), dx, dy).a - 1.0) * radius;
    }
    if (any(lessThan(at, vec2(0.0))) || any(greaterThan(at, vec2(1.0)))) continue;
    vec4 c = textureGrad(albedo_layers, vec3(at, f_view[k]), dx, dy);
    float w = f_weight[k] * c.a;
    met.colour += vec4(c.rgb * w, w);
    height += w * t;
    if (!want_normal) continue;
    vec3 n = textureGrad(normal_layers, vec3(at, f_view[k]), dx, dy).rgb * 2.0 - 1.0;
    met.normal += w * (f_right[k] * n.x + f_up[k] * n.y + f_toward[k] * n.z);
  }
  met.place = v_tree + met.along * (height / max(met.colour.a, 1e-6));
  return met;
}
)";

const std::string_view k_impostor_coverage_fragment = R"(
uniform bool multisampled;
flat in float f_pixels;
out vec4 colour;
void main() {
  float covered = meet(false).colour.a;
  int kept = kept_samples(f_pixels, multisampled);
  if (kept == 0 || (multisampled ? covered <= 0.0 : covered < 0.5)) discard;
  keep_samples(kept);
  colour = vec4(0.0, 0.0, 0.0, covered);
}
)";

const std::string_view k_impostor_light_fragment = R"(
uniform vec3 offset;
uniform bool lit;
uniform float haze_distance;
out vec4 colour;

vec3 turned(vec3 v) { return vec3(dot(f_x.xyz, v), dot(f_y.xyz, v), dot(f_z.xyz, v)); }

void main() {
  Met met = meet(true);
  vec3 albedo = met.colour.rgb / max(met.colour.a, 1e-6) * f_tint;
  vec4 place = vec4(met.place, 1.0);
  vec3 local = vec3(dot(f_x, place), dot(f_y, place), dot(f_z, place));
  vec3 c = albedo;
  if (lit) {
    float sun;
    c = light_on(albedo, local, -normalize(turned(met.along)), normalize(turned(met.normal) + vec3(1e-6)), k_thin, sun);
    c = tone(hazed(c, local + offset, haze_distance));
  }
  colour = vec4(clamp(c, 0.0, 1.0), 1.0);
}
)";

// Far away: the nearest picture alone, as it was taken. The eye is nearly where it was taken from.
// Its instances are rows of a texture, four texels each, and six vertices: drawing four vertices a hundred
// thousand times costs a driver more than fetching does.
const std::string_view k_picture_vertex = R"(
uniform sampler2D view_frames, copies;
uniform int copies_a_row;
uniform mat4 clip;
uniform vec3 offset, centre;
uniform float radius;
out vec3 v_local, v_place;  // v_place: in the picture, and which
flat out vec3 f_right, f_up, f_toward, f_tint;
flat out float f_pixels;  // which are drawn
vec3 decode(vec3 c) { return mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), vec3(greaterThan(c, vec3(0.04045)))); }
vec4 row_x, row_y, row_z;
vec3 turned(vec3 v) { return vec3(dot(row_x.xyz, v), dot(row_y.xyz, v), dot(row_z.xyz, v)); }
invariant gl_Position;  // both passes must agree to the bit
void main() {
  int copy = gl_VertexID / 6, corner_number = gl_VertexID % 6;
  ivec2 at = ivec2(4 * (copy % copies_a_row), copy / copies_a_row);
  row_x = texelFetch(copies, at, 0);
  row_y = texelFetch(copies, at + ivec2(1, 0), 0);
  row_z = texelFetch(copies, at + ivec2(2, 0), 0);
  vec4 view_tint = texelFetch(copies, at + ivec2(3, 0), 0);
  int row = int(view_tint.x);
  f_pixels = 256.0 * (view_tint.x - float(row));
  f_right = turned(texelFetch(view_frames, ivec2(0, row), 0).xyz);
  f_up = turned(texelFetch(view_frames, ivec2(1, row), 0).xyz);
  f_toward = turned(texelFetch(view_frames, ivec2(2, row), 0).xyz);
  f_tint = decode(view_tint.yzw);
  // Two triangles: 0 1 2, 2 1 3.
  int c = corner_number < 3 ? corner_number : corner_number == 3 ? 2 : corner_number == 4 ? 1 : 3;
  vec2 corner = vec2(c & 1, c >> 1) * 2.0 - 1.0;
  v_place = vec3(corner.x * 0.5 + 0.5, 0.5 - corner.y * 0.5, float(row));
  v_local = turned(centre) + vec3(row_x.w, row_y.w, row_z.w) + (f_right * corner.x + f_up * corner.y) * radius;
  gl_Position = clip * vec4(v_local + offset, 1.0);
}
)";

const std::string_view k_picture_coverage_fragment = R"(
uniform sampler2DArray albedo_layers;
uniform bool multisampled;
in vec3 v_place;
flat in float f_pixels;
out vec4 colour;
void main() {
  float covered = texture(albedo_layers, v_place).a;
  int kept = kept_samples(f_pixels, multisampled);
  if (kept == 0 || (multisampled ? covered <= 0.0 : covered < 0.5)) discard;
  keep_samples(kept);
  colour = vec4(0.0, 0.0, 0.0, covered);
}
)";

const std::string_view k_picture_light_fragment = R"(
uniform sampler2DArray albedo_layers, normal_layers;
uniform vec3 offset;
uniform bool lit;
uniform float haze_distance;
in vec3 v_local, v_place;
flat in vec3 f_right, f_up, f_toward, f_tint;
out vec4 colour;
void main() {
  vec3 c = texture(albedo_layers, v_place).rgb * f_tint;
  if (lit) {
    vec3 n = texture(normal_layers, v_place).rgb * 2.0 - 1.0;
    float sun;
    c = light_on(c, v_local, -normalize(v_local + offset), normalize(f_right * n.x + f_up * n.y + f_toward * n.z + vec3(1e-6)), k_thin, sun);
    c = tone(hazed(c, v_local + offset, haze_distance));
  }
  colour = vec4(clamp(c, 0.0, 1.0), 1.0);
}
)";

}  // namespace copse::treeplay::shaders
