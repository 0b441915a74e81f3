// Where a tree comes from: kept in the file as JSON, without paths or times, so that the bytes do not depend
// on the machine.
#pragma once

#include "lib/formats/report.h"
#include "tools/treeprep/options.h"

#include <string>
#include <vector>

namespace copse::treeprep {

// {"tool","version","sources":[{"name","bytes","hash"}],"options":{...}}: options that differ from their
// defaults.
Result<std::string> provenance(const Options& options, std::uint64_t seed);

}  // namespace copse::treeprep
