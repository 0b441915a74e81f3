// .eco files: Ecosystem to bytes and back. docs/formats.md is the byte-level specification.
//
// A reader trusts nothing (Trust, tree_file.h): every count and index is checked before use. Raw sections are
// used in place, so that opening a million instances costs what checking them costs, and nothing with
// Trust::file.
#pragma once

#include "lib/formats/container/container.h"
#include "lib/formats/ecosystem/ecosystem.h"
#include "lib/formats/result.h"
#include "lib/formats/tree_file/tree_file.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace copse {

inline constexpr std::uint32_t k_max_tree_types = 1024;
inline constexpr std::uint32_t k_max_terrain_side = 32768;  // vertices

// The bytes of the file. Deterministic. Arrays that do not fit together are a bug of the caller and refused
// as such; elements are not checked (check_ecosystem does).
Result<std::vector<std::uint8_t>> encode_ecosystem(const Ecosystem& eco, Encoding encoding = Encoding::raw);

// on_demand: neither read nor checked when the file is loaded, so that of a mapped file only those pages are
// read whose instances are used; each block is then to be checked by is_sound_block (check_ecosystem.h)
// before it is. Compressed instances are loaded and checked at once, whatever is asked for.
enum class Instances : std::uint8_t { at_once, on_demand };

class EcosystemFile {
 public:
  // Maps the file; reads and checks header, section table and EHED: O(sections).
  static Result<EcosystemFile> open(const std::filesystem::path& path, Trust trust = Trust::nothing);
  static Result<EcosystemFile> from_bytes(std::vector<std::uint8_t> bytes, std::string name,
                                          Trust trust = Trust::nothing);

  Result<Ecosystem> load(Instances instances = Instances::at_once) const;
  const Container& container() const;

  // All checksums and all invariants, every failure; that the boxes of blocks and nodes contain what they
  // must, too, which loading does not check.
  std::vector<std::string> verify() const;

 private:
  struct Impl;
  explicit EcosystemFile(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}
  static Result<EcosystemFile> from_container(Container container, Trust trust);
  std::shared_ptr<const Impl> impl_;
};

// Every invariant of an ecosystem in memory: all that fail. Empty when it is sound.
std::vector<std::string> check_ecosystem(const Ecosystem& eco);

}  // namespace copse
