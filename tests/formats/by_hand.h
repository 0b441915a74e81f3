// Writes files byte by byte as docs/formats.md gives them, sharing no code with the encoders.
#pragma once

#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <string>
#include <vector>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace copse::by_hand {

// Bytes, little-endian, one field after the other.
class Bytes {
 public:
  Bytes& text(const std::string& s) {
    for (const char c : s) bytes_.push_back(static_cast<std::uint8_t>(c));
    return *this;
  }
  Bytes& u32(std::initializer_list<std::uint32_t> values) {
    for (const std::uint32_t v : values) number(v, 4);
    return *this;
  }
  Bytes& u64(std::uint64_t v) { return number(v, 8); }
  Bytes& f32(std::initializer_list<float> values) {
    for (const float v : values) {
      std::uint32_t bits = 0;
      std::memcpy(&bits, &v, 4);
      number(bits, 4);
    }
    return *this;
  }
  Bytes& f64(std::initializer_list<double> values) {
    for (const double v : values) {
      std::uint64_t bits = 0;
      std::memcpy(&bits, &v, 8);
      number(bits, 8);
    }
    return *this;
  }
  Bytes& zeros_to(std::size_t size) {
    bytes_.resize(size);
    return *this;
  }
  const std::vector<std::uint8_t>& get() const { return bytes_; }

 private:
  Bytes& number(std::uint64_t v, int size) {
    for (int i = 0; i < size; ++i) bytes_.push_back(static_cast<std::uint8_t>(v >> (8 * i)));
    return *this;
  }
  std::vector<std::uint8_t> bytes_;
};

struct Part {
  std::string name;
  std::uint32_t stride;
  Bytes bytes;
  std::uint32_t encoding = 0;
  std::size_t decoded = 0;  // of a compressed part
  std::uint32_t version = 1;
};

inline std::uint64_t hash(const std::vector<std::uint8_t>& bytes) {
  return XXH3_64bits(bytes.data(), bytes.size());
}

inline std::vector<std::uint8_t> file(std::uint32_t kind, const std::vector<Part>& parts) {
  Bytes table;
  std::size_t end = 64 + 48 * parts.size();
  for (const Part& p : parts) {
    const std::size_t offset = (end + 63) / 64 * 64, size = p.bytes.get().size();
    table.text(p.name)
        .u32({p.version, p.encoding, p.stride})
        .u64(offset)
        .u64(size)
        .u64(p.encoding ? p.decoded : size);
    table.u64(hash(p.bytes.get()));
    end = offset + size;
  }
  Bytes header;
  header
      .text(
          "\x89"
          "COPSE\r\n")
      .u32({1, kind, static_cast<std::uint32_t>(parts.size()), 0})
      .u64(end);
  header.u64(hash(table.get())).zeros_to(56);
  header.u64(hash(header.get()));
  Bytes out = header;
  out.text({table.get().begin(), table.get().end()});
  for (const Part& p : parts) {
    out.zeros_to((out.get().size() + 63) / 64 * 64);
    out.text({p.bytes.get().begin(), p.bytes.get().end()});
  }
  return out.get();
}

}  // namespace copse::by_hand
