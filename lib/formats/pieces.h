// The bytes of a file as pieces, one after the other, so that a file larger than what is left of memory can
// be hashed and written from where its parts already lie.
#pragma once

#include "lib/formats/array.h"

#include <cstdint>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace copse {

class Pieces {
 public:
  Pieces() = default;
  explicit Pieces(Array<std::uint8_t> bytes) { add(std::move(bytes)); }
  // Text that outlives the pieces.
  static Pieces borrowed(std::string_view text) {
    return Pieces({{reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, nullptr});
  }

  // Pieces keep alive what owns the bytes; an array that borrows without an owner must outlive them.
  void add(Array<std::uint8_t> bytes) {
    size_ += bytes.size();
    if (!bytes.empty()) list_.push_back(std::move(bytes));
  }
  std::uint64_t size() const { return size_; }
  std::span<const Array<std::uint8_t>> list() const { return list_; }

  // All in one.
  std::vector<std::uint8_t> joined() const {
    std::vector<std::uint8_t> bytes;
    bytes.reserve(size_);
    for (const auto& piece : list_) bytes.insert(bytes.end(), piece.begin(), piece.end());
    return bytes;
  }

 private:
  std::vector<Array<std::uint8_t>> list_;
  std::uint64_t size_ = 0;
};

}  // namespace copse
