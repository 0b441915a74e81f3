// --encode small for the tree itself: its own sections are packed into one
// (lib/formats/tree_file/tree_pack.h), and the spectra are those of the tree as it will be read.
#pragma once

#include "lib/formats/tree_file/tree_file.h"
#include "lib/formats/tree_file/tree_pack.h"
#include "tools/common/context.h"
#include "tools/lodbake/options.h"

#include <optional>
#include <utility>
#include <vector>

namespace copse::lodbake {

// Packs `tree` and puts what it becomes in its place. Nothing happens with --encode fast, nor when the file
// is packed already; a tree that cannot be packed is left as it is, with a warning that says why.
Result<std::optional<PackedTree>> pack_base(const Options& options, const TreeFile& file, Tree& tree,
                                            Context& context);

// The packed tree with its leaves numbered as their spectrum takes them away, so that the spectrum needs no
// numbers; `tree` becomes that. Nothing happens where nothing is packed, or leaves do not collapse.
Result<void> number_leaves(const Spectrum& leaves, std::optional<PackedTree>& packed, Tree& tree);

// Puts the packed tree in place of the file's own sections, and leaves out what was measured on the tree as
// it was: bounding volumes, foliage cells. With --encode small, what could not be packed is compressed.
Result<void> write_base(const Options& options, const TreeFile& file, const std::optional<PackedTree>& packed,
                        ContainerWriter& writer, Context& context);

// Table `streams` of the report: what each stream of these sections takes.
void tell_streams(const std::vector<std::pair<const char*, std::vector<StreamCost>>>& sections,
                  Context& context);

}  // namespace copse::lodbake
