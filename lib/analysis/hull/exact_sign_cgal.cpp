#include "lib/analysis/hull/exact_sign.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

namespace copse {
namespace {

using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;

Point point(const Double3& p) {
  return {p.x, p.y, p.z};
}

}  // namespace

int exact_side(const Double3& a, const Double3& b, const Double3& c, const Double3& p) {
  return CGAL::orientation(point(a), point(b), point(c), point(p));
}

bool exactly_collinear(const Double3& a, const Double3& b, const Double3& c) {
  return CGAL::collinear(point(a), point(b), point(c));
}

}  // namespace copse
