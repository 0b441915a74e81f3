#include "tools/common/outputs.h"

#include "lib/formats/hash.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>

#include <fmt/format.h>
#include <unistd.h>

namespace copse {
namespace fs = std::filesystem;

bool is_stdout(const fs::path& path) {
  return path == "-";
}

Result<void> write_stdout(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(STDOUT_FILENO, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) {
      return fail(Fault::io, "stdout", fmt::format("cannot write: {}", std::strerror(errno)),
                  "keep its reader running, or write to a file");
    }
    bytes.remove_prefix(static_cast<std::size_t>(n));
  }
  return {};
}

Result<void> Outputs::check(const fs::path& path) {
  if (path.empty()) return fail(Fault::usage, "", "an output has an empty name", "name a file");
  if (is_stdout(path)) return {};
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::is_directory(status)) return fail(Fault::io, path.string(), "is a folder", "name a file in it");
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    if (::access(path.c_str(), W_OK) == 0) return {};
    return fail(Fault::io, path.string(), fmt::format("cannot write: {}", std::strerror(errno)),
                "check its permissions");
  }
  // A link is written through, so the folder that counts is its target's.
  const fs::path target = fs::is_symlink(path, error) ? fs::weakly_canonical(path, error) : path;
  const fs::path folder = target.parent_path().empty() ? fs::path(".") : target.parent_path();
  if (!fs::is_directory(folder, error)) {
    return fail(Fault::io, path.string(), fmt::format("the folder '{}' does not exist", folder.string()),
                "make the folder first");
  }
  if (::access(folder.c_str(), W_OK | X_OK) != 0) {
    return fail(Fault::io, path.string(),
                fmt::format("cannot write into '{}': {}", folder.string(), std::strerror(errno)),
                "check its permissions, or write elsewhere");
  }
  return {};
}

Result<void> Outputs::add(const fs::path& path, const Pieces& bytes) {
  const std::lock_guard lock(mutex_);
  if (is_stdout(path)) {
    for (const auto& piece : bytes.list()) stdout_.append(piece.begin(), piece.end());
    return {};
  }
  if (auto added = group_.add(path, bytes); !added) return added;
  std::erase_if(records_, [&](const FileRecord& r) { return r.path == path; });
  records_.push_back({.path = path.string(), .bytes = bytes.size(), .hash = hash_of(bytes)});
  return {};
}

Result<void> Outputs::commit() {
  const std::lock_guard lock(mutex_);
  if (auto written = write_stdout(stdout_); !written) {
    group_ = {};
    return written;
  }
  stdout_.clear();
  return group_.commit();
}

void Outputs::discard() {
  const std::lock_guard lock(mutex_);
  group_ = {};
  stdout_.clear(), records_.clear();
}

}  // namespace copse
