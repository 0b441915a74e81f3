// A read-only array that either owns its elements or borrows them from a mapped file.
//
// One type serves both the tree that a tool has just built and the tree that a program has mapped: the code
// that reads it does not care. Copying an Array copies a reference; the elements live while any copy lives.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace copse {

template <class T>
class Array {
 public:
  Array() = default;
  Array(std::vector<T> elements) {  // NOLINT: a vector *is* an array, the conversion is the point
    auto owner = std::make_shared<const std::vector<T>>(std::move(elements));
    view_ = *owner;
    owner_ = std::move(owner);
  }
  Array(std::span<const T> elements, std::shared_ptr<const void> owner)
      : view_(elements), owner_(std::move(owner)) {}

  std::size_t size() const { return view_.size(); }
  bool empty() const { return view_.empty(); }
  const T* data() const { return view_.data(); }
  const T& operator[](std::size_t i) const { return view_[i]; }
  auto begin() const { return view_.begin(); }
  auto end() const { return view_.end(); }
  std::span<const T> span() const { return view_; }
  operator std::span<const T>() const { return view_; }  // NOLINT: reads as a span everywhere
  // The same memory as bytes, kept alive by the same owner.
  Array<std::uint8_t> as_bytes() const {
    static_assert(std::is_trivially_copyable_v<T>);
    return {{reinterpret_cast<const std::uint8_t*>(view_.data()), view_.size_bytes()}, owner_};
  }
  std::vector<T> to_vector() const { return {view_.begin(), view_.end()}; }

 private:
  std::span<const T> view_;
  std::shared_ptr<const void> owner_;
};

}  // namespace copse
