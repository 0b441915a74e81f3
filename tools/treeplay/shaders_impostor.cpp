#include "tools/treeplay/shaders.h"

namespace copse::treeplay::shaders {

// The quad through the middle of the sphere that hides it, as seen from the eye.
const std::string_view k_impostor_vertex = R"(
uniform mat4 clip;
uniform vec3 offset, centre;
uniform float radius;
out vec3 v_local;
void main() {
  vec3 eye = -(centre + offset);
  float away = max(length(eye), 1e-30);
  vec3 towards = eye / away;
  vec3 right = normalize(cross(abs(towards.y) < 0.999 ? vec3(0, 1, 0) : vec3(0, 0, 1), towards));
  vec3 up = cross(towards, right);
  float reach = away > 1.01 * radius ? radius * away / sqrt(away * away - radius * radius) : 8.0 * radius;
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
  v_local = centre + (right * corner.x + up * corner.y) * reach;
  gl_Position = clip * vec4(v_local + offset, 1.0);
}
)";

const std::string_view k_impostor_fragment = R"(
uniform sampler2DArray albedo_layers, normal_layers;
uniform vec3 offset, centre;
uniform float radius;
uniform float layer[3], weight[3];
uniform vec3 view_right[3], view_up[3], view_toward[3];
uniform bool lit, multisampled;
in vec3 v_local;
out vec4 colour;

const float k_thin = 0.7;  // between bark and leaves: the pictures do not say which is which

// Where a point of a view's plane lies in its picture, whose rows start at the top.
vec2 place(int k, vec3 p) {
  return vec2(dot(p, view_right[k]), -dot(p, view_up[k])) / radius * 0.5 + 0.5;
}

void main() {
  vec3 along = normalize(v_local + offset), from = v_local - centre;
  vec4 sum = vec4(0.0);
  vec3 normal = vec3(0.0);
  float height = 0.0;  // along the ray, of what is met
  for (int k = 0; k < 3; ++k) {
    float slope = dot(along, view_toward[k]);
    vec2 flat_place = place(k, from);
    vec2 dx = dFdx(flat_place), dy = dFdy(flat_place);
    if (weight[k] <= 0.0 || abs(slope) < 1e-3) continue;
    vec2 at = flat_place;
    float t = 0.0, depth = 0.0;
    for (int i = 0; i < 4; ++i) {
      t = (depth - dot(from, view_toward[k])) / slope;
      at = place(k, from + along * t);
      depth = (2.0 * textureGrad(normal_layers, vec3(at, layer[k]), dx, dy).a - 1.0) * radius;
    }
    if (any(lessThan(at, vec2(0.0))) || any(greaterThan(at, vec2(1.0)))) continue;
    vec4 c = textureGrad(albedo_layers, vec3(at, layer[k]), dx, dy);
    vec3 n = textureGrad(normal_layers, vec3(at, layer[k]), dx, dy).rgb * 2.0 - 1.0;
    float w = weight[k] * c.a;
    sum += vec4(c.rgb * w, w);
    normal += w * (view_right[k] * n.x + view_up[k] * n.y + view_toward[k] * n.z);
    height += w * t;
  }
  if (multisampled ? sum.a <= 0.0 : sum.a < 0.5) discard;
  vec3 albedo = sum.rgb / sum.a;
  vec3 met = v_local + along * (height / sum.a);
  float sun;
  vec3 c = lit ? tone(light_on(albedo, met, -along, normalize(normal + vec3(1e-6)), k_thin, sun)) : albedo;
  colour = vec4(c, sum.a);
}
)";

}  // namespace copse::treeplay::shaders
