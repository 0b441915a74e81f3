#include "lib/analysis/surface/lists.h"

#include <algorithm>

namespace copse {

Lists make_lists(const std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs, std::size_t owners) {
  std::vector<std::uint32_t> first(owners + 1, 0);
  for (const auto& [owner, item] : pairs) ++first[owner + 1];
  for (std::size_t i = 0; i < owners; ++i) first[i + 1] += first[i];
  std::vector<std::uint32_t> items(pairs.size()), next(first.begin(), first.end() - 1);
  for (const auto& [owner, item] : pairs) items[next[owner]++] = item;
  Lists lists;
  lists.first.reserve(owners + 1);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < owners; ++i) {
    const auto from = items.begin() + first[i], to = items.begin() + first[i + 1];
    if (!std::is_sorted(from, to)) std::sort(from, to);
    const std::size_t begin = kept;
    for (auto item = from; item != to; ++item) {
      if (kept == begin || items[kept - 1] != *item) items[kept++] = *item;
    }
    lists.first.push_back(static_cast<std::uint32_t>(kept));
  }
  items.resize(kept);
  lists.items = std::move(items);
  return lists;
}

}  // namespace copse
