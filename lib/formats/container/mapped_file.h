// A file's bytes, mapped read-only: nothing is read until it is touched.
#pragma once

#include "lib/formats/result.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

namespace copse {

// What a pipe may hold, as its bytes are kept in memory: a mesh of three million triangles as text is half of
// it.
inline constexpr std::size_t k_most_pipe_bytes = std::size_t{1} << 30;

// Copies share one mapping, which lives as long as any of them. A regular file is mapped; a pipe (such as a
// shell's <(command)) is read to its end, unless it holds more than `most_of_a_pipe` bytes; anything else is
// refused. Files that copse writes are replaced by
// rename, so a mapping keeps the old contents; a foreign program that truncates a mapped file in place makes
// the next touch of the missing pages fail (SIGBUS), as with any mapping.
class MappedFile {
 public:
  static Result<MappedFile> open(const std::filesystem::path& path,
                                 std::size_t most_of_a_pipe = k_most_pipe_bytes);

  std::span<const std::uint8_t> bytes() const { return bytes_; }
  // What keeps the bytes alive, for Arrays that borrow them.
  const std::shared_ptr<const void>& owner() const { return owner_; }

 private:
  std::span<const std::uint8_t> bytes_;
  std::shared_ptr<const void> owner_;
};

}  // namespace copse
