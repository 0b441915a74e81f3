// How exactly a recovered hierarchy is the true one, ring by ring.
#pragma once

#include "lib/analysis/rings/hierarchy.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace copse {

struct TrueRadius {
  Double3 centre;
  double diameter = 0;
  bool tip = false;  // a point: may be found, need not be
  std::vector<std::uint32_t>
      parents;  // any of them is right: both ends of the segment that it leaves; none: a root
  std::uint32_t same_as = k_none;  // an earlier ring in the same place
};

struct TrueHierarchy {
  double height = 0;
  std::vector<TrueRadius> radii;
};

struct Exactness {
  std::size_t rings = 0;          // to be found
  std::size_t found = 0;          // within 1e-4 of the height, with a diameter within 0.1 %
  std::size_t parents_right = 0;  // of those: the parent found is a true parent, or both are roots
  std::size_t extra = 0;          // radii that are nowhere in the truth, points apart
  std::size_t roots = 0, true_roots = 0;
  std::string first_fault;
  bool exact() const { return found == rings && parents_right == rings && extra == 0 && roots == true_roots; }
};

Exactness measure(const TrueHierarchy& truth, const Hierarchy& found);

// truth/NAME.json.gz beside the shared trees; nothing where it is not there.
std::optional<TrueHierarchy> read_truth(const std::filesystem::path& file);

}  // namespace copse
