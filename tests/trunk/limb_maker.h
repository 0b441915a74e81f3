// Limbs made by hand, for the tests of what is done with them.
#pragma once

#include "lib/analysis/rings/limbs.h"

#include <vector>

namespace copse {

// Appends a limb of rings with these diameters, `step` apart.
inline void add_limb(Limbs& limbs, const Double3& from, const Double3& step,
                     const std::vector<double>& diameters) {
  for (std::size_t i = 0; i < diameters.size(); ++i) {
    limbs.append({from + step * static_cast<double>(i), diameters[i], {}},
                 i == 0 ? k_none : limbs.rings() - 1, RadiusSource::ring, {});
  }
  ++limbs.size;
}

}  // namespace copse
