// --encode small for the tree itself: its own sections are packed into one (lib/formats/tree_pack.h), and the
// spectra are those of the tree as it will be read.
#pragma once

#include "lib/formats/tree_file.h"
#include "lib/formats/tree_pack.h"
#include "tools/common/context.h"
#include "tools/lodbake/options.h"

#include <optional>

namespace copse::lodbake {

// Packs `tree` and puts what it becomes in its place. Nothing happens with --encode fast, nor when the file
// is packed already; a tree that cannot be packed is left as it is, with a warning that says why.
Result<std::optional<PackedTree>> pack_base(const Options& options, const TreeFile& file, Tree& tree,
                                            Context& context);

// Puts the packed tree in place of the file's own sections, and leaves out what was measured on the tree as
// it was: bounding volumes, foliage cells. With --encode small, what could not be packed is compressed.
Result<void> write_base(const Options& options, const TreeFile& file, const std::optional<PackedTree>& packed,
                        ContainerWriter& writer, Context& context);

}  // namespace copse::lodbake
