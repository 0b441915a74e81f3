#include "tools/treedump/eco_view.h"

#include "lib/formats/ecosystem/ecosystem_file.h"
#include "lib/formats/ecosystem/instance_codec.h"
#include "tools/treedump/dump.h"
#include "tools/treedump/json.h"
#include "tools/treedump/text.h"
#include "tools/treedump/views.h"

#include <algorithm>

#include <fmt/format.h>

namespace copse {
namespace {

struct Opened {
  EcosystemFile file;
  Ecosystem eco;
};

Result<Opened> open(const std::filesystem::path& path) {
  auto file = EcosystemFile::open(path);
  if (!file) return std::unexpected(file.error());
  auto eco = file->load();
  if (!eco) return std::unexpected(eco.error());
  return Opened{std::move(*file), std::move(*eco)};
}

std::string place_text(const TreeType& t) {
  return t.packed.empty() ? t.uri : fmt::format("packed, {}", bytes_text(t.packed.size()));
}

std::string types_text(const Ecosystem& e) {
  std::size_t widest = 4;
  for (const TreeType& t : e.types) widest = std::max(widest, t.name.size());
  std::string out = fmt::format("\n  {:<{}}  {:>12}  {:>15}  {:>10}  {}\n", "type", widest, "instances",
                                "scale", "view range", "tree");
  for (const TreeType& t : e.types)
    out += fmt::format("  {:<{}}  {:>12}  {:>15}  {:>10}  {}\n", t.name, widest, count_text(t.instances),
                       fmt::format("{:.3g} to {:.3g}", t.scale_min, t.scale_max),
                       t.view_range > 0 ? metres_text(double{t.view_range}) : "", place_text(t));
  return out;
}

void add_terrain(JsonText& json, const Ecosystem& e) {
  const Terrain& t = e.terrain;
  json.key("terrain");
  json.open_object();
  json.member("columns", t.columns);
  json.member("rows", t.rows);
  json.member("regular", t.regular());
  json.member("origin", t.origin);
  json.member("spacing_x", t.spacing_x);
  json.member("spacing_z", t.spacing_z);
  json.key("material");
  t.material == k_none ? json.null() : json.value(e.materials[t.material].name);
  json.close();
}

void add_types(JsonText& json, const Ecosystem& e) {
  json.key("types");
  json.open_list();
  for (const TreeType& t : e.types) {
    json.open_object(JsonText::in_line);
    json.member("name", t.name);
    json.member("tree", t.uri);
    json.member("packed_bytes", std::uint64_t{t.packed.size()});
    json.member("hash", fmt::format("xxh3:{:016x}", t.hash));
    json.member("instances", t.instances);
    json.member("scale_min", t.scale_min);
    json.member("scale_max", t.scale_max);
    json.member("view_range", t.view_range);
    json.member("bounds", t.bounds);
    json.member("volumes", std::uint64_t{t.volumes.size()});
    json.member("envelopes", std::uint64_t{t.envelopes.size()});
    json.close();
  }
  json.close();
}

void add_instances(JsonText& json, const Ecosystem& e) {
  json.key("instances");
  json.open_list();
  for (const InstanceBlock& b : e.blocks)
    for (std::size_t k = b.first; k < b.first + b.count; ++k) {
      const Instance i = instance_of(e, b, k);
      json.open_object(JsonText::in_line);
      json.member("type", i.type);
      json.member("position", i.position);
      json.key("rotation");
      json.open_list(JsonText::in_line);
      for (const double part : i.rotation) json.value(part);
      json.close();
      json.member("scale", i.scale);
      json.key("trunk_material");
      i.trunk_material == k_none ? json.null() : json.value(i.trunk_material);
      json.key("leaf_material");
      i.leaf_material == k_none ? json.null() : json.value(i.leaf_material);
      json.member("motion", i.motion);
      json.member("tint", std::array<std::uint32_t, 3>{i.tint[0], i.tint[1], i.tint[2]});
      json.close();
    }
  json.close();
}

}  // namespace

bool is_ecosystem(const std::filesystem::path& path) {
  const auto container = Container::open(path);
  return container && container->kind() == FileKind::eco;
}

Result<std::string> ecosystem_text(const std::filesystem::path& path) {
  const auto opened = open(path);
  if (!opened) return std::unexpected(opened.error());
  const Ecosystem& e = opened->eco;
  const Container& c = opened->file.container();
  const auto valid =
      std::count_if(e.boxes.begin(), e.boxes.end(), [](const QuadNode& n) { return !n.bounds.empty(); });
  std::string out = fmt::format("{}: {}, {} in {}\n\n", path.string(), kind_name(c.kind()),
                                bytes_text(c.size()), count_text(c.sections().size(), "section"));
  const Float3 size = e.bounds.extent();
  out += fmt::format("  {:<13}{:.4g} x {:.4g} x {:.4g} m\n", "size", size.x, size.y, size.z);
  out += fmt::format("  {:<13}{} x {} vertices, {}\n", "terrain", e.terrain.columns, e.terrain.rows,
                     e.terrain.regular() ? "a regular grid of heights" : "a free surface");
  out += fmt::format("  {:<13}{} of {} bytes, in {}\n", "instances", count_text(e.instance_count()),
                     e.exact.empty() ? 24 : 48, count_text(e.blocks.size(), "block"));
  out += fmt::format("  {:<13}depth {}, {} of {} boxes hold anything\n", "hierarchy", e.depth,
                     count_text(static_cast<std::uint64_t>(valid)), count_text(e.boxes.size()));
  out += fmt::format("  {:<13}positions {}, rotations {:.2g} degrees, scales {:.2g}, at most\n", "errors",
                     metres_text(double{e.position_error}), double{e.rotation_error} * 57.29577951308232,
                     e.scale_error);
  out += fmt::format("  {:<13}{}, {}\n", "materials", count_text(e.materials.size(), "material"),
                     count_text(e.textures.size(), "texture"));
  out += types_text(e);
  std::vector<SectionState> sections;
  for (const SectionInfo& info : c.sections()) sections.push_back({.info = info, .damage = {}});
  out += sections_text(sections, c.size());
  for (char& letter : out)
    if ((static_cast<unsigned char>(letter) < 0x20 && letter != '\n') || letter == 0x7f) letter = '?';
  return out;
}

Result<std::string> ecosystem_json(const std::filesystem::path& path, bool arrays) {
  const auto opened = open(path);
  if (!opened) return std::unexpected(opened.error());
  const Ecosystem& e = opened->eco;
  JsonText json;
  json.open_object();
  json.member("schema", "copse.dump/1");
  json.member("file", path.string());
  json.member("bytes", opened->file.container().size());
  json.member("kind", "eco");
  json.member("origin", e.origin);
  json.member("bounds", e.bounds);
  json.member("seed", e.seed);
  json.member("instance_count", std::uint64_t{e.instance_count()});
  json.member("instance_bytes", std::uint64_t{e.exact.empty() ? 24u : 48u});
  json.member("blocks", std::uint64_t{e.blocks.size()});
  json.member("hierarchy_depth", e.depth);
  json.member("position_error", e.position_error);
  json.member("rotation_error", e.rotation_error);
  json.member("scale_error", e.scale_error);
  add_terrain(json, e);
  add_types(json, e);
  json.key("materials");
  json.open_list(JsonText::in_line);
  for (const Material& m : e.materials) json.value(m.name);
  json.close();
  if (arrays) add_instances(json, e);
  json.close();
  return json.take();
}

}  // namespace copse
