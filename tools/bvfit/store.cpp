#include "tools/bvfit/store.h"

#include <algorithm>

namespace copse::bvfit {

Result<std::vector<std::uint8_t>> tree_with_volumes(const Input& input, std::span<const SetFit> sets,
                                                    std::span<const VolumeNode> nodes) {
  if (!input.file)
    return refuse(input.name, "volumes can be stored in a tree only",
                  "name a .tree or .stree, or write .json");
  std::vector<VolumeSet> set_records;
  std::vector<VolumeRecord> records;
  std::vector<float> numbers;
  for (const SetFit& set : sets) {
    set_records.push_back({.part = set.part,
                           .index = set.index,
                           .motion = set.motion,
                           .first = static_cast<std::uint32_t>(records.size()),
                           .count = static_cast<std::uint32_t>(set.volumes.size()),
                           .chosen = static_cast<std::uint32_t>(set.chosen),
                           .points = static_cast<std::uint32_t>(set.points),
                           .sway = set.sway});
    for (const FittedVolume& v : set.volumes) {
      const std::vector<float> n = numbers_of(v.volume);
      VolumeRecord r{.kind = v.method.kind,
                     .flags = v.certified ? VolumeRecord::certified : 0u,
                     .first = static_cast<std::uint32_t>(numbers.size()),
                     .count = static_cast<std::uint32_t>(n.size()),
                     .volume = v.measures.volume,
                     .lower_bound = v.lower_bound};
      std::copy_n(v.method.name.begin(), std::min(v.method.name.size(), r.method.size()), r.method.begin());
      records.push_back(r);
      numbers.insert(numbers.end(), n.begin(), n.end());
    }
  }
  const TreeVolumes volumes{std::move(set_records), std::move(records), std::move(numbers),
                            std::vector<VolumeNode>(nodes.begin(), nodes.end())};
  return with_volumes(input.file->container(), volumes);
}

}  // namespace copse::bvfit
