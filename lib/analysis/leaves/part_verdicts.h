// part_verdicts: what the user's patterns and the names say about each part of a mesh, before any shape is
// looked at.
#pragma once

#include "lib/analysis/leaves/classify.h"
#include "lib/analysis/leaves/name_words.h"
#include "lib/formats/mesh.h"
#include "lib/formats/result.h"

#include <cstdint>
#include <string>
#include <vector>

namespace copse {

// How far a verdict binds.
enum class Binding : std::uint8_t {
  none,   // nothing is said: shape decides
  weak,   // a word that is given to either ("branch", "crown"): shape decides where it is clear
  whole,  // a word for trunk or leaf, but the whole mesh bears it: shape may find the other class in it
  firm,   // a pattern, or a word for trunk or leaf that only a part of the mesh bears
};

struct PartVerdict {
  NameClass kind = NameClass::none;
  Binding binding = Binding::none;
  std::string reason{};  // "material 'Bark_NormalTree' says bark"; empty when nothing is said
  std::string grass{};   // "object 'grass' says grass": kept where the verdict is loosened; empty when not
};

// One a part of the mesh. A material's name counts before the group's, and that before the object's: the
// first that says anything. Errors: see classify().
Result<std::vector<PartVerdict>> part_verdicts(const Mesh& mesh, const ClassifyOptions& options);

// Lets words for leaves bind no further than if the whole mesh bore them; whether there were any. For
// verdicts of names alone, none of which says trunk.
bool loosen_leaf_names(std::vector<PartVerdict>& verdicts);

}  // namespace copse
