#include "lib/formats/tree_file/tree_volumes.h"
#include "tools/treedump/levels_view.h"
#include "tools/treedump/text.h"
#include "tools/treedump/views.h"

#include <algorithm>
#include <array>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace copse {
namespace {

constexpr std::size_t k_label = 13;    // columns of the labels
constexpr std::size_t k_columns = 98;  // of a line

// A line with its label; what is too long goes on below, broken at commas.
void add(std::string& out, const char* label, std::string_view text) {
  while (!text.empty()) {
    std::size_t end = text.size();
    if (end > k_columns - k_label) {
      const std::size_t comma = text.rfind(", ", k_columns - k_label);
      end = std::min(comma == std::string_view::npos ? text.find(", ") : comma, text.size() - 1) + 1;
    }
    out += fmt::format("  {:<{}}{}\n", label, k_label, text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    label = "";
  }
}

// Lists are joined by ", " and empty entries left out.
std::string listed(std::initializer_list<std::string> entries) {
  std::string out;
  for (const std::string& entry : entries) {
    if (!entry.empty()) out += fmt::format("{}{}", out.empty() ? "" : ", ", entry);
  }
  return out;
}

template <class T>
std::string point_text(const Vec3<T>& p) {
  return fmt::format("({:.4g}, {:.4g}, {:.4g})", p.x, p.y, p.z);
}

std::string bounds_text(const FloatBox& box) {
  if (box.empty()) return "nothing";
  const Float3 size = box.extent();
  return fmt::format("{:.4g} x {:.4g} x {:.4g} m, from {} to {}", size.x, size.y, size.z, point_text(box.min),
                     point_text(box.max));
}

void add_trunk(std::string& out, const Dump& dump) {
  const TreeCounts& c = dump.file->counts();
  const TreeHeader& h = dump.file->header();
  if (c.trunk_triangles == 0) return add(out, "trunk", "none");
  add(out, "trunk",
      listed({count_text(c.trunk_triangles, "triangle"), count_text(c.trunk_vertices, "vertex"),
              fmt::format("mean triangle {:.3g} m2", h.mean_trunk_area)}));
  const Array<float>& diameters = dump.tree.trunk.diameters;
  const Array<double>& lengths = dump.tree.trunk.accumulated_lengths;
  add(out, "segments",
      listed({count_text(c.segments, "segment"),
              h.segment_factor != 0 ? fmt::format("{} each", count_text(h.segment_factor, "triangle"))
                                    : std::string(),
              lengths.empty() ? std::string()
                              : fmt::format("{} long in all", metres_text(lengths[lengths.size() - 1])),
              diameters.empty() ? std::string()
                                : fmt::format("{} to {} thick", metres_text(diameters[0]),
                                              metres_text(diameters[diameters.size() - 1])),
              h.unexplained != 0 ? count_text(h.unexplained, "triangle") + " that no segment explains"
                                 : std::string()}));
  add(out, "trunk box", bounds_text(h.trunk_bounds));
}

void add_hierarchy(std::string& out, const Dump& dump) {
  const TreeCounts& c = dump.file->counts();
  const TreeHeader& h = dump.file->header();
  if (h.kind != TreeKind::sensitive) return;
  const auto terminals = std::count_if(dump.tree.hierarchy.radii.begin(), dump.tree.hierarchy.radii.end(),
                                       [](const Radius& r) { return (r.flags & Radius::terminal) != 0; });
  add(out, "hierarchy",
      listed({count_text(c.radii, "radius"), count_text(h.roots, "root"),
              dump.tree.hierarchy.radii.empty()
                  ? std::string()
                  : count_text(static_cast<std::uint64_t>(terminals), "terminal"),
              h.ring_size != 0 ? fmt::format("{} each", count_text(h.ring_size, "vertex"))
                               : "vertices that vary in number",
              c.radii == 0 ? ""
              : h.monotone ? "diameters never grow towards the tips"
                           : "some diameters grow towards the tips"}));
}

void add_leaves(std::string& out, const Dump& dump) {
  static constexpr std::array<const char*, 3> k_orders{"outwards from the group's centre",
                                                       "by distance from the terminal", "at random"};
  const TreeCounts& c = dump.file->counts();
  const TreeHeader& h = dump.file->header();
  if (c.leaf_triangles == 0) return add(out, "leaves", "none");
  add(out, "leaves",
      listed({count_text(c.leaves, "leaf"), count_text(c.leaf_triangles, "triangle"),
              h.leaf_factor != 0 ? fmt::format("{} each", h.leaf_factor) : std::string(),
              count_text(c.leaf_vertices, "vertex"), fmt::format("mean area {:.3g} m2", h.mean_leaf_area)}));
  add(out, "leaf groups",
      listed({count_text(c.groups, "group"),
              c.group_nodes == 0 ? std::string() : count_text(c.group_nodes, "sphere") + " over them",
              fmt::format("leaves ordered {}", k_orders[static_cast<std::size_t>(h.leaf_order)])}));
}

std::string texture_text(const Tree& tree, std::uint32_t index) {
  if (index >= tree.textures.size()) return fmt::format("texture {} (left out)", index);
  const Texture& texture = tree.textures[index];
  if (!texture.uri.empty()) return texture.uri;
  if (texture.bytes.empty()) return "an image that was left out";
  return fmt::format("embedded {}, {}", texture.mime.empty() ? "image" : texture.mime,
                     bytes_text(texture.bytes.size()));
}

void add_volumes(std::string& out, const Dump& dump) {
  const auto volumes = load_volumes(*dump.file);
  if (!volumes || volumes->empty()) return;
  const auto certified =
      std::count_if(volumes->volumes.begin(), volumes->volumes.end(),
                    [](const VolumeRecord& r) { return (r.flags & VolumeRecord::certified) != 0; });
  std::array<std::size_t, k_volume_kinds> chosen{};
  for (const VolumeSet& s : volumes->sets)
    ++chosen[static_cast<std::size_t>(volumes->volumes[s.first + s.chosen].kind)];
  std::string kinds;
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    if (chosen[k] > 0)
      kinds += fmt::format("{}{} {}", kinds.empty() ? "chosen: " : ", ", k_volume_names[k], chosen[k]);
  }
  add(out, "volumes",
      listed({count_text(volumes->sets.size(), "set"), count_text(volumes->volumes.size(), "volume"),
              fmt::format("{} of them certified", count_text(static_cast<std::uint64_t>(certified))), kinds,
              volumes->nodes.empty() ? std::string()
                                     : count_text(volumes->nodes.size(), "node") + " above them"}));
}

void add_materials(std::string& out, const Dump& dump) {
  const char* label = "materials";
  for (const Material& m : dump.tree.materials) {
    add(out, label,
        listed({m.name.empty() ? "(without a name)" : m.name,
                m.texture == k_none ? std::string() : texture_text(dump.tree, m.texture),
                m.alpha_cutoff > 0 ? fmt::format("alpha test at {:.3g} lets {:.3g} % through", m.alpha_cutoff,
                                                 100 * m.alpha_coverage)
                                   : std::string(),
                m.double_sided ? "double-sided" : ""}));
    label = "";
  }
}

std::string member_text(const nlohmann::json& json, const char* key) {
  return json.is_object() && json.contains(key) && json[key].is_string() ? json[key].get<std::string>() : "";
}

// "treeprep 0.1.0 from oak.glb", from the members that a provenance has (docs/formats.md); other text as it
// is.
std::string provenance_text(const std::string& provenance) {
  const auto json = nlohmann::json::parse(provenance, nullptr, false);
  if (!json.is_object()) return provenance.substr(0, 200);
  std::string out = fmt::format("{} {}", member_text(json, "tool"), member_text(json, "version"));
  const auto sources = json.find("sources");
  if (sources == json.end() || !sources->is_array() || sources->empty()) return out;
  out += fmt::format(" from {}", member_text(sources->front(), "name"));
  if (sources->size() > 1) out += fmt::format(" and {} more", sources->size() - 1);
  return out;
}

// Texts from a file may hold anything; a terminal shall not obey them.
std::string printable(std::string text) {
  for (char& c : text) {
    if ((static_cast<unsigned char>(c) < 0x20 && c != '\n') || c == 0x7f) c = '?';
  }
  return text;
}

void add_omissions(std::string& out, const Dump& dump) {
  if (!dump.file || dump.file->omissions().empty()) return;
  std::uint64_t saved = 0;
  for (const Omitted& omitted : dump.file->omissions()) saved += omitted.bytes;
  out += fmt::format("\n  Left out on purpose, which saved {} ({} of the whole):\n", bytes_text(saved),
                     share_text(saved, dump.container.size() + saved));
  for (const Omitted& omitted : dump.file->omissions()) {
    out += fmt::format("  {:<7}  {:<32}  {:>9}\n", omitted.name, describe_section(omitted.name),
                       omitted.bytes > 0 ? bytes_text(omitted.bytes) : "never made");
  }
}

}  // namespace

