// What stands beside a map: which colour is which type, how many there are, and how long a metre is.
#pragma once

#include "lib/formats/ecosystem/ecosystem.h"
#include "lib/formats/import/image.h"
#include "lib/formats/report.h"
#include "lib/formats/result.h"

namespace copse::ecogen {

// The map with its legend on the right, for a PNG.
Image map_with_legend(const Ecosystem& eco);

// The same for a page, with words that can be read at any size.
Result<ReportPicture> map_for_page(const Ecosystem& eco);

}  // namespace copse::ecogen
