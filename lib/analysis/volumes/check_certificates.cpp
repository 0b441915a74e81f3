#include "lib/analysis/volumes/check_certificates.h"

#include "lib/analysis/tree/tree_parts.h"
#include "lib/analysis/volumes/certify.h"

#include <fmt/format.h>

namespace copse {
namespace {

std::vector<Double3> points_of(const VolumeSet& set, TreeParts& parts) {
  const std::uint32_t index = set.index == k_none ? 0 : set.index;
  if (index >= parts.count(set.part)) return {};
  std::vector<Double3> out;
  for (const std::uint32_t p : parts.part(set.part, index).points) out.push_back(parts.points()[p]);
  return out;
}

// Of all vertices of all sets: some minutes. No honest file comes near it; a forged one must not take days.
constexpr std::uint64_t k_most_tests = std::uint64_t{1} << 32;

// Of a node: everything below it.
std::vector<Double3> points_below(std::uint32_t node, const TreeVolumes& volumes, TreeParts& parts) {
  std::vector<Double3> out;
  for (std::uint32_t i = node; i < volumes.nodes[node].skip; ++i) {
    if (volumes.nodes[i].item == k_none) continue;
    const std::vector<Double3> part = points_of(volumes.sets[volumes.nodes[i].set], parts);
    out.insert(out.end(), part.begin(), part.end());
  }
  return out;
}

}  // namespace

std::vector<std::string> check_certificates(const Tree& tree, const TreeVolumes& volumes) {
  std::vector<std::string> failures;
  TreeParts parts(tree);
  std::uint64_t tests = 0;
  for (const VolumeSet& set : volumes.sets) {
    if (set.motion != VolumeMotion::rest) continue;
    const std::vector<Double3> points =
        set.part == VolumePart::node ? points_below(set.index, volumes, parts) : points_of(set, parts);
    tests += (points.size() + 1) * set.count;
    if (tests > k_most_tests)
      return failures.emplace_back("VSET: more volumes and vertices than can be judged"), failures;
    for (std::uint32_t i = set.first; i < set.first + set.count; ++i) {
      const VolumeRecord& r = volumes.volumes[i];
      if ((r.flags & VolumeRecord::certified) == 0) continue;
      const Certificate c = certify(volumes.volume(i), points);
      if (c.holds()) continue;
      failures.push_back(fmt::format("VOLU[{}]: {} ({}) of {} leaves {} of {} vertices outside", i,
                                     name_of(r.kind), r.method_name(), set_name(set), c.outside, c.points));
    }
  }
  return failures;
}

}  // namespace copse
