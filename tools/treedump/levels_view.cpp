#include "tools/treedump/levels_view.h"

#include "lib/formats/levels/foliage_cells.h"
#include "lib/formats/levels/impostors.h"
#include "lib/formats/levels/spectrum_file.h"
#include "lib/runtime/levels.h"
#include "tools/treedump/text.h"

#include <optional>

#include <fmt/format.h>

namespace copse {
namespace {

using Line = std::pair<std::string, std::string>;

std::optional<LodSpectra> spectra_of(const TreeFile& file) {
  if (!has_spectra(file.container())) return std::nullopt;
  auto spectra = load_spectra(file.container(), file.counts().radii, file.counts().materials);
  if (!spectra) return std::nullopt;
  return std::move(*spectra);
}

// All triangles of the tree, those of a part that has no spectrum among them.
std::uint64_t full_triangles(const TreeFile& file) {
  return std::uint64_t{file.counts().trunk_triangles} + file.counts().leaf_triangles;
}

std::string method_text(LodMethod method) {
  switch (method) {
    case LodMethod::radii:
      return "by radii";
    case LodMethod::edges:
      return "by edge collapses";
    case LodMethod::collapse:
      return "by leaf collapses";
    case LodMethod::prune:
      break;
  }
  return "by pruning";
}

std::string_view method_name(LodMethod method) {
  switch (method) {
    case LodMethod::radii:
      return "radii";
    case LodMethod::edges:
      return "edges";
    case LodMethod::collapse:
      return "collapse";
    case LodMethod::prune:
      break;
  }
  return "prune";
}

std::uint64_t stored_bytes(const TreeFile& file, std::string_view section) {
  const SectionInfo* info = file.container().find(section);
  return info ? info->stored_size : 0;
}

std::string spectrum_text(const Spectrum& s, std::uint64_t bytes) {
  return fmt::format("{}, {}, {} in {}, {}", method_text(s.method), count_text(s.steps(), "step"),
                     count_text(s.triangles.size(), "triangle"), count_text(s.elements.size(), "element"),
                     bytes_text(bytes));
}

std::string level_text(const LodLevel& level, std::uint64_t full) {
  return fmt::format("{} ({}), from {} on, errs by about {}", count_text(level.triangles, "triangle"),
                     share_text(level.triangles, full), metres_text(level.distance),
                     metres_text(level.error));
}

std::string impostor_text(const ImpostorAtlas& a) {
  const bool octahedral = a.layout == ImpostorLayout::octahedral;
  return fmt::format("{} {} of {} x {} pixels, from {} on, {}", count_text(a.columns() * a.rows()),
                     octahedral ? "views from everywhere" : "views round the trunk", a.size, a.size,
                     metres_text(a.distance), bytes_text(a.albedo.size() + a.normal.size()));
}

void add_level(JsonText& json, const LodLevel& level, std::uint64_t full) {
  json.open_object(JsonText::in_line);
  json.member("triangles", level.triangles);
  json.member("share", full > 0 ? static_cast<double>(level.triangles) / static_cast<double>(full) : 1.0);
  json.member("error", level.error);
  json.member("distance", level.distance);
  json.member("trunk_steps", level.trunk_steps);
  json.member("leaf_steps", level.leaf_steps);
  json.close();
}

void add_spectrum(JsonText& json, const char* part, const Spectrum& s, std::uint64_t bytes) {
  if (s.elements.empty()) return;
  json.open_object(JsonText::in_line);
  json.member("part", part);
  json.member("method", method_name(s.method));
  json.member("steps", s.steps());
  json.member("elements", std::uint64_t{s.elements.size()});
  json.member("triangles", std::uint64_t{s.triangles.size()});
  json.member("vertices", std::uint64_t{s.vertices.size()});
  json.member("bytes", bytes);
  json.close();
}

}  // namespace

std::vector<Line> level_lines(const TreeFile& file) {
  const auto spectra = spectra_of(file);
  if (!spectra) return {};
  const std::uint64_t full = full_triangles(file);
  std::vector<Line> out{{"levels", fmt::format("0: {}, full detail", count_text(full, "triangle"))}};
  for (std::size_t i = 0; i < spectra->discrete.size(); ++i)
    out.emplace_back("", fmt::format("{}: {}", i + 1, level_text(spectra->discrete[i], full)));
  if (!spectra->discrete.empty())
    out.emplace_back("", fmt::format("hysteresis {:.3g} %", 100 * spectra->hysteresis));
  if (!spectra->schedule.empty())
    out.emplace_back("", fmt::format("and every level in between, down to {}",
                                     count_text(spectra->schedule.back().triangles, "triangle")));
  const char* label = "spectra";
  for (const auto& [part, s, section] :
       {std::tuple{"trunk", &spectra->trunk, "LSTR"}, std::tuple{"leaves", &spectra->leaves, "LSLV"}}) {
    if (s->elements.empty()) continue;
    out.emplace_back(label, fmt::format("{} {}", part, spectrum_text(*s, stored_bytes(file, section))));
    label = "";
  }
  if (const auto impostor = read_impostor(file); impostor && !impostor->empty())
    out.emplace_back("impostor", impostor_text(*impostor));
  return out;
}

void add_levels(JsonText& json, const TreeFile& file) {
  const auto spectra = spectra_of(file);
  if (!spectra) return;
  const std::uint64_t full = full_triangles(file);
  json.key("levels");
  json.open_object();
  json.member("hysteresis", spectra->hysteresis);
  json.member("near", spectra->near);
  json.member("far", spectra->far);
  json.key("spectra");
  json.open_list();
  add_spectrum(json, "trunk", spectra->trunk, stored_bytes(file, "LSTR"));
  add_spectrum(json, "leaves", spectra->leaves, stored_bytes(file, "LSLV"));
  json.close();
  for (const auto& [name, levels] :
       {std::pair{"discrete", &spectra->discrete}, std::pair{"schedule", &spectra->schedule}}) {
    json.key(name);
    json.open_list();
    for (const LodLevel& level : *levels) add_level(json, level, full);
    json.close();
  }
  if (const auto a = read_impostor(file); a && !a->empty()) {
    json.key("impostor");
    json.open_object(JsonText::in_line);
    json.member("layout", a->layout == ImpostorLayout::octahedral ? "octahedral" : "billboard");
    json.member("views", a->columns() * a->rows());
    json.member("size", a->size);
    json.member("centre", a->centre);
    json.member("radius", a->radius);
    json.member("distance", a->distance);
    json.member("bytes", std::uint64_t{a->albedo.size() + a->normal.size()});
    json.close();
  }
  json.close();
}

std::vector<std::string> verify_levels(const TreeFile& file) {
  std::vector<std::string> out;
  if (has_spectra(file.container())) {
    const auto spectra = load_spectra(file.container(), file.counts().radii, file.counts().materials);
    if (!spectra) out.push_back(spectra.error().what);
  }
  const auto foliage = read_foliage_cells(file);
  if (!foliage) out.push_back(foliage.error().what);
  const auto impostor = read_impostor(file);
  if (!impostor) out.push_back(impostor.error().what);
  return out;
}

}  // namespace copse
