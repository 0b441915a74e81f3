// Output files that appear under their names only when they are whole.
#pragma once

#include "lib/formats/pieces.h"
#include "lib/formats/result.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace copse {

// Writes beside `path` (same folder, a name of its own), syncs, renames: a reader sees the old file or the
// new one, never a part. A symbolic link is followed, an existing file's permissions are kept. What exists
// and is not a regular file (a pipe, /dev/null) is written to directly.
Result<void> write_file(const std::filesystem::path& path, const Pieces& bytes);
Result<void> write_file(const std::filesystem::path& path, std::string_view bytes);
Result<void> write_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);

// Several outputs that become visible together: add() writes and syncs each under a temporary name beside
// its target, commit() renames them all, in the order of add(). Without commit() every trace is removed.
//
// Whatever can be found wrong is found by add() (no folder, no permission, a full disk, a target that is a
// folder). Should a rename of commit() fail all the same, the files renamed before it stay and are whole.
class OutputGroup {
 public:
  OutputGroup() = default;
  OutputGroup(OutputGroup&& other) noexcept;
  OutputGroup& operator=(OutputGroup&& other) noexcept;
  ~OutputGroup();

  // The same target twice: the later contents win.
  Result<void> add(const std::filesystem::path& path, const Pieces& bytes);
  Result<void> add(const std::filesystem::path& path, std::string_view bytes);
  Result<void> add(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);
  Result<void> commit();

 private:
  struct Pending {
    std::filesystem::path named;      // as the user wrote it, for messages
    std::filesystem::path target;     // with symbolic links followed
    std::filesystem::path temporary;  // empty: `contents` go directly into a pipe or device
    std::vector<std::uint8_t> contents;
  };
  void discard() noexcept;
  std::vector<Pending> pending_;
};

}  // namespace copse
