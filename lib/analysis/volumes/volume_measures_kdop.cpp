// The polyhedron of a k-DOP: each plane's facet is a large square cut by all other planes.
#include "lib/analysis/volumes/frame.h"
#include "lib/analysis/volumes/volume_measures.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace copse {
namespace {

struct HalfSpace {  // normal . p <= offset, |normal| = 1
  Double3 normal;
  double offset = 0;
};

struct Corner {
  Double3 at;
  std::size_t plane = 0;  // that cut the edge which starts here
};

std::vector<HalfSpace> half_spaces(const Kdop<double>& v, const Double3& centre) {
  std::vector<HalfSpace> planes;
  for (std::size_t i = 0; i < v.normals.size(); ++i) {
    const double l = length(v.normals[i]), shift = dot(v.normals[i], centre);
    planes.push_back({v.normals[i] / l, (v.max[i] - shift) / l});
    planes.push_back({-v.normals[i] / l, -(v.min[i] - shift) / l});
  }
  return planes;
}

// A point near the body: where the middles of the slabs meet in the mean (least squares).
Double3 middle_of(const Kdop<double>& v) {
  Axes m{};
  Double3 right;
  for (std::size_t i = 0; i < v.normals.size(); ++i) {
    const double l = length(v.normals[i]);
    const Double3 n = v.normals[i] / l;
    for (int j = 0; j < 3; ++j) m[j] += n * n[j];
    right += n * ((v.min[i] + v.max[i]) / 2 / l);
  }
  const double det = dot(m[0], cross(m[1], m[2]));
  if (!(std::abs(det) > 1e-12)) return {};
  return (cross(m[1], m[2]) * right.x + cross(m[2], m[0]) * right.y + cross(m[0], m[1]) * right.z) / det;
}

void cut(std::vector<Corner>& facet, const HalfSpace& plane, std::size_t index, std::vector<Corner>& out) {
  out.clear();
  for (std::size_t i = 0; i < facet.size(); ++i) {
    const Corner &a = facet[i], &b = facet[(i + 1) % facet.size()];
    const double da = dot(plane.normal, a.at) - plane.offset, db = dot(plane.normal, b.at) - plane.offset;
    if (da <= 0) out.push_back(a);
    if ((da < 0 && db > 0) || (da > 0 && db < 0)) {
      const Double3 at = a.at + (b.at - a.at) * (da / (da - db));
      out.push_back({at, da < 0 ? index : a.plane});
    } else if (da == 0 && db > 0) {
      out.back().plane = index;
    }
  }
  facet.swap(out);
}

// Cutting a large square loses digits: each corner again, from the three planes that meet in it.
void sharpen(std::vector<Corner>& facet, const HalfSpace& own, const std::vector<HalfSpace>& planes) {
  for (std::size_t k = 0; k < facet.size(); ++k) {
    const std::size_t next = facet[k].plane, last = facet[(k + facet.size() - 1) % facet.size()].plane;
    if (next >= planes.size() || last >= planes.size()) continue;
    const HalfSpace &a = planes[next], &b = planes[last];
    const Double3 bc = cross(b.normal, own.normal);
    const double det = dot(a.normal, bc);
    if (std::abs(det) < 1e-9) continue;
    facet[k].at =
        (bc * a.offset + cross(own.normal, a.normal) * b.offset + cross(a.normal, b.normal) * own.offset) /
        det;
  }
}

}  // namespace

VolumeMeasures measures_of(const Kdop<double>& v) {
  constexpr double k_infinite = std::numeric_limits<double>::infinity();
  const std::vector<HalfSpace> planes = half_spaces(v, middle_of(v));
  double reach = 0;
  for (const HalfSpace& p : planes) reach = std::max(reach, std::abs(p.offset));
  const double far = reach > 0 ? 1e6 * reach : 1;
  VolumeMeasures m;
  std::vector<Corner> facet, spare;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    const Double3 n = planes[i].normal, u = any_normal(n), w = cross(n, u), at = n * planes[i].offset;
    const std::size_t none = planes.size();
    facet = {{at + (u + w) * far, none},
             {at + (w - u) * far, none},
             {at - (u + w) * far, none},
             {at + (u - w) * far, none}};
    for (std::size_t j = 0; j < planes.size() && !facet.empty(); ++j) {
      if (j != i) cut(facet, planes[j], j, spare);
    }
    sharpen(facet, planes[i], planes);
    Double3 twice;
    for (std::size_t k = 0; k < facet.size(); ++k) {
      const Corner &a = facet[k], &b = facet[(k + 1) % facet.size()];
      if (a.plane == none) return {k_infinite, k_infinite, k_infinite};
      twice += cross(a.at - facet[0].at, b.at - facet[0].at);
      const Double3& other = planes[a.plane].normal;
      // Each edge is met from both of its facets, and the mean width is the sum of length times angle / 4 pi.
      const double angle = std::atan2(length(cross(n, other)), dot(n, other));
      m.mean_width += distance(a.at, b.at) * angle / (8 * std::numbers::pi);
    }
    const double area = dot(twice, n) / 2;
    m.surface += area;
    m.volume += area * planes[i].offset / 3;
  }
  return m;
}

}  // namespace copse
