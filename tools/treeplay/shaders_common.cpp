#include "tools/treeplay/shaders.h"

namespace copse::treeplay::shaders {

const std::string_view k_common = R"(
const float k_pi = 3.14159265;

uniform vec3 sun_direction;         // towards the sun
uniform sampler2DShadow shadow_map; // compares
uniform sampler2D shadow_depth;     // the same texture, as depths
// One shadow map for what is near, others for what is farther, side by side in one texture.
const int k_most_shadows = 4;
uniform int shadow_count;
uniform mat4 shadow_matrix[k_most_shadows];  // local -> [0, 1]^3 of a map
uniform vec2 shadow_reach[k_most_shadows];   // width of the map and depth of its box, m
uniform vec4 shadow_place[k_most_shadows];   // of the map in the texture: scale, then corner
uniform bool shadow_ends;                    // beyond the last map are shadows that no map holds
uniform sampler3D sky_grid;
uniform vec3 sky_corner, sky_extent, sky_opens;
uniform vec2 tile_corner;           // of this tile in the whole image, in fragments

const vec3 k_sun_colour = vec3(1.0, 0.89, 0.72) * 2.75;
const vec3 k_sky_colour = vec3(0.56, 0.70, 0.95) * 0.95;  // what an upright white surface gets from an open sky
const vec3 k_ground_colour = vec3(0.098, 0.122, 0.044);
const float k_thin = 0.7;           // of a picture of a tree: it does not say which is bark and which are leaves
const float k_sun_spread = 0.011;   // tangent of half the sun's angle; about twice the real sun's

uint hash(uint x) {
  x ^= x >> 16; x *= 0x7feb352du;
  x ^= x >> 15; x *= 0x846ca68bu;
  return x ^ (x >> 16);
}
float random(uvec2 p) { return float(hash(p.x + hash(p.y)) >> 8) / 16777216.0; }
uvec2 pixel() { return uvec2(gl_FragCoord.xy + tile_corner); }

// Exact below one half, then a shoulder that reaches 1 at infinity; its slope is continuous.
vec3 tone(vec3 c) {
  vec3 x = max(c, vec3(0.0));
  return mix(x, 1.0 - 0.5 * exp(1.0 - 2.0 * x), vec3(greaterThan(x, vec3(0.5))));
}

float value_noise(vec2 p) {
  vec2 cell = floor(p), f = fract(p);
  f = f * f * (3.0 - 2.0 * f);
  uvec2 i = uvec2(ivec2(cell));
  return mix(mix(random(i), random(i + uvec2(1u, 0u)), f.x),
             mix(random(i + uvec2(0u, 1u)), random(i + uvec2(1u, 1u)), f.x), f.y);
}

// Below the horizon: what the horizon is there, so that hazy ground goes over into it.
vec3 sky(vec3 direction) {
  vec3 d = normalize(vec3(direction.x, max(direction.y, 0.0), direction.z));
  const vec3 k_horizon = vec3(0.68, 0.82, 0.93), k_zenith = vec3(0.06, 0.185, 0.50);
  vec3 c = mix(k_horizon, k_zenith, 1.0 - pow(1.0 - d.y, 3.4));
  // High thin clouds on a plane, lost in the haze of the horizon.
  if (d.y > 0.01) {
    vec2 at = d.xz / (d.y + 0.06) * vec2(0.9, 1.5);
    float n = 0.0, weight = 0.5;
    for (int i = 0; i < 5; ++i) {
      n += weight * value_noise(at + 37.0);
      at = mat2(1.6, 1.2, -1.2, 1.6) * at + 11.0;
      weight *= 0.5;
    }
    float cloud = smoothstep(0.50, 0.85, n) * smoothstep(0.01, 0.22, d.y);
    c = mix(c, vec3(0.95, 0.96, 0.98), 0.55 * cloud);
  }
  float towards = max(dot(d, sun_direction), 0.0);
  return c + k_sun_colour * (0.05 * pow(towards, 6.0) + 0.08 * pow(towards, 60.0));
}

// Point i of n, spread evenly over the unit disc.
vec2 disc_point(int i, int n, float turn) {
  float r = sqrt((float(i) + 0.5) / float(n)), a = float(i) * 2.399963 + turn;
  return r * vec2(cos(a), sin(a));
}

// The share of the sun that reaches a point: sharp where the shadow is cast from near, soft from afar. It is read
// in the first map that holds the point. `far`: what takes its place where maps end.
float sunlight(vec3 local, vec3 normal, float far) {
  float grazing = 1.0 - abs(dot(normal, sun_direction));
  float size = float(textureSize(shadow_depth, 0).x);
  // Software renderers go through all of a loop for every fragment, so nothing is read in this one.
  int map = shadow_count;
  vec3 p = vec3(0.0);
  vec2 reach = vec2(1.0);
  vec4 place = vec4(1.0, 1.0, 0.0, 0.0);
  float texel = 1.0;
  for (int i = shadow_count - 1; i >= 0; --i) {
    float t = shadow_reach[i].x / (size * shadow_place[i].x);
    vec3 q = (shadow_matrix[i] * vec4(local + normal * t * (1.0 + 2.0 * grazing), 1.0)).xyz;
    float border = shadow_count > 1 ? 2.0 * t / shadow_reach[i].x : 0.0;
    if (any(lessThan(q, vec3(border, border, 0.0))) || any(greaterThan(q, vec3(1.0 - border, 1.0 - border, 1.0)))) continue;
    map = i;
    p = q;
    reach = shadow_reach[i];
    place = shadow_place[i];
    texel = t;
  }
  // Half a texel inside its own map, whatever is beside it.
  float edge = 0.5 * texel / reach.x;
  float bias = texel / reach.y;
  float turn = 2.0 * k_pi * random(pixel());
  // Where a texel is as wide as a penumbra there is none to look for.
  int searches = map < 2 ? 8 : 0, taps = map < 2 ? 12 : 5;
  float widest = k_sun_spread * p.z * reach.y / reach.x;
  if (shadow_count > 1) widest = min(widest, 0.02);  // a map may be narrower than its box is deep
  float blockers = 0.0, depth = 0.0;
  for (int k = 0; k < searches; ++k) {
    vec2 at = clamp(p.xy + widest * disc_point(k, 8, turn), edge, 1.0 - edge);
    float d = textureLod(shadow_depth, at * place.xy + place.zw, 0.0).r;
    if (d < p.z - bias) { blockers += 1.0; depth += d; }
  }
  float gap = blockers > 0.0 ? p.z - depth / blockers : 0.0;
  float wide = k_sun_spread * gap * reach.y / reach.x;
  wide = clamp(wide, 1.3 * texel / reach.x, widest + 2.0 * texel / reach.x);
  float lit = 0.0;
  for (int k = 0; k < taps; ++k) {
    vec2 at = clamp(p.xy + wide * disc_point(k, taps, turn + 1.0), edge, 1.0 - edge);
    lit += textureLod(shadow_map, vec3(at * place.xy + place.zw, p.z - bias), 0.0);
  }
  lit /= float(taps);
  if (map == shadow_count) return shadow_ends ? far : 1.0;
  if (!shadow_ends || map + 1 < shadow_count) return lit;
  vec2 out_by = abs(p.xy * 2.0 - 1.0);
  return mix(lit, far, smoothstep(0.75, 1.0, max(out_by.x, out_by.y)));
}

// What the sky sends to a surface here: (x, y, z, w) of SkyLight, faded to the open sky at the grid's border.
vec4 sky_at(vec3 local) {
  vec3 at = (local - sky_corner) / sky_extent;
  vec3 border = abs(at * 2.0 - 1.0);
  vec3 out_by = clamp((border - sky_opens) / max(1.0 - sky_opens, vec3(1e-4)), 0.0, 1.0);
  float open = max(out_by.x, max(out_by.y, out_by.z));
  open *= open * (3.0 - 2.0 * open);
  return mix(texture(sky_grid, at), vec4(0.0, 0.5, 0.0, 0.5), open);
}
float skylight(vec4 sky_here, vec3 normal) { return max(0.0, sky_here.w + dot(sky_here.xyz, normal)); }

// What mean shadows leave of the sun where the sky is seen so much: of crowns from outside most, whatever the cell
// of the grid holds.
float sun_by_sky(vec4 sky_here) { return 0.4 + 0.5 * clamp(2.0 * sky_here.w, 0.0, 1.0); }

// haze_distance: metres at which haze has two thirds of what is seen; 0: there is none.
vec3 hazed(vec3 c, vec3 relative, float haze_distance) {
  if (haze_distance <= 0.0) return c;
  float haze = 1.0 - exp(-pow(length(relative) / haze_distance, 1.5));
  return mix(c, sky(normalize(vec3(relative.x, 0.0, relative.z))), haze);
}

// What a surface at `local` sends towards `view`, without gloss. thin: 1 for leaves, light shines through. `sun`
// is the share of it that arrives.
vec3 light_on(vec3 albedo, vec3 local, vec3 view, vec3 n, float thin, out float sun) {
  float facing = dot(n, sun_direction);
  vec4 here = sky_at(local);
  sun = sunlight(local, facing < 0.0 ? -n : n, sun_by_sky(here));
  float front = max(facing, 0.0), back = max(-facing, 0.0);
  float from_sky = mix(skylight(here, n), 0.55 * skylight(here, n) + 0.45 * skylight(here, -n) + 0.06, thin);
  float from_ground = (0.5 - 0.5 * mix(n.y, 0.0, 0.5 * thin)) * min(1.0, 2.2 * here.w);
  vec3 ground = k_ground_colour * (k_sun_colour * sun_direction.y * 0.55 + k_sky_colour);
  vec3 c = albedo * (k_sun_colour * sun * front * mix(1.0, 0.85, thin) + k_sky_colour * from_sky + ground * from_ground);
  // A leaf is a filter: what comes through is yellower, and strongest against the sun.
  vec3 filtered = albedo * vec3(1.05, 1.12, 0.5);
  float against = 1.0 + 1.2 * pow(max(dot(-view, sun_direction), 0.0), 4.0);
  return c + thin * filtered * k_sun_colour * sun * back * 0.65 * against;
}
)";

