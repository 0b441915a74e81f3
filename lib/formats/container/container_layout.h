// The byte layout of the container's header and table, shared by its reader and its writer. docs/formats.md.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace copse::container_layout {

// As in PNG: the first byte catches 7-bit transfers, CR LF catches line-ending conversions.
inline constexpr std::array<std::uint8_t, 8> k_magic{0x89, 'C', 'O', 'P', 'S', 'E', '\r', '\n'};

inline constexpr std::size_t k_version = 8;
inline constexpr std::size_t k_kind = 12;
inline constexpr std::size_t k_section_count = 16;
inline constexpr std::size_t k_reserved0 = 20;  // 4 zero bytes
inline constexpr std::size_t k_file_size = 24;
inline constexpr std::size_t k_table_checksum = 32;
inline constexpr std::size_t k_reserved1 = 40;        // 16 zero bytes
inline constexpr std::size_t k_header_checksum = 56;  // of the 56 bytes before it
inline constexpr std::size_t k_header_size = 64;

inline constexpr std::size_t k_entry_name = 0;
inline constexpr std::size_t k_entry_version = 4;
inline constexpr std::size_t k_entry_encoding = 8;
inline constexpr std::size_t k_entry_stride = 12;
inline constexpr std::size_t k_entry_offset = 16;
inline constexpr std::size_t k_entry_stored = 24;
inline constexpr std::size_t k_entry_decoded = 32;
inline constexpr std::size_t k_entry_checksum = 40;
inline constexpr std::size_t k_entry_size = 48;

}  // namespace copse::container_layout
