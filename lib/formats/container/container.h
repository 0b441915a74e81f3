// The container of all copse files (.tree, .stree, .eco): a header, a table and 64-byte aligned sections.
// docs/formats.md gives the bytes.
//
// A reader trusts nothing. Opening reads the header and the table only, and checks both completely; a section
// is checked (its padding, its checksum, its compressed frame) when it is read. No byte of a file is
// don't-care: there is one place for every section, padding is zero, and nothing follows the last one.
//
// Memory that a file can make a reader reserve is bounded by its size: the decoded sizes of all sections
// together may not exceed k_free_decoded_bytes + k_max_expansion * (size of the file). A writer keeps to that
// by storing the most compressible sections raw when it must.
#pragma once

#include "lib/formats/array.h"
#include "lib/formats/pieces.h"
#include "lib/formats/result.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace copse {

inline constexpr std::uint32_t k_container_version = 1;
inline constexpr std::uint32_t k_max_sections = 4096;
inline constexpr std::uint64_t k_section_alignment = 64;
inline constexpr std::uint64_t k_max_expansion = 256;
inline constexpr std::uint64_t k_free_decoded_bytes = std::uint64_t{1} << 20;
inline constexpr int k_zstd_level = 3;  // higher levels gain little on floats and cost much

enum class FileKind : std::uint32_t { tree = 1, stree = 2, eco = 3 };

enum class Encoding : std::uint32_t { raw = 0, zstd = 1 };

struct SectionInfo {
  std::string name;  // four printable ASCII characters, unique in the file
  std::uint32_t version = 0;
  std::uint32_t stride = 1;  // bytes of an element; the decoded size is a multiple of it
  Encoding encoding = Encoding::raw;
  std::uint64_t offset = 0;       // in the file; a multiple of 64
  std::uint64_t stored_size = 0;  // bytes in the file
  std::uint64_t decoded_size = 0;
  std::uint64_t checksum = 0;  // XXH3-64 of the stored bytes
};

enum class Verify : std::uint8_t { no, yes };  // padding and checksum

class Container {
 public:
  static Result<Container> open(const std::filesystem::path& path);
  // The same over bytes in memory; `name` stands in messages.
  static Result<Container> from_bytes(std::vector<std::uint8_t> bytes, std::string name);

  const std::string& name() const { return name_; }
  FileKind kind() const { return kind_; }
  std::uint64_t size() const { return bytes_.size(); }
  const std::vector<SectionInfo>& sections() const { return sections_; }
  const SectionInfo* find(std::string_view section) const;  // null when there is none

  // The decoded bytes: in place when raw, otherwise decompressed. They live as long as the Array does.
  Result<Array<std::uint8_t>> read(const SectionInfo& section, Verify verify = Verify::yes) const;
  // The bytes as stored, unchecked: what a copy needs.
  Array<std::uint8_t> stored(const SectionInfo& section) const;
  // Checks the padding before the section and its checksum.
  Result<void> verify(const SectionInfo& section) const;

  // "section TTRI at offset 1234: what", as all errors of a container are worded.
  std::unexpected<Error> refuse_section(const SectionInfo& section, std::uint64_t offset_in_section,
                                        const std::string& what) const;

 private:
  static Result<Container> parse(std::span<const std::uint8_t> bytes, std::shared_ptr<const void> owner,
                                 std::string name);
  std::string name_;
  FileKind kind_ = FileKind::tree;
  std::vector<SectionInfo> sections_;
  std::span<const std::uint8_t> bytes_;
  std::shared_ptr<const void> owner_;
};

// Builds a file: from nothing, or from another file whose sections are copied as stored, known or not, with
// their checksums: damage in the source stays detectable in the copy.
class ContainerWriter {
 public:
  explicit ContainerWriter(FileKind kind) : kind_(kind) {}
  explicit ContainerWriter(const Container& source);

  // Adds the section at the end, or replaces the one of that name where it stands. With Encoding::zstd the
  // section is still stored raw when that is smaller.
  Result<void> put(std::string_view name, std::uint32_t version, std::uint32_t stride,
                   Array<std::uint8_t> decoded, Encoding encoding = Encoding::raw);
  void remove(std::string_view name);

  // The bytes of the file. Deterministic. Pieces share what was put: nothing is copied but header and table.
  Result<Pieces> pieces() const;
  Result<std::vector<std::uint8_t>> finish() const;

 private:
  struct Section {
    SectionInfo info;
    Array<std::uint8_t> bytes;  // as stored
  };
  FileKind kind_;
  std::vector<Section> sections_;
};

}  // namespace copse
