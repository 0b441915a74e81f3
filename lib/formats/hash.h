// XXH3-64: the checksum of sections, and how reports name the contents of a file. Not cryptographic: it finds
// damage, not forgery.
#pragma once

#include "lib/formats/pieces.h"
#include "lib/formats/report.h"
#include "lib/formats/result.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace copse {

// XXH3-64 with seed 0.
std::uint64_t xxh3(std::span<const std::uint8_t> bytes);
std::uint64_t xxh3(std::string_view bytes);

// "xxh3:" and the hash in 16 lower-case hexadecimal digits.
std::string hash_text(std::uint64_t hash);
std::string hash_of(std::span<const std::uint8_t> bytes);
std::string hash_of(std::string_view bytes);
std::string hash_of(const Pieces& pieces);  // of all of them as one

// Path, size and hash of a file, read once from front to back in bounded memory. What can be read only once,
// a pipe or a device, is left to who reads it: its size is 0 and its hash empty.
Result<FileRecord> hash_file(const std::filesystem::path& path);

}  // namespace copse
