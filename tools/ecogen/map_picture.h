// A forest from above, for people: the terrain as a shaded relief, every tree as a disc of its crown.
#pragma once

#include "lib/formats/ecosystem/ecosystem.h"
#include "lib/formats/import/image.h"

namespace copse::ecogen {

// Of a type's trees on the map: red, green and blue, 0 to 1, as on a screen.
Double3 type_colour(std::size_t type);

// The longer side has 1024 pixels. +X is to the right, +Z down, as on the maps.
Image map_picture(const Ecosystem& eco);

// The map of an ecosystem, drawn when it is asked for first.
class ForestMap {
 public:
  explicit ForestMap(const Ecosystem& eco) : eco_(eco) {}
  const Ecosystem& ecosystem() const { return eco_; }
  const Image& image() {
    if (image_.rgba.empty()) image_ = map_picture(eco_);
    return image_;
  }

 private:
  const Ecosystem& eco_;
  Image image_;
};

}  // namespace copse::ecogen
