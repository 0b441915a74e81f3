// A forest from above, for people: the terrain as a shaded relief, every tree as a disc of its crown.
#pragma once

#include "lib/formats/ecosystem/ecosystem.h"
#include "lib/formats/import/image.h"

namespace copse::ecogen {

// Of a type's trees on the map: red, green and blue, 0 to 1, as on a screen.
Double3 type_colour(std::size_t type);

// The longer side has 1024 pixels. +X is to the right, +Z down, as on the maps.
Image map_picture(const Ecosystem& eco);

}  // namespace copse::ecogen
