#include "tools/treeplay/impostor_copy.h"

#include <algorithm>

namespace copse::treeplay {

ImpostorCopy impostor_copy(const DrawCopy& copy, const ImpostorAtlas& atlas, const Double3& viewer,
                           bool infinitely_far) {
  const auto& [x, y, z] = copy.rows;
  const auto row = [](const Float4& r) { return Double3{double{r.x}, double{r.y}, double{r.z}}; };
  const Double3 turned = row(x) * viewer.x + row(y) * viewer.y + row(z) * viewer.z;
  const double square = dot(row(x), row(x));  // of the scale
  const Double3 from = infinitely_far ? turned : turned / square - to_double(atlas.centre);
  // A scale that float32 cannot square leaves no direction: any will do.
  const ImpostorBlend blend =
      impostor_blend(atlas.layout, atlas.views, is_finite(from) ? from : Double3{0, 0, 1});
  ImpostorCopy out{.copy = copy};
  const auto heaviest = static_cast<std::size_t>(std::max_element(blend.weight.begin(), blend.weight.end()) -
                                                 blend.weight.begin());
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t from_there = (heaviest + k) % 3;
    out.view[k] = static_cast<float>(blend.view[from_there]);
    out.weight[k] = static_cast<float>(blend.weight[from_there]);
  }
  return out;
}

PictureCopy picture_of(const ImpostorCopy& copy) {
  const auto share = [&](std::size_t c) { return static_cast<float>(copy.copy.tint[c]) / 255.0f; };
  const float pixels = static_cast<float>(copy.copy.tint[3]) / 256.0f;
  return {copy.copy.rows, copy.view[0] + pixels, {share(0), share(1), share(2)}};
}

}  // namespace copse::treeplay
