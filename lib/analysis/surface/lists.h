// lists: many short lists of numbers in two arrays.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace copse {

// One list an owner.
struct Lists {
  std::vector<std::uint32_t> first{0}, items;
  std::size_t count() const { return first.size() - 1; }
  std::span<const std::uint32_t> operator[](std::size_t owner) const {
    return std::span(items).subspan(first[owner], first[owner + 1] - first[owner]);
  }
};

// The items of (owner, item) pairs by owner, ascending, each once. Linear when each owner's items come in
// ascending order.
Lists make_lists(const std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs, std::size_t owners);

}  // namespace copse
