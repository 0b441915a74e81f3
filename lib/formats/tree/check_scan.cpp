#include "lib/formats/tree/check_parts.h"
#include "lib/formats/tree/scan.h"

#include <cmath>

#include <fmt/format.h>

namespace copse {
namespace {

bool finite_one(const Float3& v) {
  return is_finite(v);
}
bool finite_one(const Float2& v) {
  return std::isfinite(v.x) && std::isfinite(v.y);
}
bool finite_one(float v) {
  return std::isfinite(v);
}
bool finite_one(double v) {
  return std::isfinite(v);
}

bool all_finite_of(const Array<Float3>& v) {
  return all_finite(as_floats(v.span()));
}
bool all_finite_of(const Array<Float2>& v) {
  return all_finite(as_floats(v.span()));
}
template <class T>
bool all_finite_of(const Array<T>& v) {
  return all_finite(v.span());
}

}  // namespace

template <class T>
bool Check::finite(std::string_view section, const Array<T>& values) const {
  if (all_finite_of(values)) return true;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!finite_one(values[i])) add(section, i, "not finite");
  }
  return false;
}
template bool Check::finite(std::string_view, const Array<Float3>&) const;
template bool Check::finite(std::string_view, const Array<Float2>&) const;
template bool Check::finite(std::string_view, const Array<float>&) const;
template bool Check::finite(std::string_view, const Array<double>&) const;

bool Check::below(std::string_view section, const Array<std::uint32_t>& values, std::uint32_t limit,
                  std::string_view of, bool or_none) const {
  if (or_none ? all_below_or_none(values, limit) : all_below(values, limit)) return true;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i] < limit || (or_none && values[i] == k_none)) continue;
    add(section, i, "index out of range", [&] { return fmt::format("{} of {} {}", values[i], limit, of); });
  }
  return false;
}

bool Check::corners(std::string_view section, const Array<CornerTriangle>& triangles, std::uint32_t vertices,
                    std::uint32_t normals, std::uint32_t texcoords) const {
  if (corners_below(triangles, vertices, normals, texcoords)) return true;
  const auto test = [&](std::size_t i, std::uint32_t index, std::uint32_t limit, bool or_none,
                        const char* kind) {
    if (index < limit || (or_none && index == k_none)) return;
    add(section, i, kind, [&] { return fmt::format("{} of {}", index, limit); });
  };
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      test(i, triangles[i].vertex[c], vertices, false, "vertex index out of range");
      test(i, triangles[i].normal[c], normals, true, "normal index out of range");
      test(i, triangles[i].texcoord[c], texcoords, true, "texture coordinate index out of range");
    }
  }
  return false;
}

bool Check::offsets(std::string_view section, const Array<std::uint32_t>& values,
                    std::uint32_t elements) const {
  if (values.empty()) return true;
  bool sound = true;
  if (values[0] != 0) {
    add(section, 0, "the first offset is not 0", [&] { return fmt::format("{}", values[0]); });
    sound = false;
  }
  if (values[values.size() - 1] != elements) {
    add(section, values.size() - 1, "the last offset is not the end",
        [&] { return fmt::format("{} of {}", values[values.size() - 1], elements); });
    sound = false;
  }
  return sorted(section, values) && sound;
}

template <class T>
bool Check::sorted(std::string_view section, const Array<T>& values) const {
  if (non_decreasing(values)) return true;
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (values[i] < values[i - 1]) {
      add(section, i, "out of order", [&] { return fmt::format("{} after {}", values[i], values[i - 1]); });
    }
  }
  return false;
}
template bool Check::sorted(std::string_view, const Array<std::uint32_t>&) const;
template bool Check::sorted(std::string_view, const Array<float>&) const;
template bool Check::sorted(std::string_view, const Array<double>&) const;

bool Check::inside(std::string_view section, std::span<const Float3> points, const FloatBox& box,
                   std::string_view which) const {
  FloatBox all = box_of(points);
  all.grow(box);
  if (all == box) return true;
  for (std::size_t i = 0; i < points.size(); ++i) {
    FloatBox grown = box;
    grown.grow(points[i]);
    if (grown == box) continue;
    add(section, i, "a vertex is outside a box", [&] {
      return fmt::format("({} {} {}) and the box of {}", points[i].x, points[i].y, points[i].z, which);
    });
  }
  return false;
}

}  // namespace copse
