// Memory whose addresses follow the order of allocation, for CGAL's containers in this thread. Its
// mean-curvature flow walks sets of mesh elements that are ordered by address: with a heap's addresses the
// same surface gives another skeleton each time. To be included before anything of CGAL's.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <new>

namespace copse {

// While one lives, CreationOrder<T> takes from its block and frees nothing. What does not fit comes from the
// heap: nothing fails then, only the order is lost.
class CreationOrderBlock {
 public:
  CreationOrderBlock() : memory_(new std::byte[k_size]), outer_(current()) { current() = this; }
  ~CreationOrderBlock() { current() = outer_; }
  CreationOrderBlock(const CreationOrderBlock&) = delete;
  CreationOrderBlock& operator=(const CreationOrderBlock&) = delete;

  static void* take(std::size_t bytes) {
    CreationOrderBlock* const block = current();
    const std::size_t size = (bytes + k_alignment - 1) / k_alignment * k_alignment;
    if (block == nullptr || size > k_size - block->used_) return ::operator new(bytes);
    block->used_ += size;
    return block->memory_.get() + (block->used_ - size);
  }
  static void give_back(void* memory) {
    for (const CreationOrderBlock* block = current(); block != nullptr; block = block->outer_) {
      if (block->holds(static_cast<const std::byte*>(memory))) return;
    }
    ::operator delete(memory);
  }

 private:
  // Address space; only what is used of it becomes memory.
  static constexpr std::size_t k_size = std::size_t{1} << 28, k_alignment = alignof(std::max_align_t);

  static CreationOrderBlock*& current() {
    static thread_local CreationOrderBlock* block = nullptr;
    return block;
  }
  bool holds(const std::byte* memory) const {
    const std::less<> before;
    return !before(memory, memory_.get()) && before(memory, memory_.get() + k_size);
  }

  std::unique_ptr<std::byte[]> memory_;
  std::size_t used_ = 0;
  CreationOrderBlock* outer_;
};

template <class T>
struct CreationOrder {
  using value_type = T;
  CreationOrder() = default;
  template <class U>
  CreationOrder(const CreationOrder<U>&) {}
  T* allocate(std::size_t n) { return static_cast<T*>(CreationOrderBlock::take(n * sizeof(T))); }
  void deallocate(T* memory, std::size_t) { CreationOrderBlock::give_back(memory); }
  friend bool operator==(const CreationOrder&, const CreationOrder&) { return true; }
};

}  // namespace copse

#define CGAL_ALLOCATOR(T) ::copse::CreationOrder<T>
