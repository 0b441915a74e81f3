// Damages files the way an adversary would: with every checksum put right again.
#pragma once

#include "lib/formats/container/container_layout.h"
#include "lib/formats/hash.h"
#include "lib/formats/little_endian.h"

#include <cstdint>
#include <span>
#include <vector>

namespace copse::tampering {

using Bytes = std::vector<std::uint8_t>;

// Makes all checksums and the file's size agree with the bytes, as far as the table makes sense.
inline void mend_checksums(Bytes& bytes) {
  using namespace container_layout;
  if (bytes.size() < k_header_size) return;
  const std::span<std::uint8_t> file(bytes);
  const std::size_t count = get<std::uint32_t>(file, k_section_count);
  if (count > (bytes.size() - k_header_size) / k_entry_size) return;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t entry = k_header_size + i * k_entry_size;
    const auto offset = get<std::uint64_t>(file, entry + k_entry_offset);
    const auto size = get<std::uint64_t>(file, entry + k_entry_stored);
    if (offset > bytes.size() || size > bytes.size() - offset) continue;
    put(file, entry + k_entry_checksum, xxh3(file.subspan(offset, size)));
  }
  put(file, k_file_size, std::uint64_t{bytes.size()});
  put(file, k_table_checksum, xxh3(file.subspan(k_header_size, count * k_entry_size)));
  put(file, k_header_checksum, xxh3(file.first(k_header_checksum)));
}

// The offset of the table's entry of a section.
inline std::size_t entry_of(const Bytes& bytes, std::string_view name) {
  using namespace container_layout;
  for (std::size_t at = k_header_size;; at += k_entry_size) {
    if (std::string_view(reinterpret_cast<const char*>(bytes.data() + at), 4) == name) return at;
  }
}

// The offset of the stored bytes of a section.
inline std::size_t section_at(const Bytes& bytes, std::string_view name) {
  return get<std::uint64_t>(bytes, entry_of(bytes, name) + container_layout::k_entry_offset);
}

template <class T>
void set(Bytes& bytes, std::size_t offset, T value) {
  put(std::span(bytes), offset, value);
  mend_checksums(bytes);
}

}  // namespace copse::tampering
