// Materials and textures, shared by meshes, trees and ecosystems.
#pragma once

#include "lib/formats/vec.h"

#include <cstdint>
#include <string>
#include <vector>

namespace copse {

inline constexpr std::uint32_t k_none = 0xffffffffu;  // "no such element", wherever an index is optional

// An image by reference (uri, relative to the file that names it) or embedded (bytes as in the image file).
struct Texture {
  std::string uri;                  // empty when embedded
  std::string mime;                 // "image/png", "image/jpeg", ...; empty when unknown
  std::vector<std::uint8_t> bytes;  // empty when by reference
  friend bool operator==(const Texture&, const Texture&) = default;
};

// Blinn-Phong, as digest 000 section 2.1 lists it; colours are linear RGB in [0, 1] (emission may exceed 1).
struct Material {
  std::string name;
  Float3 ambient{0.2f, 0.2f, 0.2f};
  Float3 diffuse{0.8f, 0.8f, 0.8f};
  Float3 specular{0, 0, 0};
  Float3 emission{0, 0, 0};
  float shininess = 0;     // Blinn-Phong exponent, >= 0
  float alpha = 1;         // opacity, 0 to 1
  float alpha_cutoff = 0;  // > 0: texels whose alpha is below it are not drawn (alpha test)
  bool double_sided = false;
  std::uint32_t texture = k_none;  // index into the textures that travel with the materials
  // Statistics of the texture under this material; those of a white opaque texture where there is none.
  Float3 mean_colour{1, 1, 1};  // linear RGB, weighted by alpha
  float alpha_coverage = 1;     // share of the surface that the alpha test lets through
  friend bool operator==(const Material&, const Material&) = default;
};

}  // namespace copse
