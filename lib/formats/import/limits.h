// Every built-in limit of the importer, for the tools' --limits.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace copse {

struct ImportLimit {
  std::string name;
  std::uint64_t value = 0;
  std::string unit;
};

// In the order in which docs/import.md lists them.
std::vector<ImportLimit> import_limits();

}  // namespace copse
