// What stands beside a map: which colour is which type, how many there are, and how long a metre is.
#pragma once

#include "lib/formats/import/image.h"
#include "lib/formats/report.h"
#include "lib/formats/result.h"
#include "tools/ecogen/map_picture.h"

namespace copse::ecogen {

// The map with its legend on the right, for a PNG.
Image map_with_legend(ForestMap& map);

// The same for a page, with words that can be read at any size.
Result<ReportPicture> map_for_page(ForestMap& map);

}  // namespace copse::ecogen
