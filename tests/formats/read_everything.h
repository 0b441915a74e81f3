// Everything that reads a .tree or .stree, over any bytes: for the fuzzer and the replay of its corpus.
#pragma once

#include "lib/formats/tree_file.h"
#include "tests/formats/tampering.h"

#include <string>
#include <vector>

namespace copse {

// "" when all is well: the bytes are refused, or what loads without trust is sound, can be written, and comes
// back.
inline std::string read_as_they_are(const std::vector<std::uint8_t>& bytes) {
  if (const auto container = Container::from_bytes(bytes, "bytes")) {
    for (const SectionInfo& s : container->sections()) (void)container->read(s);
  }
  for (const Trust trust : {Trust::nothing, Trust::file}) {
    const auto file = TreeFile::from_bytes(bytes, "bytes", trust);
    if (!file) continue;
    const auto failures = file->verify();
    const auto tree = file->load();
    if (trust != Trust::nothing || !tree) continue;
    (void)trunk_vertices(*tree);
    if (const auto wrong = check_tree(*tree); !wrong.empty()) return wrong.front();
    const auto again = encode_tree(*tree);
    if (!again) return again.error().what;
    const auto back = TreeFile::from_bytes(*again, "again");
    if (!back) return back.error().what;
    if (const auto loaded = back->load(); !loaded) return loaded.error().what;
  }
  return "";
}

// The same once more with all checksums put right, which opens the way past them.
inline std::string read_everything(std::vector<std::uint8_t> bytes) {
  if (std::string wrong = read_as_they_are(bytes); !wrong.empty()) return wrong;
  tampering::mend_checksums(bytes);
  return read_as_they_are(bytes);
}

}  // namespace copse
