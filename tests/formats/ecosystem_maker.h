// A small sound ecosystem: a terrain of 3 x 3, two materials with a texture, two types, 60 instances,
// depth 1.
#pragma once

#include "lib/formats/ecosystem/ecosystem.h"

namespace copse {

Ecosystem little_ecosystem(bool exact);

}  // namespace copse
