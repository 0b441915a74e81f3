// Everything that reads an .eco, over any bytes: for the fuzzer, its corpus and mutants of it.
#pragma once

#include "lib/formats/ecosystem/check_ecosystem.h"
#include "lib/formats/ecosystem/ecosystem_file.h"
#include "lib/formats/ecosystem/instance_bounds.h"
#include "lib/formats/ecosystem/instance_codec.h"
#include "tests/formats/tampering.h"

#include <string>
#include <vector>

namespace copse {

// What is unsound about what a reader was given to use without a further check; "" when nothing is.
// `checked`: its instances are, too; otherwise those of blocks that pass their own check are used.
inline std::string use_everything(const Ecosystem& eco, bool checked) {
  for (std::uint32_t index = 0; index < eco.blocks.size(); ++index) {
    const InstanceBlock& b = eco.blocks[index];
    if (checked && !is_sound_block(eco, index)) return "a block is damaged that was checked";
    if (!is_sound_block(eco, index)) continue;
    for (std::size_t k = b.first; k < b.first + b.count; ++k) {
      const Instance i = instance_of(eco, b, k);
      double square = 0;
      for (const double part : i.rotation) square += part * part;
      if (!is_finite(i.position) || !(i.scale > 0) || !(std::abs(square - 1) < 1e-4))
        return "an instance is none";
      for (const std::uint32_t m : {i.trunk_material, i.leaf_material})
        if (m != k_none && m >= eco.materials.size()) return "a material is out of range";
      (void)instance_bounds(eco.types[i.type], i);
    }
  }
  for (std::uint32_t r = 0; r < eco.terrain.rows; ++r)
    for (std::uint32_t c = 0; c < eco.terrain.columns; ++c)
      if (!is_finite(eco.terrain.vertex(c, r))) return "a vertex of the terrain is not finite";
  for (const Array<BlockNode>* tree : {&eco.kd_tree, &eco.rtree})
    for (std::uint32_t n = 0; n < tree->size(); n = (*tree)[n].skip)
      if ((*tree)[n].skip <= n) return "a tree over the blocks runs in circles";
  for (const QuadNode& n : eco.boxes)
    if (std::uint64_t{n.first_block} + n.block_count > eco.blocks.size())
      return "blocks of a node are out of range";
  return "";
}

inline std::string read_ecosystem_as_it_is(const std::vector<std::uint8_t>& bytes) {
  for (const Trust trust : {Trust::nothing, Trust::file}) {
    const auto file = EcosystemFile::from_bytes(bytes, "bytes", trust);
    if (!file) continue;
    (void)file->verify();
    const auto eco = file->load(), on_demand = file->load(Instances::on_demand);
    if (trust != Trust::nothing) continue;
    if (eco && !on_demand) return "it loads, but not with its instances on demand";
    if (on_demand)
      if (std::string wrong = use_everything(*on_demand, false); !wrong.empty()) return "on demand: " + wrong;
    if (!eco) continue;
    if (std::string wrong = use_everything(*eco, true); !wrong.empty()) return wrong;
    const auto again = encode_ecosystem(*eco);
    if (!again) {
      // A reader takes a type that has neither name nor bytes; a writer has no reason to.
      if (again.error().what.find("neither packed nor by reference") != std::string::npos) continue;
      return again.error().what;
    }
    const auto back = EcosystemFile::from_bytes(*again, "again");
    if (!back) return back.error().what;
    if (const auto loaded = back->load(); !loaded) return loaded.error().what;
  }
  return "";
}

// "" when all is well: the bytes are refused, or what loads without trust is sound, can be written, and comes
// back. Once as they are, once with all checksums put right, which opens the way past them.
inline std::string read_ecosystem(std::vector<std::uint8_t> bytes) {
  if (std::string wrong = read_ecosystem_as_it_is(bytes); !wrong.empty()) return wrong;
  tampering::mend_checksums(bytes);
  return read_ecosystem_as_it_is(bytes);
}

}  // namespace copse
