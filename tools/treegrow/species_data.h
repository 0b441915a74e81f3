// The built-in species as they are in species/*.toml, put into the program by CMake.
#pragma once

#include <span>
#include <string_view>

namespace copse::grow {

struct SpeciesText {
  std::string_view name, toml;
};

std::span<const SpeciesText> species_texts();

}  // namespace copse::grow
