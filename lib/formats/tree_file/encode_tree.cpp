#include "lib/formats/little_endian.h"
#include "lib/formats/materials.h"
#include "lib/formats/tree/check_tree.h"
#include "lib/formats/tree/tree_sections.h"
#include "lib/formats/tree_file/tree_file.h"

#include <fmt/format.h>

namespace copse {
namespace {

std::vector<std::uint8_t> encode_omitted(const std::vector<Omitted>& omitted) {
  std::vector<std::uint8_t> bytes(omitted.size() * k_omitted_record);
  for (std::size_t i = 0; i < omitted.size(); ++i) {
    std::copy(omitted[i].name.begin(), omitted[i].name.end(),
              bytes.begin() + static_cast<std::ptrdiff_t>(i * k_omitted_record));
    put(std::span(bytes), i * k_omitted_record + k_omitted_bytes, omitted[i].bytes);
  }
  return bytes;
}

// Puts sections one after the other; what is empty has no section. The first error stays.
class Sections {
 public:
  Sections(FileKind kind, Encoding encoding) : writer_(kind), encoding_(encoding) {}

  void put(std::string_view name, std::uint32_t stride, Array<std::uint8_t> bytes) {
    if (!state_ || bytes.empty()) return;
    state_ = writer_.put(name, k_tree_section_version, stride, std::move(bytes), encoding_);
  }
  template <class T>
  void put_array(std::string_view name, const Array<T>& array) {
    put(name, sizeof(T), array.as_bytes());
  }
  // HEAD and OMIT stay raw: they are read whenever a file is opened.
  void put_raw(std::string_view name, std::uint32_t stride, std::vector<std::uint8_t> bytes) {
    if (!state_ || bytes.empty()) return;
    state_ = writer_.put(name, k_tree_section_version, stride, std::move(bytes), Encoding::raw);
  }
  Result<Pieces> finish() const {
    if (!state_) return std::unexpected(state_.error());
    return writer_.pieces();
  }

 private:
  ContainerWriter writer_;
  Encoding encoding_;
  Result<void> state_;
};

}  // namespace

Result<Pieces> encode_tree_pieces(const Tree& whole, const WriteOptions& options) {
  if (const auto wrong = check_sizes(whole); !wrong.empty()) {
    return fail(Fault::bug, "", "a tree that cannot be stored: " + wrong.front(), "report this");
  }
  auto reduced = leave_out(whole, options.omit);
  if (!reduced) return std::unexpected(reduced.error());
  const Tree& tree = reduced->tree;
  const Head head = head_of(tree);

  Sections sections(static_cast<FileKind>(tree.header.kind), options.encoding);
  sections.put_raw("HEAD", 1, encode_head(head));
  sections.put_raw("OMIT", k_omitted_record, encode_omitted(reduced->omitted));
  sections.put("PROV", 1, std::vector<std::uint8_t>(tree.provenance.begin(), tree.provenance.end()));
  EncodedMaterials materials = encode_materials(tree.materials);
  EncodedTextures textures = encode_textures(tree.textures);
  sections.put("MATL", k_material_record, std::move(materials.records));
  sections.put("MNAM", 1, std::move(materials.names));
  sections.put("TEXR", k_texture_record, std::move(textures.records));
  sections.put("TNAM", 1, std::move(textures.texts));
  for_each_array(tree, head, [&](std::string_view name, const auto& array, std::uint64_t size, Presence) {
    if (size > 0) sections.put_array(name, array);
  });
  sections.put("TDAT", 1, std::move(textures.images));
  return sections.finish();
}

Result<std::vector<std::uint8_t>> encode_tree(const Tree& tree, const WriteOptions& options) {
  const auto pieces = encode_tree_pieces(tree, options);
  if (!pieces) return std::unexpected(pieces.error());
  return pieces->joined();
}

}  // namespace copse
