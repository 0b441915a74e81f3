// The parts of check_ecosystem (ecosystem_file.h): what a loader needs, and what only verification pays for.
#pragma once

#include "lib/formats/ecosystem/ecosystem.h"
#include "lib/formats/tree/check_tree.h"

namespace copse {

// Every index in range, every number finite, blocks without gaps: after this an ecosystem can be used.
// Precondition: arrays of the sizes that the head gives. Linear, at about the speed of memory.
void check_ecosystem_elements(const Ecosystem& eco, Findings& findings);

// The same without a look at any instance: after this every block is a range of instances that are there.
void check_ecosystem_frame(const Ecosystem& eco, Findings& findings);

// Of the bytes of its instances as they are stored. Precondition: they are there.
std::uint64_t hash_of_block(const Ecosystem& eco, const InstanceBlock& block);

// Whether the instances of one block can be used and, where the file has their hash, are those that were
// written. Precondition: check_ecosystem_frame found nothing.
bool is_sound_block(const Ecosystem& eco, std::uint32_t index);

// That boxes contain what they must, and that blocks lie in the leaf of the hierarchy that owns them: costs a
// transformed box an instance. Precondition: check_ecosystem_elements found nothing.
void check_ecosystem_boxes(const Ecosystem& eco, Findings& findings);

}  // namespace copse