const std::string_view k_fade = R"(
#ifdef GL_ARB_sample_shading
const bool k_has_sample_mask = true;
void keep_samples(int kept) { gl_SampleMask[0] = kept; }
#else
const bool k_has_sample_mask = false;
void keep_samples(int kept) {}
#endif

// The samples of a pixel that a copy does not leave to the level that it fades from or into; 0: none. `pixels`:
// DrawCopy's byte. An ordered dither by interleaved gradient noise (Jimenez 2014); four samples of a pixel have
// its four quarters, so that shares are met within an eighth.
int kept_samples(float pixels, bool multisampled) {
  if (pixels > 254.5) return -1;
  vec2 p = gl_FragCoord.xy + tile_corner;
  float noise = fract(52.9829189 * fract(dot(p, vec2(0.06711056, 0.00583715))));
  if (!multisampled || !k_has_sample_mask) {
    float at = 127.0 * noise;
    return (pixels < 127.5 ? at < pixels : at >= pixels - 127.0) ? -1 : 0;
  }
  int kept = 0;
  for (int s = 0; s < 4; ++s) {
    float at = 127.0 * (0.25 * (noise + float(s)));
    if (pixels < 127.5 ? at < pixels : at >= pixels - 127.0) kept |= 1 << s;
  }
  return kept;
}
)";

