// Leaving out sections that a scene does not need: the tree without them, sound in itself, and what it saved.
#pragma once

#include "lib/formats/result.h"
#include "lib/formats/tree/tree.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace copse {

// A section that was left out on purpose, and the bytes (decoded) that this saved.
struct Omitted {
  std::string name;
  std::uint64_t bytes = 0;
  friend bool operator==(const Omitted&, const Omitted&) = default;
};

// The sections that may be left out, in file order, with one line each on what goes with them: for --help and
// messages.
struct Omissible {
  std::string_view name;
  std::string_view what;  // "normals of the trunk"
  std::string_view also;  // what is meaningless without it and so goes too: "TTEX TNRM"
};
const std::vector<Omissible>& omissible_sections();

struct Reduced {
  Tree tree;
  std::vector<Omitted> omitted;  // in file order
};

// `tree` without the named sections and without what is meaningless without them. References into what is
// gone become k_none (a corner's normal, a material's texture, a terminal radius's group, ...), constants
// that divide it (ring size, factors) become 0: the result is what a tree that never had them would be. A
// section that is empty anyway is listed with 0 bytes. Arrays that remain are shared, not copied.
Result<Reduced> leave_out(const Tree& tree, const std::vector<std::string>& names);

}  // namespace copse
