// Instances as a CSV file:
// type,x,y,z,head,pitch,roll,scale,trunk_material,leaf_material,motion,red,green,blue.
#pragma once

#include "lib/formats/ecosystem/ecosystem.h"
#include "lib/formats/result.h"
#include "tools/ecogen/scene.h"

#include <string>
#include <string_view>

namespace copse::ecogen {

// In the order of the file; numbers round-trip, angles have nine digits.
std::string instances_csv(const Ecosystem& eco);

// Adds the rows to the types' instances by hand. Columns are found by their names; type, x and z must be
// there, an empty field counts as not given. Refused, with line and column: what is no number or no name in
// the scene.
Result<void> add_instances(std::string_view csv, const std::string& file, Scene& scene);

}  // namespace copse::ecogen
