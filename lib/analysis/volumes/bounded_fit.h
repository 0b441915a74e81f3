// What a fitter of bounding volumes gives: the volume, and how small any volume of its type must be.
#pragma once

namespace copse {

template <class V>
struct BoundedFit {
  V volume;
  double lower_bound =
      0;  // of the interior volume of every V that encloses the points, proven; 0: none is known
};

// The gap that is to be proven on a hull's vertices when the volume round all points is `grown` times as
// large as that round the vertices (a kernel's), so that `gap` holds for all points. Where it cannot, a tenth
// of it.
inline double reachable_gap(double gap, double grown) {
  const double left = (1 + gap) / grown - 1;
  return left > 0.1 * gap ? left : 0.1 * gap;
}

}  // namespace copse
