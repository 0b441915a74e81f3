#include "lib/formats/ecosystem/ecosystem_file.h"
#include "lib/formats/ecosystem/ecosystem_header.h"
#include "lib/formats/ecosystem/ecosystem_sections.h"
#include "lib/formats/ecosystem/type_volumes.h"

#include <fmt/format.h>

namespace copse {
namespace {

template <class T>
Array<std::uint8_t> bytes_of(const Array<T>& array) {
  const auto owner = std::make_shared<Array<T>>(array);
  return {std::span(reinterpret_cast<const std::uint8_t*>(owner->data()), owner->size() * sizeof(T)), owner};
}

// What does not fit together, or nothing.
std::string misfit(const Ecosystem& eco) {
  const Terrain& t = eco.terrain;
  const std::size_t vertices = t.regular() ? t.heights.size() : t.points.size();
  if (vertices != t.vertex_count() || (!t.regular() && !t.heights.empty())) return "the terrain's vertices";
  if (!eco.packed.empty() && !eco.exact.empty()) return "instances of both kinds";
  if (eco.boxes.size() != (eco.blocks.empty() ? 0 : first_quad_node(eco.depth + 1)))
    return "the box hierarchy";
  if (!eco.block_hashes.empty() && eco.block_hashes.size() != eco.blocks.size()) return "hashes of blocks";
  if (eco.types.size() > k_max_tree_types) return "more types than a file may have";
  for (const TreeType& type : eco.types)
    if (type.uri.empty() == type.packed.empty()) return "a type is neither packed nor by reference, or both";
  return {};
}

}  // namespace

Result<std::vector<std::uint8_t>> encode_ecosystem(const Ecosystem& eco, Encoding encoding) {
  if (const std::string wrong = misfit(eco); !wrong.empty())
    return fail(Fault::bug, "", wrong, "report this");
  ContainerWriter writer(FileKind::eco);
  Result<void> state = writer.put("EHED", 1, 1, encode_ecosystem_head(eco));
  const auto put = [&](std::string_view name, std::size_t stride, Array<std::uint8_t> bytes) {
    if (state && !bytes.empty())
      state = writer.put(name, section_version(name), static_cast<std::uint32_t>(stride), std::move(bytes),
                         encoding);
  };
  put("PROV", 1, std::vector<std::uint8_t>(eco.provenance.begin(), eco.provenance.end()));
  auto materials = encode_materials(eco.materials);
  put("MATL", k_material_record, std::move(materials.records));
  put("MNAM", 1, std::move(materials.names));
  auto textures = encode_textures(eco.textures);
  put("TEXR", k_texture_record, std::move(textures.records));
  put("TNAM", 1, std::move(textures.texts));
  auto types = encode_types(eco.types);
  put("ETYP", k_type_record, std::move(types.records));
  put("ENAM", 1, std::move(types.texts));
  auto volumes = encode_type_volumes(eco.types);
  put("EVOL", k_type_volume_record, std::move(volumes.records));
  put("EVNM", sizeof(float), std::move(volumes.numbers));
  EcosystemCounts counts;
  for_each_array(eco, counts, [&]<class T>(std::string_view name, const Array<T>& array, std::uint64_t) {
    put(name, sizeof(T), bytes_of(array));
  });
  put("TDAT", 1, std::move(textures.images));
  // A packed tree is a file of its own, compressed or not as its own sections are.
  for (std::size_t i = 0; i < eco.types.size() && state; ++i)
    if (!eco.types[i].packed.empty()) state = writer.put(packed_section(i), 1, 1, eco.types[i].packed);
  if (!state) return std::unexpected(state.error());
  return writer.finish();
}

}  // namespace copse
