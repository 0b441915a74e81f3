#include "tools/lodbake/packing.h"

#include "lib/formats/levels/spectrum_leaves.h"

#include <string>
#include <vector>

#include <fmt/format.h>

namespace copse::lodbake {

Result<std::optional<PackedTree>> pack_base(const Options& options, const TreeFile& file, Tree& tree,
                                            Context& context) {
  if (options.coding.coding != SpectrumCoding::small || file.container().find("PACK")) return std::nullopt;
  if (const std::string why = why_unpackable(tree); !why.empty()) {
    context.warn(fmt::format("{}: the tree itself is not packed: {}; its sections are compressed as they are",
                             options.input.string(), why));
    return std::nullopt;
  }
  Stage stage = context.stage("pack");
  stage.items(tree.trunk.triangles.size() + tree.leaves.triangles.size(), "triangles");
  auto packed = pack_tree(
      tree, {.position_bits = options.coding.position_bits, .texcoord_bits = options.coding.texcoord_bits});
  if (!packed) {
    packed.error().file = options.input.string();
    return std::unexpected(packed.error());
  }
  tree = packed->tree;
  return std::move(*packed);
}

Result<void> number_leaves(const Spectrum& leaves, std::optional<PackedTree>& packed, Tree& tree) {
  if (!packed || leaves.method != LodMethod::collapse || leaves.elements.empty()) return {};
  const std::vector<std::uint32_t> order = spectrum_leaves::leaf_order(leaves, tree);
  if (order.empty()) return {};
  auto again = renumbered(*packed, order);
  if (!again) return std::unexpected(again.error());
  packed = std::move(*again);
  tree = packed->tree;
  return {};
}

Result<void> write_base(const Options& options, const TreeFile& file, const std::optional<PackedTree>& packed,
                        ContainerWriter& writer, Context& context) {
  if (packed) {
    std::string gone;
    for (const char* name :
         {"VSET", "VOLU", "VNUM", "VNOD", "FCEL", "FORD", "FVWS", "FVTR", "FVIS", "FPAR"}) {
      if (!file.container().find(name)) continue;
      gone += (gone.empty() ? "" : ", ") + std::string(name);
      writer.remove(name);
    }
    if (!gone.empty())
      context.warn(fmt::format("{}: {} are of the tree before it was packed and are left out; fit them again",
                               options.input.string(), gone));
    const auto tell = [&](const char* name, double error) {
      context.report().errors.push_back({name, error, "m", error, {}, {}, "the tree before packing"});
    };
    tell("packing of the trunk, largest", packed->trunk_error);
    tell("packing of the leaves, largest", packed->leaf_error);
    if (auto done = compress_records(writer, file.container()); !done) return done;
    return put_packed(writer, *packed);
  }
  if (options.coding.coding != SpectrumCoding::small) return {};
  for (const SectionInfo& s : file.container().sections()) {
    if (s.encoding != Encoding::raw || s.name == "HEAD" || s.name == "OMIT" || s.name == "PACK") continue;
    auto bytes = file.container().read(s);
    if (!bytes) return std::unexpected(bytes.error());
    if (auto done = writer.put(s.name, s.version, s.stride, *bytes, Encoding::zstd); !done) return done;
  }
  return {};
}

void tell_streams(const std::vector<std::pair<const char*, std::vector<StreamCost>>>& sections,
                  Context& context) {
  Table table{.name = "streams",
              .columns = {"Section", "Stream", "Values", "Coded bytes", "Bits a value"},
              .rows = {}};
  for (const auto& [section, streams] : sections)
    for (const StreamCost& s : streams)
      if (s.values > 0)
        table.rows.push_back({section, s.name, std::to_string(s.values), fmt::format("{:.0f}", s.bits / 8),
                              fmt::format("{:.2f}", s.bits / static_cast<double>(s.values))});
  if (!table.rows.empty()) context.report().tables.push_back(std::move(table));
}

}  // namespace copse::lodbake
