#include "lib/formats/tree/tree_sections.h"
#include "lib/formats/tree_file/tree_volumes.h"
#include "tools/treedump/element.h"
#include "tools/treedump/json.h"
#include "tools/treedump/levels_view.h"
#include "tools/treedump/views.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace copse {
namespace {

template <class T>
void add_fields(JsonText& json, const T& object) {
  each_field(object, [&](const char* name, const auto& value) { json.member(name, value); });
}

void add_header(JsonText& json, const TreeFile& file) {
  const TreeHeader& h = file.header();
  json.key("header");
  json.open_object();
  json.member("kind", h.kind == TreeKind::sensitive ? "stree" : "tree");
  json.member("origin", h.origin);
  json.member("bounds", h.bounds);
  json.member("trunk_bounds", h.trunk_bounds);
  json.member("area_density_centre", h.area_density_centre);
  json.member("mean_trunk_area", h.mean_trunk_area);
  json.member("mean_leaf_area", h.mean_leaf_area);
  json.member("roots", h.roots);
  json.member("ring_size", h.ring_size);
  json.member("segment_factor", h.segment_factor);
  json.member("leaf_factor", h.leaf_factor);
  json.member("unexplained", h.unexplained);
  json.member("leaf_order", h.leaf_order == LeafOrder::group      ? "group"
                            : h.leaf_order == LeafOrder::terminal ? "terminal"
                                                                  : "random");
  json.member("monotone", h.monotone);
  json.close();
}

void add_counts(JsonText& json, const TreeCounts& c) {
  json.key("counts");
  json.open_object();
  json.member("trunk_triangles", c.trunk_triangles);
  json.member("trunk_vertices", c.trunk_vertices);
  json.member("trunk_normals", c.trunk_normals);
  json.member("trunk_texcoords", c.trunk_texcoords);
  json.member("segments", c.segments);
  json.member("line_vertices", c.line_vertices);
  json.member("leaf_triangles", c.leaf_triangles);
  json.member("leaves", c.leaves);
  json.member("leaf_vertices", c.leaf_vertices);
  json.member("leaf_normals", c.leaf_normals);
  json.member("leaf_texcoords", c.leaf_texcoords);
  json.member("groups", c.groups);
  json.member("group_nodes", c.group_nodes);
  json.member("radii", c.radii);
  json.member("materials", c.materials);
  json.member("textures", c.textures);
  json.close();
}

void add_materials(JsonText& json, const Tree& tree) {
  json.key("materials");
  json.open_list();
  for (const Material& m : tree.materials) {
    json.open_object(JsonText::in_line);
    json.member("name", m.name);
    each_field(m, [&](std::string_view name, const auto& value) {
      json.key(name);
      if (name == "double_sided") return json.value(m.double_sided);
      if (name == "texture" && m.texture == k_none) return json.null();
      json.value(value);
    });
    json.close();
  }
  json.close();
  json.key("textures");
  json.open_list();
  for (const Texture& t : tree.textures) {
    json.open_object(JsonText::in_line);
    json.member("uri", t.uri);
    json.member("mime", t.mime);
    json.member("embedded_bytes", std::uint64_t{t.bytes.size()});
    json.close();
  }
  json.close();
}

void add_provenance(JsonText& json, const std::string& provenance) {
  json.key("provenance");
  const auto parsed = nlohmann::ordered_json::parse(provenance, nullptr, false);
  if (parsed.is_discarded()) {
    json.value(provenance);
  } else {
    json.raw(parsed.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
  }
}

void add_sections(JsonText& json, const Dump& dump) {
  json.key("sections");
  json.open_list();
  for (const SectionState& s : dump.sections) {
    json.open_object(JsonText::in_line);
    json.member("name", s.info.name);
    json.member("what", describe_section(s.info.name));
    json.member("version", s.info.version);
    json.member("encoding", encoding_name(s.info.encoding));
    json.member("offset", s.info.offset);
    json.member("bytes", s.info.stored_size);
    json.member("decoded_bytes", s.info.decoded_size);
    json.member("element_bytes", s.info.stride);
    json.member("checksum", fmt::format("xxh3:{:016x}", s.info.checksum));
    if (!s.damage.empty()) json.member("damage", s.damage);
    json.close();
  }
  json.close();
}

void add_omissions(JsonText& json, const TreeFile& file) {
  json.key("left_out");
  json.open_list();
  for (const Omitted& omitted : file.omissions()) {
    json.open_object(JsonText::in_line);
    json.member("name", omitted.name);
    json.member("what", describe_section(omitted.name));
    json.member("saved_bytes", omitted.bytes);
    json.close();
  }
  json.close();
}

// A plain element stands for itself, a record becomes an object.
template <class T>
void add_element(JsonText& json, const T& element) {
  if constexpr (std::is_same_v<T, CornerTriangle> || std::is_same_v<T, Radius> ||
                std::is_same_v<T, LeafGroup> || std::is_same_v<T, GroupNode>) {
    json.open_object(JsonText::in_line);
    add_fields(json, element);
    json.close();
  } else {
    json.value(element);
  }
}

void add_arrays(JsonText& json, const Dump& dump) {
  json.key("arrays");
  json.open_object();
  const Head head{.header = dump.file->header(), .counts = dump.file->counts()};
  for_each_array(dump.tree, head, [&](std::string_view name, const auto& array, std::uint64_t, Presence) {
    if (array.empty()) return;
    json.key(name);
    json.open_list();
    for (const auto& element : array) add_element(json, element);
    json.close();
  });
  json.close();
}

// What is stored round which part; the numbers with --arrays.
void add_volumes(JsonText& json, const TreeFile& file, bool arrays) {
  const auto volumes = load_volumes(file);
  if (!volumes || volumes->empty()) return;
  json.key("volumes");
  json.open_list();
  for (const VolumeSet& set : volumes->sets) {
    json.open_object(JsonText::in_line);
    json.member("name", set_name(set));
    json.member("points", set.points);
    if (set.motion == VolumeMotion::envelope) json.member("sway", set.sway);
    json.member("chosen", set.chosen);
    json.key("volumes");
    json.open_list(JsonText::in_line);
    for (std::uint32_t i = set.first; i < set.first + set.count; ++i) {
      const VolumeRecord& r = volumes->volumes[i];
      json.open_object(JsonText::in_line);
      json.member("type", name_of(r.kind));
      json.member("method", r.method_name());
      json.member("volume", r.volume);
      json.member("lower_bound", r.lower_bound);
      json.member("certified", (r.flags & VolumeRecord::certified) != 0);
      if (arrays) {
        json.key("numbers");
        json.open_list(JsonText::in_line);
        for (const float x : volumes->numbers.span().subspan(r.first, r.count)) json.value(x);
        json.close();
      }
      json.close();
    }
    json.close();
    json.close();
  }
  json.close();
}

}  // namespace

std::string json_text(const Dump& dump, bool arrays) {
  JsonText json;
  json.open_object();
  json.member("schema", "copse.dump/1");
  json.member("file", dump.path.string());
  json.member("bytes", dump.container.size());
  json.member("sound", !dump.problem.has_value());
  if (dump.file) {
    add_header(json, *dump.file);
    add_counts(json, dump.file->counts());
    add_materials(json, dump.tree);
    add_provenance(json, dump.tree.provenance);
  }
  add_sections(json, dump);
  if (dump.file) add_omissions(json, *dump.file);
  if (dump.file) add_volumes(json, *dump.file, arrays);
  if (dump.file) add_levels(json, *dump.file);
  if (dump.file && arrays) add_arrays(json, dump);
  json.close();
  return json.take();
}

}  // namespace copse
