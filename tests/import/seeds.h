// Small meshes that use much of each format: what mutants and the fuzzers' corpora start from.
#pragma once

#include "lib/formats/import/import.h"

#include <string>
#include <vector>

namespace copse::testing {

std::vector<std::string> seeds_of(MeshFormat format);

}  // namespace copse::testing
