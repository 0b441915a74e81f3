#include "lib/formats/import/gltf/skin.h"

#include "lib/formats/import/gltf/accessor.h"

#include <cmath>

#include <fmt/format.h>

namespace copse {

Affine GltfSkin::blend(const double* joint, const double* weight) const {
  Affine sum{{Double3{}, Double3{}, Double3{}}, {}};
  double total = 0;
  for (int i = 0; i < 4; ++i) {
    // A file may store joints as signed numbers, and then as anything.
    const bool known = joint[i] >= 0 && joint[i] < static_cast<double>(joints.size());
    if (!(weight[i] > 0) || !known) continue;
    const Affine& place = joints[static_cast<std::size_t>(joint[i])];
    for (std::size_t axis = 0; axis < 3; ++axis) sum.axes[axis] += place.axes[axis] * weight[i];
    sum.offset += place.offset * weight[i];
    total += weight[i];
  }
  if (!(total > 0) || !std::isfinite(total)) return joints[0];
  for (Double3& axis : sum.axes) axis *= 1 / total;
  sum.offset *= 1 / total;
  return sum;
}

bool read_skin(GltfDocument& document, std::uint32_t node, std::span<const Affine> places, GltfSkin& out) {
  out.joints.clear();
  MeshBuilder& builder = document.builder();
  const JsonValue skins = document.root()["skins"];
  std::uint32_t index = k_none;
  if (!document.root()["nodes"].at(node)["skin"].read_index(index, skins.size(), builder)) return false;
  if (index == k_none) return true;
  const JsonValue skin = skins.at(index);
  std::uint32_t matrices = k_none;
  if (!skin["inverseBindMatrices"].read_index(matrices, document.root()["accessors"].size(), builder))
    return false;
  const std::size_t count = skin["joints"].size();
  std::vector<double> numbers;
  if (matrices != k_none) {
    GltfAccessor accessor;
    if (!open_accessor(document, matrices, accessor)) return false;
    if (accessor.components != 16 || accessor.count < count)
      return builder.refuse(
          fmt::format("{}: {} is no matrix for each of {} joints", skin.path(), accessor.path, count),
          k_gltf_remedy);
    numbers.resize(accessor.count * 16);
    read_numbers(accessor, 16, std::span<double>(numbers));
  }
  for (std::size_t i = 0; i < count; ++i) {
    std::uint32_t joint = k_none;
    if (!skin["joints"].at(i).read_index(joint, places.size(), builder)) return false;
    Affine bind;
    if (!numbers.empty()) {
      const double* m = numbers.data() + 16 * i;
      bind = {{Double3{m[0], m[1], m[2]}, Double3{m[4], m[5], m[6]}, Double3{m[8], m[9], m[10]}},
              {m[12], m[13], m[14]}};
    }
    out.joints.push_back(places[joint] * bind);
  }
  return true;
}

}  // namespace copse
