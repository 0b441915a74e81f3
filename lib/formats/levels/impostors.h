// impostors: a tree as pictures of it, in its own file: sections IMPO (how the pictures were taken), IMPA
// (colour and alpha) and IMPN (normal and depth), the last two PNG files. docs/formats.md has the bytes.
//
// An atlas of square views, orthographic, each framing the same sphere. `octahedral`: one for every cell of
// the octahedral map of the sphere with +Y in its middle, n x n of them (Cigolle and others, "A survey of
// efficient representations for independent unit vectors", 2014). `billboard`: n views round +Y, all level,
// in one row.
#pragma once

#include "lib/formats/array.h"
#include "lib/formats/container/container.h"
#include "lib/formats/result.h"
#include "lib/formats/tree_file/tree_file.h"
#include "lib/formats/vec.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace copse {

inline constexpr std::uint32_t k_max_impostor_views = 64;   // along a side of the atlas
inline constexpr std::uint32_t k_max_impostor_side = 8192;  // of the atlas, pixels

enum class ImpostorLayout : std::uint32_t { billboard = 1, octahedral = 2 };

struct ImpostorAtlas {
  ImpostorLayout layout = ImpostorLayout::octahedral;
  std::uint32_t views = 0;  // along a side of the atlas; of a billboard their number
  std::uint32_t size = 0;   // pixels of a view's side
  Float3 centre;            // of the sphere that every view frames, relative to the tree's origin
  float radius = 0;
  float distance = 0;          // metres from the camera at which the pictures take over from the last level
  Array<std::uint8_t> albedo;  // a PNG, RGBA: sRGB and the share that is covered
  Array<std::uint8_t> normal;  // a PNG, RGBA: 127.5 (n + 1) in the view's frame right, up, toward; and the
                               // depth toward the viewer, 0 at -radius, 255 at radius

  std::uint32_t columns() const { return views; }
  std::uint32_t rows() const { return layout == ImpostorLayout::octahedral ? views : 1; }
  bool empty() const { return views == 0; }
};

// The unit vector at (u, v) in [-1, 1]^2 of the octahedral map with +Y in its middle, and back.
Double3 octahedral_direction(double u, double v);
std::array<double, 2> octahedral_place(const Double3& direction);

// The directions of an atlas toward the viewer, row by row.
std::vector<Double3> impostor_views(ImpostorLayout layout, std::uint32_t views);

// How a view's picture lies: right and up, unit. Its up is +Y as far as it can be; looking along Y, it is +Z.
struct ImpostorFrame {
  Double3 right, up;
};
ImpostorFrame impostor_frame(const Double3& direction);

// The views nearest to a direction, with weights that add up to 1 and change continuously with it; at the
// direction of a view that view alone counts. Of a billboard the third weight is 0.
struct ImpostorBlend {
  std::array<std::uint32_t, 3> view{};
  std::array<double, 3> weight{};
};
ImpostorBlend impostor_blend(ImpostorLayout layout, std::uint32_t views, const Double3& direction);

// Adds or replaces the three sections; an empty atlas removes them.
Result<void> put_impostor(ContainerWriter& writer, const ImpostorAtlas& atlas);
// An empty atlas when the file has none. Checked: numbers and ranges, and that both pictures say that they
// have the atlas's size (decoding them is the caller's).
Result<ImpostorAtlas> read_impostor(const TreeFile& file);
// What is wrong with it; empty when it is sound.
std::string check_impostor(const ImpostorAtlas& atlas);

}  // namespace copse
