// Bytes as text, for what a page carries inside itself.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace copse {

std::string base64(std::span<const std::uint8_t> bytes);

}  // namespace copse
