// The parts of check_ecosystem (ecosystem_file.h): what a loader needs, and what only verification pays for.
#pragma once

#include "lib/formats/check_tree.h"
#include "lib/formats/ecosystem.h"

namespace copse {

// Every index in range, every number finite, blocks without gaps: after this an ecosystem can be used.
// Precondition: arrays of the sizes that the head gives. Linear, at about the speed of memory.
void check_ecosystem_elements(const Ecosystem& eco, Findings& findings);

// That boxes contain what they must, and that blocks lie in the leaf of the hierarchy that owns them: costs a
// transformed box an instance. Precondition: check_ecosystem_elements found nothing.
void check_ecosystem_boxes(const Ecosystem& eco, Findings& findings);

}  // namespace copse