const std::string_view k_ground_vertex = R"(
uniform mat4 clip;
uniform vec3 offset, ground_centre;  // local
uniform float ground_reach;
out vec3 v_local;
void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
  v_local = ground_centre + vec3(corner.x, 0.0, corner.y) * ground_reach;
  gl_Position = clip * vec4(v_local + offset, 1.0);
}
)";

const std::string_view k_ground_fragment = R"(
uniform vec3 offset, ground_centre;
uniform float ground_scale;  // the size of what stands on it
uniform bool studio;
in vec3 v_local;
out vec4 colour;

void main() {
  vec3 relative = v_local + offset;
  vec3 towards = normalize(relative);
  vec2 at = (v_local - ground_centre).xz / ground_scale;
  float away = length(at);
  // Patches, tufts and grain; each fades out before it gets finer than a fragment.
  float fine = sqrt(length(dFdx(at)) * length(dFdy(at)));
  float patches = value_noise(at * 1.7 + 5.0) + 0.5 * value_noise(at * 4.1 + 9.0) - 0.75;
  float grain = 0.0, weight = 0.5;
  for (float f = 23.0; f < 2500.0; f *= 2.7) {
    grain += weight * (value_noise(at * f + f) - 0.5) * (1.0 - smoothstep(0.25, 1.1, fine * f));
    weight *= 0.85;
  }
  vec3 albedo = k_ground_colour * (1.0 + 0.16 * patches + 0.95 * grain);
  albedo = mix(albedo, albedo * vec3(1.34, 1.06, 0.80), 0.8 * smoothstep(-0.6, 1.0, patches + 0.8 * grain));
  if (studio) albedo = vec3(0.62);
  const vec3 k_up = vec3(0.0, 1.0, 0.0);
  float sun = sunlight(v_local, k_up, 1.0) * max(sun_direction.y, 0.0);
  vec4 here = sky_at(vec3(v_local.x, v_local.y + 0.02 * ground_scale, v_local.z));
  vec3 lit = albedo * (k_sun_colour * sun + k_sky_colour * skylight(here, k_up));
  if (studio) {
    // Only the shadow is kept, on the studio's white.
    float full = dot(albedo * (k_sun_colour * sun_direction.y + k_sky_colour), vec3(1.0));
    float kept = dot(lit, vec3(1.0)) / full;
    float fade = smoothstep(0.6, 2.2, away);
    colour = vec4(vec3(0.0), (1.0 - kept) * 0.5 * (1.0 - fade));
    return;
  }
  float haze = 1.0 - exp(-pow(away / 13.0, 1.5));
  colour = vec4(tone(mix(lit, sky(vec3(towards.x, 0.0, towards.z)), haze)), 1.0);
}
)";

