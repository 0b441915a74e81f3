// texture_statistics: the mean colour and the opaque share of a texture, where a mesh really uses it.
//
// A leaf seen from afar is a point of its mean colour and of its visible area (digest 000, section 4.6;
// design: "the mean leaf area counts the texture's coverage, not the card"). A texture holds more than a
// leaf: margins, other leaves of an atlas. So only what lies under the triangles counts, each as much as its
// area.
#pragma once

#include "lib/formats/material.h"
#include "lib/formats/mesh.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace copse {

// A view of an image: rows from the top, 8 bits a channel, RGBA, colours as sRGB.
struct TextureImage {
  int width = 0, height = 0;
  std::span<const std::uint8_t> rgba;  // 4 * width * height
};

// The image of a texture (index into Mesh::textures), nothing when it cannot be had. What is returned stays
// valid until the next call. Asked once for every texture that some material uses, in ascending order.
using ImageSource = std::function<std::optional<TextureImage>(std::uint32_t)>;

struct TextureStatistics {
  Float3 mean_colour{1, 1,
                     1};     // linear RGB, weighted by alpha, of the texels that the alpha test lets through
  float alpha_coverage = 1;  // share that the alpha test lets through; mean alpha where there is no test
  bool sampled = false;      // false: no texture, or no image: the values are those of a white opaque one
  std::uint64_t triangles = 0;   // that use the material
  std::uint64_t footprints = 0;  // different texture triangles among them, repeats of the texture aside
  std::uint64_t whole = 0;  // triangles without usable coordinates, or larger than k_footprint_tiles: they
                            // count as the whole texture
};

// A footprint that spans more repeats than this along u or v is taken as the whole texture: its rim is a
// small part of it.
inline constexpr double k_footprint_tiles = 16;

// Enough that a mean over a material is good to about 1e-3, whatever the size of the image.
inline constexpr double k_scanlines = 1 << 19;

// One a material. Textures repeat in both directions. The alpha test compares texture alpha * Material::alpha
// with Material::alpha_cutoff. Exact along each scanline; a footprint has at least 8 of them and at most one
// a row of texels, and all footprints of a material together k_scanlines: beyond that the rows between are
// left out, evenly, and of very many footprints (more than k_scanlines / 8) a sample by area stands for all.
// Linear in triangles and texels.
std::vector<TextureStatistics> texture_statistics(const Mesh& mesh, const ImageSource& images);

// Puts the statistics into the materials, where they were sampled.
void apply(std::span<const TextureStatistics> statistics, std::vector<Material>& materials);

}  // namespace copse
