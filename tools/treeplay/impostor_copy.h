// An instance of a tree that is drawn as pictures of it: which of them, and how much of each.
#pragma once

#include "lib/formats/levels/impostors.h"
#include "tools/treeplay/forest.h"

#include <array>
#include <vector>

namespace copse::treeplay {

struct ImpostorCopy {
  DrawCopy copy;
  std::array<float, 3> view{}, weight{};  // the heaviest first
};

// The same with the heaviest view alone.
struct PictureCopy {
  std::array<Float4, 3> rows{};
  float view = 0;               // its number, and which pixels are drawn in 256 parts (DrawCopy)
  std::array<float, 3> tint{};  // sRGB, 0 to 1
};
static_assert(sizeof(PictureCopy) == 64);
PictureCopy picture_of(const ImpostorCopy& copy);

// Of one tree.
struct ImpostorCopies {
  std::vector<ImpostorCopy> blended;
  std::vector<PictureCopy> single;
  std::size_t size() const { return blended.size() + single.size(); }
};

// `viewer`: from the copy's place to the eye, or towards an eye that is infinitely far away. The copy's
// matrix is a rotation times a scale.
ImpostorCopy impostor_copy(const DrawCopy& copy, const ImpostorAtlas& atlas, const Double3& viewer,
                           bool infinitely_far);

}  // namespace copse::treeplay