const std::string_view k_screen_vertex = R"(
out vec2 v_at;  // -1 to 1
void main() {
  v_at = vec2((gl_VertexID & 1) * 4 - 1, (gl_VertexID >> 1) * 4 - 1);
  gl_Position = vec4(v_at, 1.0, 1.0);
}
)";

const std::string_view k_backdrop_fragment = R"(
uniform vec3 ray_centre, ray_across, ray_up;  // of this tile
uniform int backdrop;                         // 0 sky, 1 studio, 2 plain
uniform vec3 plain;
in vec2 v_at;
out vec4 colour;
void main() {
  vec3 d = normalize(ray_centre + v_at.x * ray_across + v_at.y * ray_up);
  vec3 c = plain;
  if (backdrop == 0) c = tone(sky(d));
  if (backdrop == 1) c = mix(vec3(0.93, 0.935, 0.94), vec3(0.72, 0.75, 0.79), smoothstep(-0.1, 0.9, d.y));
  // Half a step of noise hides the steps of eight bits.
  if (backdrop != 2) c += (random(pixel()) - 0.5) / 255.0 * (0.4 + c);
  colour = vec4(c, 1.0);
}
)";

const std::string_view k_resolve_fragment = R"(
uniform sampler2DMS samples;
uniform int sample_count, sub_pixels;  // sub_pixels: a side
uniform ivec2 tile_origin;             // where the tile starts in the target
out vec4 colour;
vec3 encode(vec3 c) {
  return mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, vec3(greaterThan(c, vec3(0.0031308))));
}
void main() {
  ivec2 first = (ivec2(gl_FragCoord.xy) - tile_origin) * sub_pixels;
  vec3 sum = vec3(0.0);
  for (int y = 0; y < sub_pixels; ++y)
    for (int x = 0; x < sub_pixels; ++x)
      for (int s = 0; s < sample_count; ++s) sum += texelFetch(samples, first + ivec2(x, y), s).rgb;
  colour = vec4(encode(clamp(sum / float(sample_count * sub_pixels * sub_pixels), 0.0, 1.0)), 1.0);
}
)";

}  // namespace copse::treeplay::shaders
