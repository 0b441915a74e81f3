// Everything that reads a .tree or .stree, over any bytes: for the fuzzer and the replay of its corpus.
#pragma once

#include "lib/formats/levels/foliage_cells.h"
#include "lib/formats/levels/impostors.h"
#include "lib/formats/levels/spectrum_file.h"
#include "lib/formats/tree/check_tree.h"
#include "lib/formats/tree_file/tree_file.h"
#include "lib/formats/tree_file/tree_volumes.h"
#include "tests/formats/tampering.h"

#include <string>
#include <vector>

namespace copse {

// What a tree may carry beside itself: refused, or fit for what a player does with it.
inline std::string read_additions(const TreeFile& file, Trust trust) {
  if (const auto volumes = load_volumes(file); volumes && trust == Trust::nothing) {
    if (const auto bytes = with_volumes(file.container(), *volumes); !bytes) return bytes.error().what;
  }
  if (const auto atlas = read_impostor(file); atlas && !atlas->empty()) {
    if (const std::string wrong = check_impostor(*atlas); !wrong.empty()) return wrong;
  }
  (void)read_foliage_cells(file);
  if (!has_spectra(file.container())) return "";
  const auto spectra = load_spectra(file.container(), file.counts().radii, file.counts().materials);
  if (!spectra) return "";
  for (const Spectrum* s : {&spectra->trunk, &spectra->leaves})
    for (const auto& triangle : s->triangles)
      for (const std::uint32_t v : triangle)
        if (v >= s->vertices.size()) return "a spectrum's triangle has no such vertex";
  return "";
}

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
    if (!tree) continue;
    if (std::string wrong = read_additions(*file, trust); !wrong.empty()) return wrong;
    if (trust != Trust::nothing) continue;
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
