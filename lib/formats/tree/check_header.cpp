#include "lib/formats/tree/check_parts.h"
#include "lib/formats/tree/scan.h"

#include <array>
#include <cmath>
#include <span>

#include <fmt/format.h>

namespace copse {
namespace {

std::string text(const FloatBox& b) {
  return fmt::format("({} {} {}) to ({} {} {})", b.min.x, b.min.y, b.min.z, b.max.x, b.max.y, b.max.z);
}

bool contains(const FloatBox& outer, const FloatBox& inner) {
  for (int i = 0; i < 3; ++i) {
    if (!(outer.min[i] <= inner.min[i] && inner.max[i] <= outer.max[i])) return false;
  }
  return true;
}

// Finite, or the one way to say "empty".
bool check_box(const Check& check, const char* which, const FloatBox& box) {
  if (box == FloatBox{}) return true;
  if (is_finite(box.min) && is_finite(box.max) && !box.empty()) return true;
  check.add("HEAD", Finding::k_no_element, "neither a finite box nor the empty one",
            [&] { return fmt::format("{}: {}", which, text(box)); });
  return false;
}

void check_number(const Check& check, const char* which, float value) {
  if (std::isfinite(value) && value >= 0) return;
  check.add("HEAD", Finding::k_no_element, "not a finite number of 0 or more",
            [&] { return fmt::format("{}: {}", which, value); });
}

void check_material(const Check& check, std::size_t index, const Material& m) {
  const std::array<float, 19> numbers{m.ambient.x,     m.ambient.y,     m.ambient.z,     m.diffuse.x,
                                      m.diffuse.y,     m.diffuse.z,     m.specular.x,    m.specular.y,
                                      m.specular.z,    m.emission.x,    m.emission.y,    m.emission.z,
                                      m.shininess,     m.alpha,         m.alpha_cutoff,  m.mean_colour.x,
                                      m.mean_colour.y, m.mean_colour.z, m.alpha_coverage};
  for (const float v : numbers) {
    if (!(std::isfinite(v) && v >= 0)) {
      check.add("MATL", index, "not a finite number of 0 or more", [&] { return fmt::format("{}", v); });
      break;
    }
  }
  if (m.alpha > 1) check.add("MATL", index, "opacity above 1", [&] { return fmt::format("{}", m.alpha); });
  if (m.alpha_coverage > 1) {
    check.add("MATL", index, "alpha coverage above 1", [&] { return fmt::format("{}", m.alpha_coverage); });
  }
  if (m.texture != k_none && m.texture >= check.counts().textures) {
    check.add("MATL", index, "texture index out of range",
              [&] { return fmt::format("{} of {}", m.texture, check.counts().textures); });
  }
}

void check_material_index(const Check& check, const char* whose, std::uint32_t material) {
  if (material == k_none || material < check.counts().materials) return;
  check.add("HEAD", Finding::k_no_element, "material index out of range",
            [&] { return fmt::format("{}: {} of {}", whose, material, check.counts().materials); });
}

}  // namespace

void check_header(const Check& check) {
  const TreeHeader& h = check.head.header;
  const auto add = [&](const char* kind, auto&&... detail) {
    check.add("HEAD", Finding::k_no_element, kind, detail...);
  };
  if (!is_finite(h.origin)) add("the origin is not finite");
  const bool whole = check_box(check, "whole", h.bounds), trunk = check_box(check, "trunk", h.trunk_bounds);
  if (whole && trunk && !h.trunk_bounds.empty() && !contains(h.bounds, h.trunk_bounds)) {
    add("the trunk's box is not inside the tree's", text(h.trunk_bounds));
  }
  if (!is_finite(h.area_density_centre)) add("the area-density centre is not finite");
  check_number(check, "mean trunk triangle area", h.mean_trunk_area);
  check_number(check, "mean leaf area", h.mean_leaf_area);
  if (h.unexplained > check.counts().trunk_triangles) {
    add("more unexplained triangles than triangles",
        [&] { return fmt::format("{} of {}", h.unexplained, check.counts().trunk_triangles); });
  }
  check_material_index(check, "trunk", check.head.trunk_material);
  check_material_index(check, "leaves", check.head.leaf_material);
  for (std::size_t i = 0; i < check.tree.materials.size(); ++i) {
    check_material(check, i, check.tree.materials[i]);
  }
}

}  // namespace copse
