#include "lib/formats/import/source.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <memory>
#include <new>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

namespace copse {
namespace {

class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  int get() const { return fd_; }

 private:
  int fd_;
};

std::unexpected<Error> io_error(const std::string& file, int code) {
  return fail(Fault::io, file, fmt::format("cannot be read: {}", std::strerror(code)),
              "check the name and the permissions");
}

Result<Bytes> map_file(int fd, std::size_t size, const std::string& name) {
  if (size == 0) return Bytes{};
  void* address = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, fd, 0);
  if (address == MAP_FAILED) return io_error(name, errno);
  ::madvise(address, size, MADV_SEQUENTIAL);
  std::shared_ptr<const void> owner(address, [size](const void* p) { ::munmap(const_cast<void*>(p), size); });
  return Bytes({static_cast<const std::uint8_t*>(address), size}, std::move(owner));
}

Result<Bytes> read_stream(int fd, const std::string& name) {
  constexpr std::size_t k_block = std::size_t{1} << 20;
  std::vector<std::uint8_t> bytes;
  for (;;) {
    const std::size_t used = bytes.size();
    if (used > k_stream_limit)
      return refuse(name, fmt::format("is a stream longer than {} bytes", k_stream_limit),
                    "store it in a file");
    bytes.resize(used + k_block);
    const ssize_t got = ::read(fd, bytes.data() + used, k_block);
    if (got < 0 && errno != EINTR) return io_error(name, errno);
    bytes.resize(used + static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
    if (got == 0) return Bytes(std::move(bytes));
  }
}

// Owns a zlib stream that undoes gzip, and nothing else.
class Inflater {
 public:
  Inflater() { ready_ = ::inflateInit2(&stream_, 16 + MAX_WBITS) == Z_OK; }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;
  ~Inflater() {
    if (ready_) ::inflateEnd(&stream_);
  }
  bool ready() const { return ready_; }
  z_stream* operator->() { return &stream_; }
  int step() { return ::inflate(&stream_, Z_NO_FLUSH); }
  bool restart() { return ::inflateReset(&stream_) == Z_OK; }

 private:
  z_stream stream_{};
  bool ready_ = false;
};

// The size of the data modulo 2^32, which a gzip file ends with: a hint for the first allocation, no more.
std::uint64_t size_hint(std::span<const std::uint8_t> bytes, std::uint64_t limit) {
  if (bytes.size() < 4) return 0;
  std::uint32_t size = 0;
  std::memcpy(&size, bytes.data() + bytes.size() - 4, 4);
  return std::min<std::uint64_t>({size, limit, bytes.size() * 32});
}

bool all_zero(std::span<const std::uint8_t> bytes) {
  return std::all_of(bytes.begin(), bytes.end(), [](std::uint8_t b) { return b == 0; });
}

}  // namespace

Result<Bytes> open_bytes(const std::filesystem::path& path) {
  const std::string name = path.string();
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.get() < 0) return io_error(name, errno);
  struct stat info {};
  if (::fstat(file.get(), &info) != 0) return io_error(name, errno);
  if (S_ISDIR(info.st_mode)) return fail(Fault::io, name, "is a folder", "name a file in it");
  if (S_ISREG(info.st_mode)) return map_file(file.get(), static_cast<std::size_t>(info.st_size), name);
  return read_stream(file.get(), name);
}

bool is_gzip(std::span<const std::uint8_t> bytes) {
  return bytes.size() >= 2 && bytes[0] == 0x1f && bytes[1] == 0x8b;
}

Result<Bytes> inflate_gzip(std::span<const std::uint8_t> bytes, const std::string& name) {
  const std::uint64_t limit = std::max<std::uint64_t>(k_inflate_floor, k_inflate_ratio * bytes.size());
  Inflater inflater;
  if (!inflater.ready()) return fail(Fault::bug, name, "zlib could not be started", "report this");
  std::vector<std::uint8_t> out(std::max<std::size_t>(size_hint(bytes, limit) + 1, 4096));
  std::size_t used = 0;
  std::size_t taken = 0;
  for (;;) {
    if (used == out.size()) out.resize(std::min<std::uint64_t>(limit + 1, out.size() * 2));
    const std::size_t room = std::min<std::size_t>(out.size() - used, std::size_t{1} << 30);
    const std::size_t left = std::min<std::size_t>(bytes.size() - taken, std::size_t{1} << 30);
    inflater->next_in = const_cast<Bytef*>(bytes.data() + taken);
    inflater->avail_in = static_cast<uInt>(left);
    inflater->next_out = out.data() + used;
    inflater->avail_out = static_cast<uInt>(room);
    const int status = inflater.step();
    taken += left - inflater->avail_in;
    used += room - inflater->avail_out;
    if (used > limit)
      return refuse(name, fmt::format("inflates {} bytes to more than {}", bytes.size(), limit),
                    "if this is not an attack, store it uncompressed");
    if (status == Z_STREAM_END) {
      const auto rest = bytes.subspan(taken);
      if (all_zero(rest)) break;  // padding, as tape and block devices leave it
      if (!is_gzip(rest) || !inflater.restart())
        return refuse(name, fmt::format("byte {}: what follows the gzip data is not gzip", taken),
                      "compress it again");
    } else if (status == Z_BUF_ERROR ||
               (status == Z_OK && taken == bytes.size() && inflater->avail_out != 0)) {
      return refuse(name, fmt::format("byte {}: the gzip data end in the middle", bytes.size()),
                    "copy or compress it again");
    } else if (status != Z_OK) {
      return refuse(name,
                    fmt::format("byte {}: the gzip data are damaged ({})", taken,
                                inflater->msg != nullptr ? inflater->msg : "zlib gives no reason"),
                    "copy or compress it again");
    }
  }
  out.resize(used);
  return Bytes(std::move(out));
}

std::filesystem::path below(const std::filesystem::path& folder, const std::string& reference) {
  if (reference.empty() || reference.find('\0') != std::string::npos) return {};
  std::string portable = reference;
  std::replace(portable.begin(), portable.end(), '\\', '/');
  const bool drive = portable.size() > 1 && portable[1] == ':';
  const std::filesystem::path relative = std::filesystem::path(portable).lexically_normal();
  if (drive || relative.is_absolute() || relative.empty() || *relative.begin() == "..") return {};
  return folder / relative;
}

}  // namespace copse
