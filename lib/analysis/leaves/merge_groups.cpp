#include "lib/analysis/leaves/merge_groups.h"

#include "lib/analysis/leaves/nearest_points.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <queue>
#include <utility>

namespace copse {
namespace {

using Indices = std::vector<std::uint32_t>;

// The nearest of the groups that are left. The tree is rebuilt whenever half of it is gone, so that a search
// never wades through the dead.
class LivingGroups {
 public:
  explicit LivingGroups(std::span<const Double3> centres) : centres_(centres), dead_(centres.size(), 0) {
    Indices all(centres.size());
    std::iota(all.begin(), all.end(), 0u);
    rebuild(std::move(all));
  }

  bool alive(std::uint32_t group) const { return !dead_[group]; }
  std::uint32_t remove_and_find_nearest(std::uint32_t group) {
    dead_[group] = 1;
    const auto here = std::lower_bound(group_.begin(), group_.end(), group) - group_.begin();
    gone_[static_cast<std::size_t>(here)] = 1;
    if (2 * ++gone_count_ > group_.size()) {
      Indices left;
      std::copy_if(group_.begin(), group_.end(), std::back_inserter(left),
                   [&](std::uint32_t g) { return alive(g); });
      rebuild(std::move(left));
    }
    return group_[tree_->nearest(centres_[group], gone_)];
  }

 private:
  void rebuild(Indices groups) {
    group_ = std::move(groups);
    points_.clear();
    for (const std::uint32_t g : group_) points_.push_back(centres_[g]);
    gone_.assign(group_.size(), 0);
    gone_count_ = 0;
    tree_ = std::make_unique<NearestPoints>(points_);
  }

  std::span<const Double3> centres_;
  std::vector<std::uint8_t> dead_;
  Indices group_;  // ascending: so the lowest in the tree is the lowest group
  std::vector<Double3> points_;
  std::vector<std::uint8_t> gone_;
  std::size_t gone_count_ = 0;
  std::unique_ptr<NearestPoints> tree_;
};

}  // namespace

std::vector<std::uint32_t> merge_groups(std::span<const Double3> centres,
                                        std::span<const std::uint32_t> leaves, std::uint32_t limit) {
  Indices into(centres.size());
  std::iota(into.begin(), into.end(), 0u);
  if (centres.size() <= limit) return into;
  using Entry = std::pair<std::uint64_t, std::uint32_t>;  // leaves, group
  std::vector<Entry> entries;
  std::vector<std::uint64_t> size(leaves.begin(), leaves.end());
  for (std::uint32_t g = 0; g < size.size(); ++g) entries.emplace_back(size[g], g);
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> smallest(std::greater<>(),
                                                                          std::move(entries));
  LivingGroups living(centres);
  for (std::size_t left = centres.size(); left > limit; --left) {
    // A group that has grown is in the queue twice; its old entry is stale.
    while (!living.alive(smallest.top().second) || size[smallest.top().second] != smallest.top().first)
      smallest.pop();
    const std::uint32_t group = smallest.top().second;
    smallest.pop();
    const std::uint32_t receiver = living.remove_and_find_nearest(group);
    into[group] = receiver;
    size[receiver] += size[group];
    smallest.emplace(size[receiver], receiver);
  }
  // Receivers may have been received themselves: follow each chain to its end, once.
  for (std::uint32_t g = 0; g < into.size(); ++g) {
    std::uint32_t end = g;
    while (into[end] != end) end = into[end];
    for (std::uint32_t i = g; into[i] != end;) i = std::exchange(into[i], end);
  }
  return into;
}

}  // namespace copse
