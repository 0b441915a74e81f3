// The bytes of an input file: memory-mapped, or inflated when they are gzipped.
#pragma once

#include "lib/formats/array.h"
#include "lib/formats/result.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace copse {

using Bytes = Array<std::uint8_t>;

// What a gzipped input may grow to: `k_inflate_floor`, or `k_inflate_ratio` times its stored size if that is
// more. Meshes shrink 3 to 15 times, deflate can do no more than 1032; a gzip bomb needs several hundred.
inline constexpr std::uint64_t k_inflate_floor = std::uint64_t{64} << 20;
inline constexpr std::uint64_t k_inflate_ratio = 200;
// Pipes and devices have no size to check beforehand.
inline constexpr std::uint64_t k_stream_limit = std::uint64_t{4} << 30;

// The whole file as stored. A regular file is mapped, anything else (a pipe) is read to its end.
Result<Bytes> open_bytes(const std::filesystem::path& path);

bool is_gzip(std::span<const std::uint8_t> bytes);

// Inflates every member of a gzip file. `name` is for messages.
Result<Bytes> inflate_gzip(std::span<const std::uint8_t> bytes, const std::string& name);

// `reference`, as written inside a file, as a path below the folder of that file: separators made portable,
// and refused (empty) when it is absolute or climbs out of the folder.
std::filesystem::path below(const std::filesystem::path& folder, const std::string& reference);

}  // namespace copse
