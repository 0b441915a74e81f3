#include "tools/treeplay/level_ladder.h"

#include "lib/runtime/stochastic_levels.h"

#include <algorithm>
#include <cmath>

namespace copse::treeplay {
namespace {

// A level takes the place of another only if it has so much fewer triangles.
constexpr double k_worth_it = 0.75;

double triangles_of(const std::vector<DrawRange>& ranges) {
  double sum = 0;
  for (const DrawRange& r : ranges) sum += r.index_count / 3;
  return sum;
}

}  // namespace

LevelLadder::LevelLadder(const ForestType& type, bool own, double pixel, double fade) {
  const bool pictures = own && type.impostor;
  std::vector<Border> wanted;
  for (std::size_t l = 0; l < type.coarser.size(); ++l)
    wanted.push_back({double{type.coarser[l]}, 0, 0, static_cast<std::uint32_t>(l + 1)});
  for (std::size_t l = type.coarser.size() + 1; l < type.levels.size() && !pictures && pixel > 0; ++l) {
    // As far away as a triangle a pixel is enough.
    const double pixels = std::sqrt(triangles_of(type.levels[l]));
    if (!(pixels > 0 && type.height > 0)) continue;
    wanted.push_back({double{type.height} / (pixel * pixels), 0, 0, static_cast<std::uint32_t>(l)});
  }
  std::stable_sort(wanted.begin(), wanted.end(),
                   [](const Border& a, const Border& b) { return a.distance < b.distance; });
  double triangles = triangles_of(type.levels[0]);
  for (const Border& border : wanted) {
    const double fewer = triangles_of(type.levels[border.level]);
    const bool by_distance = border.level <= type.coarser.size();
    if (fewer > (by_distance ? 1 : k_worth_it) * triangles) continue;
    if (pictures && border.distance >= double{type.impostor->atlas.distance}) break;
    borders_.push_back(border);
    triangles = fewer;
  }
  if (pictures) borders_.push_back({double{type.impostor->atlas.distance}, 0, 0, k_impostor});
  for (std::size_t b = 0; b < borders_.size(); ++b) {
    const double at = borders_[b].distance;
    const double before = b == 0 ? 0 : borders_[b - 1].distance,
                 after = b + 1 < borders_.size() ? borders_[b + 1].distance : 2 * at;
    const double width = std::max(0.0, std::min({fade * at, (at - before) / 2, (after - at) / 2}));
    borders_[b].from = at - width, borders_[b].to = at + width;
  }
}

LadderChoice LevelLadder::at(double away) const {
  // The first border that is not passed whole.
  const auto next =
      std::partition_point(borders_.begin(), borders_.end(), [&](const Border& b) { return b.to <= away; });
  const std::uint32_t nearer = next == borders_.begin() ? 0 : std::prev(next)->level;
  const LadderChoice whole{{nearer, k_all_pixels}, {k_none, k_all_pixels}};
  if (next == borders_.end() || !(away > next->from)) return whole;
  const double share = (away - next->from) / (next->to - next->from);
  const int step = static_cast<int>(std::lround(share * k_fade_steps));
  if (step <= 0) return whole;
  if (step >= k_fade_steps) return {{next->level, k_all_pixels}, {k_none, k_all_pixels}};
  // Of the two one has the pixels below the step, the other all the others.
  const LadderLevel far{next->level, static_cast<std::uint8_t>(step)},
      near{nearer, static_cast<std::uint8_t>(k_fade_steps + step)};
  return 2 * step >= k_fade_steps ? LadderChoice{far, near} : LadderChoice{near, far};
}

}  // namespace copse::treeplay