std::string sections_text(std::span<const SectionState> sections, std::uint64_t file_size) {
  std::string out;
  std::size_t widest = 4;
  for (const SectionState& s : sections) widest = std::max(widest, describe_section(s.info.name).size());
  out += fmt::format("\n  {:<7}  {:<{}}  {:<6}  {:>11}  {:>9}  {:>9}  {:>7}\n", "section", "what", widest,
                     "stored", "elements", "size", "decoded", "share");
  for (const SectionState& s : sections) {
    const SectionInfo& i = s.info;
    const std::uint64_t elements = i.stride > 1 ? i.decoded_size / i.stride : 0;
    out += fmt::format("  {:<7}  {:<{}}  {:<6}  {:>11}  {:>9}  {:>9}  {:>7}{}\n", i.name,
                       describe_section(i.name), widest, encoding_name(i.encoding),
                       elements == 0 ? "" : count_text(elements), bytes_text(i.stored_size),
                       i.encoding == Encoding::raw ? "" : bytes_text(i.decoded_size),
                       share_text(i.stored_size, file_size), s.damage.empty() ? "" : "  DAMAGED");
  }
  return out;
}

std::string summary_text(const Dump& dump) {
  std::string out =
      fmt::format("{}: {}, {} in {}\n\n", dump.path.string(), kind_name(dump.container.kind()),
                  bytes_text(dump.container.size()), count_text(dump.sections.size(), "section"));
  if (dump.file) {
    const TreeHeader& h = dump.file->header();
    add(out, "size", bounds_text(h.bounds));
    if (h.origin != Double3{})
      // No minus zero.
      add(out, "origin", fmt::format("({}, {}, {})", h.origin.x + 0.0, h.origin.y + 0.0, h.origin.z + 0.0));
    add_trunk(out, dump);
    add_hierarchy(out, dump);
    add_leaves(out, dump);
    add_volumes(out, dump);
    for (const auto& [label, text] : level_lines(*dump.file)) add(out, label.c_str(), text);
    add_materials(out, dump);
    add(out, "made by", provenance_text(dump.tree.provenance));
  } else {
    out += "  header and table do not fit together; the sections are:\n";
  }
  out += sections_text(dump.sections, dump.container.size());
  add_omissions(out, dump);
  return printable(out);
}

Table sections_table(const Dump& dump) {
  Table table{.name = "Sections",
              .columns = {"section", "what", "stored", "bytes", "decoded bytes", "share"},
              .rows = {}};
  for (const SectionState& s : dump.sections) {
    table.rows.push_back({s.info.name, std::string(describe_section(s.info.name)),
                          std::string(encoding_name(s.info.encoding)), std::to_string(s.info.stored_size),
                          std::to_string(s.info.decoded_size),
                          share_text(s.info.stored_size, dump.container.size())});
  }
  return table;
}

}  // namespace copse
