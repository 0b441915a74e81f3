#include "tools/ecogen/leave_out.h"

#include "lib/formats/ecosystem/ecosystem_header.h"
#include "lib/formats/import/image.h"
#include "lib/formats/materials.h"
#include "lib/runtime/block_stream.h"
#include "tools/ecogen/pack_tree.h"
#include "tools/ecogen/page_textures.h"

#include <algorithm>
#include <limits>
#include <system_error>

#include <fmt/format.h>

namespace copse::ecogen {
namespace {

namespace fs = std::filesystem;

std::uint64_t size_of(const fs::path& file) {
  std::error_code error;
  const auto size = fs::file_size(file, error);
  return error ? 0 : size;
}

// New numbers of what is kept, none for what goes; `elements` keeps the rest in order.
template <class T>
std::vector<std::uint32_t> keep(std::vector<T>& elements, const std::vector<bool>& used) {
  std::vector<std::uint32_t> number(elements.size(), k_none);
  std::vector<T> kept;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    if (!used[i]) continue;
    number[i] = static_cast<std::uint32_t>(kept.size());
    kept.push_back(std::move(elements[i]));
  }
  elements = std::move(kept);
  return number;
}

void mark(std::vector<bool>& used, std::uint32_t index) {
  if (index != k_none) used[index] = true;
}

// A file that would have been named would be read by the player; a packed one is in the ecosystem's file.
LeftOut without_file(std::string what, std::string why, std::uint64_t record, std::uint64_t file, bool pack) {
  return {std::move(what), std::move(why), record + (pack ? file : 0), pack ? 0 : file};
}

void drop_types(std::vector<Instance>& instances, bool pack, Built& built) {
  std::vector<bool> used(built.eco.types.size());
  for (const Instance& i : instances) used[i.type] = true;
  for (std::size_t t = 0; t < used.size(); ++t) {
    const TreeType& type = built.eco.types[t];
    if (!used[t])
      built.left_out.push_back(without_file(fmt::format("type '{}'", type.name), "it has no instances",
                                            k_type_record + type.name.size(), size_of(type.uri), pack));
  }
  keep(built.farthest, used);
  const auto number = keep(built.eco.types, used);
  for (Instance& i : instances) i.type = number[i.type];
}

void drop_materials(std::vector<Instance>& instances, Built& built) {
  Ecosystem& e = built.eco;
  std::vector<bool> used(e.materials.size());
  mark(used, e.terrain.material);
  for (const Instance& i : instances) mark(used, i.trunk_material), mark(used, i.leaf_material);
  for (std::size_t m = 0; m < used.size(); ++m)
    if (!used[m])
      built.left_out.push_back({fmt::format("material '{}'", e.materials[m].name), "nothing is made of it",
                                k_material_record + e.materials[m].name.size()});
  const auto number = keep(e.materials, used);
  const auto renumber = [&](std::uint32_t& m) {
    if (m != k_none) m = number[m];
  };
  renumber(e.terrain.material);
  for (Instance& i : instances) renumber(i.trunk_material), renumber(i.leaf_material);
}

// What nobody needs is no reason to refuse the page; a name that is wrong is still worth a word.
void warn_of_unreadable(const fs::path& texture, const std::string& place, Context& context) {
  if (const auto image = read_image(texture); !image)
    context.warn(fmt::format("{}: {}: {}; it was left out, because nothing is made of its material",
                             texture.string(), place, image.error().what));
  std::error_code ignored;
  if (fs::is_regular_file(texture, ignored)) context.read(texture, false);
}

void drop_textures(bool pack, Built& built, Context& context) {
  Ecosystem& e = built.eco;
  std::vector<bool> used(e.textures.size());
  for (const Material& m : e.materials) mark(used, m.texture);
  for (std::size_t t = 0; t < used.size(); ++t) {
    if (used[t]) continue;
    warn_of_unreadable(e.textures[t].uri, built.texture_places[t], context);
    built.left_out.push_back(without_file(fmt::format("texture {}", e.textures[t].uri),
                                          "no material that is used has it", k_texture_record,
                                          size_of(e.textures[t].uri), pack));
  }
  keep(built.texture_places, used);
  const auto number = keep(e.textures, used);
  for (Material& m : e.materials)
    if (m.texture != k_none) m.texture = number[m.texture];
}

// What the instances ask of each type.
std::vector<TreeUse> uses_of(const std::vector<Instance>& instances, const Built& built) {
  std::vector<TreeUse> uses(built.eco.types.size());
  std::vector<double> smallest(uses.size(), std::numeric_limits<double>::infinity());
  for (const Instance& i : instances) {
    TreeUse& use = uses[i.type];
    use.own_trunk_material |= i.trunk_material == k_none;
    use.own_leaf_material |= i.leaf_material == k_none;
    (i.motion == 0 ? use.stands : use.moves) = true;
    smallest[i.type] = std::min(smallest[i.type], i.scale);
  }
  // A tree of half the size looks at 10 m as the tree itself does at 20 m. Its level goes by the distance of
  // its foot, but it is shown as long as any of it is near enough.
  for (std::size_t t = 0; t < uses.size(); ++t)
    uses[t].farthest = built.farthest[t] / smallest[t] + reach_from_foot(built.eco.types[t]);
  return uses;
}

// Those of a type that bound no instance; what sways out of its box would vanish while it is seen (E26).
void drop_volumes(const std::vector<TreeUse>& uses, Built& built, Context& context) {
  for (std::size_t t = 0; t < uses.size(); ++t) {
    TreeType& type = built.eco.types[t];
    if (uses[t].moves && type.envelopes.empty())
      context.warn(
          fmt::format("type '{}' moves, but '{}' has no envelope of its motion, so its boxes are those "
                      "of trees at rest; bvfit --sway makes one",
                      type.name, type.uri));
    if (!uses[t].moves) type.envelopes.clear();
    if (!uses[t].stands && !type.envelopes.empty()) type.volumes.clear();
  }
}

// By name, relative to the output's folder, or packed.
Result<void> resolve_trees(const std::vector<TreeUse>& uses, const BuildOptions& options, Built& built,
                           Context& context) {
  for (std::size_t t = 0; t < uses.size(); ++t) {
    TreeType& type = built.eco.types[t];
    if (options.pack) {
      auto bytes = pack_tree(type.uri, uses[t], built.left_out, context);
      if (!bytes) return std::unexpected(bytes.error());
      type.packed = std::move(*bytes);
      type.uri.clear();
    } else {
      type.uri = relative_name(type.uri, options.folder);
    }
  }
  return {};
}

}  // namespace

Result<void> leave_out(std::vector<Instance>& instances, const BuildOptions& options, Built& built,
                       Context& context) {
  drop_types(instances, options.pack, built);
  drop_materials(instances, built);
  drop_textures(options.pack, built, context);
  const std::vector<TreeUse> uses = uses_of(instances, built);
  drop_volumes(uses, built, context);
  if (auto done = resolve_trees(uses, options, built, context); !done) return done;
  return take_page_textures(options, built, context);
}

}  // namespace copse::ecogen
