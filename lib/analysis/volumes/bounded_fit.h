// What a fitter of bounding volumes gives: the volume, and how small any volume of its type must be.
#pragma once

namespace copse {

template <class V>
struct BoundedFit {
  V volume;
  double lower_bound =
      0;  // of the interior volume of every V that encloses the points, proven; 0: none is known
};

}  // namespace copse
