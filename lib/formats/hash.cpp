#include "lib/formats/hash.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <memory>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>
#include <xxhash.h>

namespace copse {

std::uint64_t xxh3(std::span<const std::uint8_t> bytes) {
  return XXH3_64bits(bytes.data(), bytes.size());
}

std::uint64_t xxh3(std::string_view bytes) {
  return XXH3_64bits(bytes.data(), bytes.size());
}

std::string hash_text(std::uint64_t hash) {
  return fmt::format("xxh3:{:016x}", hash);
}

std::string hash_of(std::span<const std::uint8_t> bytes) {
  return hash_text(xxh3(bytes));
}

std::string hash_of(std::string_view bytes) {
  return hash_text(xxh3(bytes));
}

std::string hash_of(const Pieces& pieces) {
  const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(), XXH3_freeState);
  XXH3_64bits_reset(state.get());
  for (const auto& piece : pieces.list()) XXH3_64bits_update(state.get(), piece.data(), piece.size());
  return hash_text(XXH3_64bits_digest(state.get()));
}

Result<FileRecord> hash_file(const std::filesystem::path& path) {
  const auto failed = [&] {
    return fail(Fault::io, path.string(), std::strerror(errno), "check the path and its permissions");
  };
  FileRecord record{.path = path.string(), .bytes = 0, .hash = {}};
  // Without opening it: a pipe that nobody writes any more would never open.
  std::error_code unknown;
  const auto type = std::filesystem::status(path, unknown).type();
  if (type == std::filesystem::file_type::fifo || type == std::filesystem::file_type::character)
    return record;
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return failed();
  const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(), XXH3_freeState);
  XXH3_64bits_reset(state.get());
  std::vector<char> buffer(std::size_t{1} << 20);
  for (;;) {
    const ssize_t n = ::read(file, buffer.data(), buffer.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) {
      const int error = errno;
      ::close(file);
      errno = error;
      return failed();
    }
    if (n == 0) break;
    XXH3_64bits_update(state.get(), buffer.data(), static_cast<std::size_t>(n));
    record.bytes += static_cast<std::uint64_t>(n);
  }
  ::close(file);
  record.hash = hash_text(XXH3_64bits_digest(state.get()));
  return record;
}

}  // namespace copse
