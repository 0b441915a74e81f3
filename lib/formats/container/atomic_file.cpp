#include "lib/formats/container/atomic_file.h"

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

namespace copse {
namespace {

namespace fs = std::filesystem;

constexpr int k_link_limit = 40;  // symbolic links in a row, as the kernel counts them

std::unexpected<Error> io_error(const fs::path& path, int error) {
  const char* remedy = "check the path and its permissions";
  if (error == ENOSPC || error == EDQUOT) remedy = "free some space, or write elsewhere";
  if (error == ENOENT) remedy = "make the folder first";
  return fail(Fault::io, path.string(), fmt::format("cannot write: {}", std::strerror(error)), remedy);
}

// What `path` finally names: a link is written through, as open() would. A dangling link names its target.
fs::path follow_links(fs::path path) {
  std::error_code error;
  for (int i = 0; i < k_link_limit && fs::is_symlink(fs::symlink_status(path, error)); ++i) {
    const fs::path target = fs::read_symlink(path, error);
    if (error) break;
    path = target.is_absolute() ? target : path.parent_path() / target;
  }
  return path;
}

int write_all(int file, std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(file, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return errno;
    bytes = bytes.subspan(static_cast<std::size_t>(n));
  }
  return 0;
}

int write_all(int file, const Pieces& pieces) {
  for (const auto& piece : pieces.list()) {
    if (const int error = write_all(file, piece.span())) return error;
  }
  return 0;
}

// Makes a new file beside `target` that no other process or thread uses. The kernel applies the umask.
int open_beside(const fs::path& target, fs::path& temporary) {
  static std::atomic<unsigned> counter{0};
  for (;;) {
    const std::string name =
        fmt::format(".{}.{}-{}.part", target.filename().string().substr(0, 200), ::getpid(), counter++);
    temporary = target.parent_path() / name;
    const int file = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file >= 0 || errno != EEXIST) return file;
  }
}

// Writes, keeps the permissions of the file that will be replaced, syncs. 0, or errno.
int fill(int file, const fs::path& target, const Pieces& bytes) {
  struct stat old {};
  if (::stat(target.c_str(), &old) == 0 && ::fchmod(file, old.st_mode & 07777) != 0) return errno;
  if (const int error = write_all(file, bytes)) return error;
  return ::fsync(file) == 0 ? 0 : errno;
}

// Renames last only once the folder itself is synced. File systems that cannot are left as they are.
void sync_folder(const fs::path& folder) {
  const int file = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (file < 0) return;
  ::fsync(file);
  ::close(file);
}

int write_directly(const fs::path& path, std::span<const std::uint8_t> bytes) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (file < 0) return errno;
  const int error = write_all(file, bytes);
  return ::close(file) == 0 || error ? error : errno;
}

}  // namespace

Result<void> write_file(const fs::path& path, const Pieces& bytes) {
  OutputGroup group;
  if (auto added = group.add(path, bytes); !added) return added;
  return group.commit();
}

Result<void> write_file(const fs::path& path, std::string_view bytes) {
  return write_file(path, Pieces::borrowed(bytes));
}

Result<void> write_file(const fs::path& path, std::span<const std::uint8_t> bytes) {
  return write_file(path, Pieces({bytes, nullptr}));
}

OutputGroup::OutputGroup(OutputGroup&& other) noexcept : pending_(std::exchange(other.pending_, {})) {}

OutputGroup& OutputGroup::operator=(OutputGroup&& other) noexcept {
  if (this != &other) {
    discard();
    pending_ = std::exchange(other.pending_, {});
  }
  return *this;
}

OutputGroup::~OutputGroup() {
  discard();
}

void OutputGroup::discard() noexcept {
  for (const Pending& p : pending_) {
    if (!p.temporary.empty()) ::unlink(p.temporary.c_str());
  }
  pending_.clear();
}

Result<void> OutputGroup::add(const fs::path& path, std::string_view bytes) {
  return add(path, Pieces::borrowed(bytes));
}

Result<void> OutputGroup::add(const fs::path& path, std::span<const std::uint8_t> bytes) {
  return add(path, Pieces({bytes, nullptr}));
}

Result<void> OutputGroup::add(const fs::path& path, const Pieces& bytes) {
  if (path.empty()) return fail(Fault::io, "", "the output has no name", "name a file");
  Pending entry{.named = path, .target = follow_links(path), .temporary = {}, .contents = {}};
  struct stat status {};
  if (::stat(entry.target.c_str(), &status) == 0 && !S_ISREG(status.st_mode)) {
    if (S_ISDIR(status.st_mode)) return fail(Fault::io, path.string(), "is a folder", "name a file in it");
    if (::access(entry.target.c_str(), W_OK) != 0) return io_error(path, errno);
    entry.contents = bytes.joined();
    pending_.push_back(std::move(entry));
    return {};
  }
  if (entry.target.filename().empty()) return io_error(path, EISDIR);
  // Renaming would replace a file that its owner has protected from writing.
  if (::access(entry.target.c_str(), W_OK) != 0 && errno != ENOENT) return io_error(path, errno);
  const int file = open_beside(entry.target, entry.temporary);
  if (file < 0) return io_error(path, errno);
  pending_.push_back(entry);  // from here on the temporary file is removed whatever happens
  int error = fill(file, entry.target, bytes);
  if (::close(file) != 0 && error == 0) error = errno;
  if (error == 0) return {};
  ::unlink(entry.temporary.c_str());
  pending_.pop_back();
  return io_error(path, error);
}

Result<void> OutputGroup::commit() {
  std::vector<fs::path> folders;
  std::size_t done = 0;
  int error = 0;
  for (; done < pending_.size(); ++done) {
    const Pending& p = pending_[done];
    if (p.temporary.empty()) {
      error = write_directly(p.target, p.contents);
    } else if (::rename(p.temporary.c_str(), p.target.c_str()) != 0) {
      error = errno;
    }
    if (error != 0) break;
    if (folders.empty() || folders.back() != p.target.parent_path())
      folders.push_back(p.target.parent_path());
  }
  Result<void> result;
  if (error != 0) result = io_error(pending_[done].named, error);
  pending_.erase(pending_.begin(), pending_.begin() + static_cast<std::ptrdiff_t>(done));
  discard();
  for (const fs::path& folder : folders) sync_folder(folder);
  return result;
}

}  // namespace copse
