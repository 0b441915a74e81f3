// Whether the tree that an ecosystem names is still the one that it was made with.
#pragma once

#include "lib/formats/ecosystem/ecosystem.h"

#include <filesystem>
#include <string>
#include <vector>

namespace copse {

// Compares the bytes of `tree`, the file of a type by reference, with TreeType::hash. Empty when they agree;
// otherwise what is wrong, with both hashes, or why the file cannot be read. Reads the file once.
std::string changed_tree(const TreeType& type, const std::filesystem::path& tree);

// The same of every type by reference of the ecosystem that lies in `folder`: a line each that names the
// file.
std::vector<std::string> changed_trees(const Ecosystem& eco, const std::filesystem::path& folder);

}  // namespace copse
