// What the tests of each type of volume cost on this machine.
#pragma once

#include "lib/analysis/volumes/choose.h"

namespace copse::bvfit {

// The time of the runtime's frustum test (six planes), relative to a sphere's, each the best of some runs
// over a thousand volumes. Depends on the machine and, by a few per cent, on the moment. Some 20 ms.
TestCosts measured_costs();

}  // namespace copse::bvfit
