// .tree and .stree files: Tree to bytes and back. docs/formats.md is the byte-level specification.
//
// A reader trusts nothing: every count, offset and index is checked before use; what is refused is named by
// its section and offset. Opening maps the file and reads the header and the section table only.
#pragma once

#include "lib/formats/container/container.h"
#include "lib/formats/result.h"
#include "lib/formats/tree/tree.h"
#include "lib/formats/tree/tree_header.h"
#include "lib/formats/tree_file/omit.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace copse {

// How much is checked before an array is handed out.
enum class Trust {
  nothing,    // checksums and every invariant: whatever is returned can be used without a further check
  checksums,  // sizes and checksums only: for files of one's own that may be damaged but not forged
  file,       // sizes only: nothing is read that is not asked for; for files that were verified before
};

struct WriteOptions {
  Encoding encoding = Encoding::raw;
  // Sections (four-character names, see omissible_sections()) left out on purpose, and with them what is
  // meaningless without them. The file lists them with what they saved, and treedump shows it.
  std::vector<std::string> omit = {};
};

// The bytes of the file. Deterministic: the same tree and options give the same bytes. A tree whose arrays do
// not fit together is a bug of the caller and refused as such; elements are not checked (check_tree.h does).
Result<std::vector<std::uint8_t>> encode_tree(const Tree& tree, const WriteOptions& options = {});
// The same without a copy of what is stored raw: the pieces share the tree's arrays.
Result<Pieces> encode_tree_pieces(const Tree& tree, const WriteOptions& options = {});

class TreeFile {
 public:
  // Maps the file; reads and checks the header and the section table: O(sections), not O(bytes).
  static Result<TreeFile> open(const std::filesystem::path& path, Trust trust = Trust::nothing);
  // The same over bytes in memory, for tests and fuzzers; `name` stands in messages.
  static Result<TreeFile> from_bytes(std::vector<std::uint8_t> bytes, std::string name,
                                     Trust trust = Trust::nothing);
  static Result<TreeFile> from_container(Container container, Trust trust = Trust::nothing);

  const TreeHeader& header() const;
  const std::vector<SectionInfo>& sections() const;  // as stored: PACK stands for those that it packs
  const TreeCounts& counts() const;                  // of elements, present or left out by choice
  const std::vector<std::string>& omitted() const;   // what the writer left out on purpose
  const std::vector<Omitted>& omissions() const;     // the same, with the bytes that it saved
  bool has(std::string_view section) const;
  std::uint64_t size() const;  // bytes of the file

  // Everything that is present (or only the named sections: the arrays of the others are empty); raw sections
  // are used in place, the rest decoded. Naming a known section that the file does not have is no error.
  Result<Tree> load() const;
  Result<Tree> load(const std::vector<std::string>& only) const;
  // The decoded bytes of any section, known to this version or not. An error when there is none.
  Result<Array<std::uint8_t>> section(std::string_view name) const;
  // The sections as stored, to copy them into a file with more of them (ContainerWriter).
  const Container& container() const;

  // All checksums and all invariants of digest 000 section 9 (treedump): every failure, not only the first.
  std::vector<std::string> verify() const;

 private:
  struct Impl;
  explicit TreeFile(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}
  Result<Tree> load_named(const std::vector<std::string>* only) const;
  std::shared_ptr<const Impl> impl_;
};

}  // namespace copse
