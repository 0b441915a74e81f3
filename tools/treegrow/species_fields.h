// Every parameter of a species by name: one table for writing, reading and checking them.
#pragma once

#include "tools/treegrow/species.h"

#include <string>
#include <variant>
#include <vector>

namespace copse::grow {

struct Number {
  double* value;
  double low, high;  // what makes sense; anything outside is refused
};
struct Colour {
  Float3* value;
};
struct Word {
  std::string* value;
};
// One of a list of names.
struct Choice {
  std::uint8_t* value;
  std::vector<const char*> names;
};

struct Field {
  const char* table;  // "" for the tree's own
  const char* name;
  std::variant<Number, Colour, Word, Choice> value;
  const char* meaning;
};

// The fields of `species`, in the order in which they are written, with places for all four levels; the
// species must outlive them and have four levels.
std::vector<Field> fields_of(Species& species);

inline constexpr const char* k_level_tables[] = {"level0", "level1", "level2", "level3"};

}  // namespace copse::grow
