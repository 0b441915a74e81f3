#include "lib/formats/container/mapped_file.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string>
#include <vector>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace copse {
namespace {

struct Descriptor {
  int number = -1;
  ~Descriptor() {
    if (number >= 0) ::close(number);
  }
};

struct Mapping {
  void* start = nullptr;
  std::size_t size = 0;
  Mapping(void* start_at, std::size_t bytes) : start(start_at), size(bytes) {}
  Mapping(const Mapping&) = delete;
  Mapping& operator=(const Mapping&) = delete;
  ~Mapping() { ::munmap(start, size); }
};

// One byte more than `most` is asked for, to tell a pipe that holds that from one that goes on.
Result<std::vector<std::uint8_t>> read_to_end(int file, const std::string& name, std::size_t most) {
  std::vector<std::uint8_t> bytes;
  std::size_t used = 0;
  for (;;) {
    if (used > most) {
      return refuse(name, "the pipe holds more than " + std::to_string(most) + " bytes",
                    "write them to a file and name that");
    }
    if (used == bytes.size()) {
      bytes.resize(std::min(most + 1, std::max<std::size_t>(std::size_t{1} << 16, 2 * used)));
    }
    const ssize_t n = ::read(file, bytes.data() + used, bytes.size() - used);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return fail(Fault::io, name, std::strerror(errno), "check the program that writes the pipe");
    if (n == 0) break;
    used += static_cast<std::size_t>(n);
  }
  bytes.resize(used);
  return bytes;
}

}  // namespace

Result<MappedFile> MappedFile::open(const std::filesystem::path& path, std::size_t most_of_a_pipe) {
  const std::string name = path.string();
  const auto failed = [&] {
    return fail(Fault::io, name, std::strerror(errno), "check the path and its permissions");
  };
  const Descriptor file{::open(path.c_str(), O_RDONLY | O_CLOEXEC)};
  if (file.number < 0) return failed();
  struct stat status {};
  if (::fstat(file.number, &status) != 0) return failed();

  MappedFile mapped;
  if (S_ISFIFO(status.st_mode)) {
    auto bytes = read_to_end(file.number, name, most_of_a_pipe);
    if (!bytes) return std::unexpected(bytes.error());
    auto owner = std::make_shared<const std::vector<std::uint8_t>>(std::move(*bytes));
    mapped.bytes_ = *owner;
    mapped.owner_ = std::move(owner);
    return mapped;
  }
  if (S_ISDIR(status.st_mode)) return fail(Fault::io, name, "is a folder", "name a file");
  if (!S_ISREG(status.st_mode)) return fail(Fault::io, name, "is not a file", "name a file or a pipe");
  const auto size = static_cast<std::size_t>(status.st_size);
  if (size == 0) return mapped;  // a mapping cannot be empty
  void* start = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file.number, 0);
  if (start == MAP_FAILED) return failed();
  auto owner = std::make_shared<const Mapping>(start, size);
  mapped.bytes_ = {static_cast<const std::uint8_t*>(start), size};
  mapped.owner_ = std::move(owner);
  return mapped;
}

}  // namespace copse
