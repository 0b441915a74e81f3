// The textures of a page's materials: read, looked through, and named relative to the output or packed.
#pragma once

#include "tools/ecogen/build.h"

namespace copse::ecogen {

// Fills mean_colour and alpha_coverage of the ecosystem's materials and the names or bytes of its textures,
// whose `uri` is still the path of the file. Refused with the place in the page: what cannot be read.
Result<void> take_page_textures(const BuildOptions& options, Built& built, Context& context);

// `file` as it is named in an ecosystem in `folder`.
std::string relative_name(const std::filesystem::path& file, const std::filesystem::path& folder);

}  // namespace copse::ecogen
