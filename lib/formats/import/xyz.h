// Point files: a point a line, three numbers first.
#pragma once

#include "lib/formats/result.h"
#include "lib/formats/vec.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace copse {

// x y z, apart by blanks, commas or semicolons; what follows on the line (colours, normals) is passed over,
// as are empty lines and those that begin with # or //. Gzipped or not. In double, as written. Refused, with
// the line: fewer than three numbers, words, numbers that are not finite or too large for a double.
Result<std::vector<Double3>> read_xyz(const std::filesystem::path& path);
Result<std::vector<Double3>> read_xyz(std::span<const std::uint8_t> bytes, const std::string& name);

}  // namespace copse
