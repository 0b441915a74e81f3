#include "tools/treeplay/shaders.h"

namespace copse::treeplay::shaders {

const std::string_view k_surface_vertex = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 texcoord;
layout(location = 3) in vec4 row_x;  // of the instance: from its tree's frame to "local"
layout(location = 4) in vec4 row_y;
layout(location = 5) in vec4 row_z;
layout(location = 6) in vec4 tint;
uniform mat4 clip;
uniform vec3 offset;
out vec3 v_local, v_normal, v_tint;
out vec2 v_texcoord;
flat out float f_pixels;  // which are drawn
vec3 decode(vec3 c) { return mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), vec3(greaterThan(c, vec3(0.04045)))); }
invariant gl_Position;  // both passes must agree to the bit
void main() {
  vec4 p = vec4(position, 1.0);
  v_local = vec3(dot(row_x, p), dot(row_y, p), dot(row_z, p));
  v_normal = vec3(dot(row_x.xyz, normal), dot(row_y.xyz, normal), dot(row_z.xyz, normal));
  v_tint = decode(tint.rgb);
  f_pixels = floor(255.0 * tint.a + 0.5);
  v_texcoord = vec2(texcoord.x, 1.0 - texcoord.y);  // images start at the top
  gl_Position = clip * vec4(v_local + offset, 1.0);
}
)";

const std::string_view k_coverage_fragment = R"(
uniform sampler2D image;
uniform float cutoff, opacity;
uniform bool multisampled;
in vec2 v_texcoord;
flat in float f_pixels;
out vec4 colour;
void main() {
  float a = texture(image, v_texcoord).a;
  // The cut is one fragment wide, centred where alpha crosses the cutoff.
  float covered = cutoff > 0.0 ? clamp((a * opacity - cutoff) / max(fwidth(a), 1e-4) + 0.5, 0.0, 1.0) : opacity;
  int kept = kept_samples(f_pixels, multisampled);
  if (kept == 0 || (multisampled ? covered <= 0.0 : covered < 0.5)) discard;
  keep_samples(kept);
  colour = vec4(0.0, 0.0, 0.0, covered);
}
)";

const std::string_view k_surface_fragment = R"(
uniform sampler2D image;
uniform vec3 offset;
uniform vec3 diffuse, specular, emission;
uniform float shininess;
uniform float thin;   // 1 for leaves: light shines through
uniform bool lit;
uniform float ghost;  // towards the backdrop, so that lines drawn over it stand out
uniform bool ground;  // a terrain: bare colours get patches and grain
uniform float haze_distance;  // metres at which haze has two thirds of what is seen; 0: there is none
in vec3 v_local, v_normal, v_tint;
in vec2 v_texcoord;
out vec4 colour;

// In metres; each pattern fades out before it gets finer than a fragment.
vec3 soil(vec3 albedo) {
  vec2 at = v_local.xz;
  float fine = sqrt(length(dFdx(at)) * length(dFdy(at)));
  float patches = value_noise(at * 0.06 + 5.0) + 0.5 * value_noise(at * 0.17 + 9.0) - 0.75;
  float grain = 0.0, weight = 0.5;
  for (float f = 0.9; f < 60.0; f *= 2.7) {
    grain += weight * (value_noise(at * f + f) - 0.5) * (1.0 - smoothstep(0.25, 1.1, fine * f));
    weight *= 0.85;
  }
  vec3 c = albedo * (1.0 + 0.25 * patches + 0.7 * grain);
  return mix(c, c * vec3(1.34, 1.06, 0.80), 0.8 * smoothstep(-0.6, 1.0, patches + 0.8 * grain));
}

vec3 shade(vec3 albedo) {
  vec3 view = -normalize(v_local + offset);
  // The side that is seen decides where the normal points, whatever the winding; but not of one that lies across
  // its face, as of grass, which is lit as its ground is (digest 000, 4.9).
  vec3 face = cross(dFdx(v_local), dFdy(v_local));
  if (dot(face, view) < 0.0) face = -face;
  vec3 n = normalize(v_normal);
  if (dot(n, normalize(face)) < -0.7) n = -n;
  float sun;
  vec3 c = light_on(albedo, v_local, view, n, thin, sun);
  float facing = dot(n, sun_direction);
  vec3 halfway = normalize(view + sun_direction);
  if (shininess > 0.0 && facing > 0.0) {
    c += specular * k_sun_colour * sun * pow(max(dot(n, halfway), 0.0), shininess);
  }
  return c;
}

void main() {
  vec3 albedo = diffuse * v_tint * texture(image, v_texcoord).rgb;
  if (ground) albedo = soil(albedo);
  vec3 c = albedo + emission;
  if (lit) {
    c = tone(hazed(shade(albedo) + emission, v_local + offset, haze_distance));
  }
  c = clamp(c, 0.0, 1.0);
  colour = vec4(mix(c, vec3(0.86), ghost), 1.0);
}
)";

const std::string_view k_shadow_vertex = R"(
layout(location = 0) in vec3 position;
layout(location = 2) in vec2 texcoord;
layout(location = 3) in vec4 row_x;
layout(location = 4) in vec4 row_y;
layout(location = 5) in vec4 row_z;
uniform mat4 clip;
out vec2 v_texcoord;
void main() {
  vec4 p = vec4(position, 1.0);
  v_texcoord = vec2(texcoord.x, 1.0 - texcoord.y);
  gl_Position = clip * vec4(dot(row_x, p), dot(row_y, p), dot(row_z, p), 1.0);
}
)";

const std::string_view k_shadow_fragment = R"(
uniform sampler2D image;
uniform float cutoff, opacity;
in vec2 v_texcoord;
void main() {
  float a = opacity * (cutoff > 0.0 ? texture(image, v_texcoord).a : 1.0);
  // What is half transparent casts half a shadow: a pattern of texels, smoothed by the filter that reads it.
  if (cutoff > 0.0 ? a < cutoff : a < 1.0 && a <= random(uvec2(gl_FragCoord.xy))) discard;
}
)";

}  // namespace copse::treeplay::shaders
