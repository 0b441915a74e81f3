#include "lib/analysis/volumes/check_certificates.h"

#include "lib/analysis/tree/tree_parts.h"
#include "lib/analysis/volumes/certify.h"
#include "lib/analysis/volumes/motion_envelope.h"

#include <numbers>
#include <optional>

#include <fmt/format.h>

namespace copse {
namespace {

// Of all vertices of all sets: some minutes. No honest file comes near it; a forged one must not take days.
constexpr std::uint64_t k_most_tests = std::uint64_t{1} << 32;

// What the sets of a tree's file are to hold.
class TreeContents {
 public:
  TreeContents(const Tree& tree, const TreeVolumes& volumes, const FoliageCells& cells)
      : tree_(tree), volumes_(volumes), nodes_(volumes.nodes.to_vector()), parts_(tree, &cells) {}

  // None when the tree has no such part.
  std::optional<std::vector<Double3>> of(const VolumeSet& set) {
    std::vector<Double3> out;
    if (set.part != VolumePart::node)
      return add(set, set, out) ? std::optional(std::move(out)) : std::nullopt;
    for (const std::uint32_t below : sets_below(nodes_, set.index)) {
      if (!add(volumes_.sets[below], set, out)) return std::nullopt;
    }
    return out;
  }

 private:
  // The vertices of one part, as `moving` sways.
  bool add(const VolumeSet& part, const VolumeSet& moving, std::vector<Double3>& out) {
    const std::uint32_t index = part.index == k_none ? 0 : part.index;
    if (index >= parts_.count(part.part)) return false;
    const std::vector<std::uint32_t> members = parts_.part(part.part, index).points;
    if (moving.motion == VolumeMotion::rest || moving.sway == 0) {
      for (const std::uint32_t p : members) out.push_back(parts_.points()[p]);
      return true;
    }
    if (reach_.empty() || sway_ != moving.sway) {
      sway_ = moving.sway;
      reach_ = sway_reach(tree_, sway_ * std::numbers::pi / 180);
    }
    std::vector<Double3> points;
    std::vector<double> radii;
    for (const std::uint32_t p : members) points.push_back(parts_.points()[p]), radii.push_back(reach_[p]);
    const std::vector<Double3> envelope = ball_envelope(points, radii);
    out.insert(out.end(), envelope.begin(), envelope.end());
    return true;
  }

  const Tree& tree_;
  const TreeVolumes& volumes_;
  std::vector<VolumeNode> nodes_;
  TreeParts parts_;
  std::vector<double> reach_;  // of every vertex
  float sway_ = 0;             // by which
};

}  // namespace

std::vector<std::string> check_certificates(const Tree& tree, const TreeVolumes& volumes,
                                            const FoliageCells& cells) {
  std::vector<std::string> failures;
  TreeContents contents(tree, volumes, cells);
  std::uint64_t tests = 0;
  for (std::size_t s = 0; s < volumes.sets.size(); ++s) {
    const VolumeSet& set = volumes.sets[s];
    const auto points = contents.of(set);
    if (!points) {
      failures.push_back(fmt::format("VSET[{}]: the tree has no {}", s, set_name(set)));
      continue;
    }
    tests += (points->size() + 1) * set.count;
    if (tests > k_most_tests)
      return failures.emplace_back("VSET: more volumes and vertices than can be judged"), failures;
    for (std::uint32_t i = set.first; i < set.first + set.count; ++i) {
      const VolumeRecord& r = volumes.volumes[i];
      if ((r.flags & VolumeRecord::certified) == 0) continue;
      const Certificate c = certify(volumes.volume(i), *points);
      if (c.holds()) continue;
      failures.push_back(fmt::format("VOLU[{}]: {} ({}) of {} leaves {} of {} vertices outside", i,
                                     name_of(r.kind), r.method_name(), set_name(set), c.outside, c.points));
    }
  }
  return failures;
}

std::vector<std::uint32_t> sets_below(std::span<const VolumeNode> nodes, std::uint32_t node) {
  std::vector<std::uint32_t> out;
  for (std::uint32_t i = node; i < nodes[node].skip; ++i) {
    if (nodes[i].skip == i + 1) out.push_back(nodes[i].set);
  }
  return out;
}

}  // namespace copse
