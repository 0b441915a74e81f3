// The polyhedron of a k-DOP: each plane's facet is a square cut by all other planes.
#include "lib/analysis/hull/frame.h"
#include "lib/analysis/volumes/volume_measures.h"

#include <algorithm>
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

struct Reach {
  Double3 middle;     // where the middles of the slabs meet in the mean (least squares)
  double radius = 0;  // no point of the body is farther from there; 0: it is that point; infinite: unbounded
};

Reach reach_of(const Kdop<double>& v) {
  Axes m{};
  Double3 right;
  for (std::size_t i = 0; i < v.normals.size(); ++i) {
    const double l = length(v.normals[i]);
    const Double3 n = v.normals[i] / l;
    for (int j = 0; j < 3; ++j) m[j] += n * n[j];
    right += n * ((v.min[i] + v.max[i]) / 2 / l);
  }
  const double det = dot(m[0], cross(m[1], m[2]));
  if (!(std::abs(det) > 1e-12)) return {{}, std::numeric_limits<double>::infinity()};
  Reach r;
  r.middle = (cross(m[1], m[2]) * right.x + cross(m[2], m[0]) * right.y + cross(m[0], m[1]) * right.z) / det;
  // m p is the sum of the normals times the distances along them; its least eigenvalue is at least this.
  const double half_trace = (m[0].x + m[1].y + m[2].z) / 2, stretch = det / (half_trace * half_trace);
  for (const HalfSpace& p : half_spaces(v, r.middle)) r.radius += std::abs(p.offset) / stretch;
  return r;
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

// Cutting a square loses digits: each corner again, from the three planes that meet in it.
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

// The facet of one plane: a square wider than the body, cut by all other planes.
void facet_of(const std::vector<HalfSpace>& planes, std::size_t i, double radius, std::vector<Corner>& facet,
              std::vector<Corner>& spare) {
  const double far = 2 * radius;  // more than the whiskers of mean_width_of
  const Double3 n = planes[i].normal, u = any_normal(n), w = cross(n, u), at = n * planes[i].offset;
  const std::size_t none = planes.size();
  facet = {{at + (u + w) * far, none},
           {at + (w - u) * far, none},
           {at - (u + w) * far, none},
           {at + (u - w) * far, none}};
  for (std::size_t j = 0; j < planes.size() && !facet.empty(); ++j) {
    if (j / 2 != i / 2) cut(facet, planes[j], j, spare);  // the slab's other side is parallel
  }
  sharpen(facet, planes[i], planes);
}

// The sum of each edge's length times the angle of its facets, / 4 pi. A plane that only touches an edge or a
// corner would get edges of its own from rounding, so each plane is first moved outward by its own whisker:
// then no four meet in a point.
double mean_width_of(std::vector<HalfSpace> planes, double radius, double size) {
  constexpr double k_whisker = 1e-11, k_golden = 0.6180339887498949;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    const double turns = k_golden * static_cast<double>(i + 1);
    planes[i].offset += k_whisker * size * (1 + turns - std::floor(turns));
  }
  std::vector<Corner> facet, spare;
  double width = 0;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    facet_of(planes, i, radius, facet, spare);
    for (std::size_t k = 0; k < facet.size(); ++k) {
      if (facet[k].plane >= planes.size()) return std::numeric_limits<double>::infinity();
      const Double3 &n = planes[i].normal, &other = planes[facet[k].plane].normal;
      const double angle = std::atan2(length(cross(n, other)), dot(n, other));
      // Each edge is met from both of its facets.
      width += distance(facet[k].at, facet[(k + 1) % facet.size()].at) * angle / (8 * std::numbers::pi);
    }
  }
  return width;
}

// Of the box along the axes of the world, as far as there are slabs along them.
double box_volume(const Kdop<double>& v) {
  double volume = 1;
  for (int axis = 0; axis < 3; ++axis) {
    double thick = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < v.normals.size(); ++i) {
      const double l = length(v.normals[i]);
      if (std::abs(v.normals[i][axis]) == l) thick = std::min(thick, (v.max[i] - v.min[i]) / l);
    }
    if (thick <= 0) return 0;
    volume *= thick;
  }
  return volume;
}

}  // namespace

VolumeMeasures measures_of(const Kdop<double>& v) {
  constexpr double k_infinite = std::numeric_limits<double>::infinity();
  const Reach reach = reach_of(v);
  if (reach.radius == 0) return {};
  if (!std::isfinite(reach.radius)) return {k_infinite, k_infinite, k_infinite};
  const std::vector<HalfSpace> planes = half_spaces(v, reach.middle);
  VolumeMeasures m;
  double size = 0;  // as far out as a corner lies
  std::vector<Corner> facet, spare;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    facet_of(planes, i, reach.radius, facet, spare);
    for (const Corner& c : facet) size = std::max(size, length(c.at));
    Double3 twice;
    for (std::size_t k = 0; k < facet.size(); ++k)
      twice += cross(facet[k].at - facet[0].at, facet[(k + 1) % facet.size()].at - facet[0].at);
    const double area = std::max(0.0, dot(twice, planes[i].normal) / 2);
    m.surface += area;
    m.volume += area * planes[i].offset / 3;
  }
  m.volume = std::clamp(m.volume, 0.0, box_volume(v));
  m.mean_width = mean_width_of(planes, reach.radius, size > 0 ? size : reach.radius);
  return m;
}

}  // namespace copse
