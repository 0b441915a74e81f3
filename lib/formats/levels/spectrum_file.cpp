#include "lib/formats/levels/spectrum_file.h"

#include "lib/formats/levels/spectrum_codec.h"
#include "lib/formats/little_endian.h"
#include "lib/formats/tree_file/tree_file.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

namespace copse {
namespace {

constexpr std::size_t k_level_record = 20, k_levels_header = 20;

std::unexpected<Error> bad(const std::string& name, const std::string& what) {
  return refuse(name, what, "restore the file, or bake its levels again");
}

bool is_based(std::span<const std::uint8_t> bytes) {
  return bytes.size() >= 8 &&
         get<std::uint32_t>(bytes, 4) == static_cast<std::uint32_t>(SpectrumCoding::based);
}

bool fits(const Spectrum& s) {
  return s.first_triangle.size() == s.elements.size() + 1 &&
         s.first_triangle[s.elements.size()] == s.triangles.size() && !s.counts.empty() &&
         s.errors.size() == s.counts.size();
}

std::string check_elements(const Spectrum& s) {
  const std::uint32_t steps = s.steps();
  for (std::size_t e = 0; e < s.elements.size(); ++e) {
    const SpectrumElement& x = s.elements[e];
    if (x.birth > steps || x.birth >= x.death || (x.death > steps && x.death != k_none))
      return fmt::format("element {} lives from step {} to {} of {}", e, x.birth, x.death, steps);
    if (s.first_triangle[e] >= s.first_triangle[e + 1]) return fmt::format("element {} has no triangles", e);
    if (e == 0) continue;
    const SpectrumElement& before = s.elements[e - 1];
    if (before.death < x.death || (before.death == x.death && before.birth > x.birth))
      return fmt::format("element {} is out of order", e);
  }
  return {};
}

std::string check_geometry(const Spectrum& s) {
  for (std::size_t t = 0; t < s.triangles.size(); ++t) {
    for (const std::uint32_t v : s.triangles[t])
      if (v >= s.vertices.size())
        return fmt::format("triangle {} names vertex {} of {}", t, v, s.vertices.size());
  }
  for (std::size_t v = 0; v < s.vertices.size(); ++v) {
    const SpectrumVertex& x = s.vertices[v];
    if (!is_finite(x.position) || !is_finite(x.normal) || !std::isfinite(x.texcoord.x) ||
        !std::isfinite(x.texcoord.y))
      return fmt::format("vertex {} is not finite", v);
  }
  return {};
}

// Triangles after every step; the text says where they grow.
std::string make_counts(Spectrum& s, std::uint32_t steps) {
  std::vector<std::int64_t> change(std::size_t{steps} + 2);
  for (std::size_t e = 0; e < s.elements.size(); ++e) {
    const std::int64_t n = std::int64_t{s.first_triangle[e + 1]} - s.first_triangle[e];
    change[s.elements[e].birth] += n;
    if (s.elements[e].death != k_none) change[s.elements[e].death] -= n;
  }
  std::vector<std::uint32_t> counts(std::size_t{steps} + 1);
  std::int64_t now = 0;
  for (std::size_t n = 0; n <= steps; ++n) {
    now += change[n];
    if (n > 0 && now > counts[n - 1]) return fmt::format("step {} adds triangles", n);
    counts[n] = static_cast<std::uint32_t>(now);
  }
  s.counts = std::move(counts);
  return {};
}

void add_level(std::vector<std::uint8_t>& out, const LodLevel& l) {
  const std::size_t at = out.size();
  out.resize(at + k_level_record);
  const std::span<std::uint8_t> bytes(out);
  put(bytes, at, l.trunk_steps), put(bytes, at + 4, l.leaf_steps), put(bytes, at + 8, l.triangles);
  put(bytes, at + 12, l.error), put(bytes, at + 16, l.distance);
}

LodLevel level_at(std::span<const std::uint8_t> bytes, std::size_t at) {
  return {.trunk_steps = get<std::uint32_t>(bytes, at),
          .leaf_steps = get<std::uint32_t>(bytes, at + 4),
          .triangles = get<std::uint32_t>(bytes, at + 8),
          .error = get<float>(bytes, at + 12),
          .distance = get<float>(bytes, at + 16)};
}

std::uint64_t triangles_at(const Spectrum& s, std::uint32_t steps) {
  return s.counts.empty() ? 0 : s.counts[steps];
}

float error_at(const Spectrum& s, std::uint32_t steps) {
  return s.errors.empty() ? 0 : s.errors[steps];
}

std::string check_level(const LodSpectra& s, const LodLevel& l, const LodLevel* before) {
  if (l.trunk_steps > s.trunk.steps() || l.leaf_steps > s.leaves.steps())
    return "takes more steps than there are";
  if (triangles_at(s.trunk, l.trunk_steps) + triangles_at(s.leaves, l.leaf_steps) != l.triangles)
    return "has another number of triangles than its steps give";
  if (!(l.error >= 0) || !std::isfinite(l.error) || !(l.distance >= 0) || !std::isfinite(l.distance))
    return "has an error or a distance that is no number";
  if (before && (l.trunk_steps < before->trunk_steps || l.leaf_steps < before->leaf_steps ||
                 l.triangles > before->triangles || l.error < before->error))
    return "is finer than the one before";
  if (before && l.distance < before->distance) return "begins nearer than the one before";
  return {};
}

}  // namespace

Result<EncodedSpectrum> encode_spectrum(const Spectrum& spectrum, const SpectrumCodingOptions& options,
                                        const Tree* tree) {
  if (!fits(spectrum))
    return fail(Fault::bug, "", "a spectrum whose arrays do not fit together", "report this");
  return spectrum_codec::encode(spectrum, options, tree);
}

Result<Spectrum> decode_spectrum(std::span<const std::uint8_t> bytes, const std::string& name,
                                 const Tree* tree) {
  auto spectrum = spectrum_codec::decode(bytes, tree);
  if (!spectrum) return bad(name, spectrum.error());
  if (spectrum->first_triangle.size() != spectrum->elements.size() + 1 || spectrum->errors.empty())
    return bad(name, "its arrays do not fit together");
  const auto steps = static_cast<std::uint32_t>(spectrum->errors.size() - 1);
  spectrum->counts = std::vector<std::uint32_t>(spectrum->errors.size());
  if (spectrum->first_triangle[0] != 0 ||
      spectrum->first_triangle[spectrum->elements.size()] != spectrum->triangles.size())
    return bad(name, "its elements do not hold all triangles");
  if (const std::string wrong = check_elements(*spectrum); !wrong.empty()) return bad(name, wrong);
  if (const std::string wrong = check_geometry(*spectrum); !wrong.empty()) return bad(name, wrong);
  for (std::size_t n = 0; n < spectrum->errors.size(); ++n) {
    const float e = spectrum->errors[n];
    if (!std::isfinite(e) || e < 0 || (n > 0 && e < spectrum->errors[n - 1]))
      return bad(name, fmt::format("the error of step {} is smaller than before, or no number", n));
  }
  if (const std::string wrong = make_counts(*spectrum, steps); !wrong.empty()) return bad(name, wrong);
  return std::move(*spectrum);
}

std::string check_spectrum_links(const Spectrum& spectrum, std::size_t radii, std::size_t materials) {
  for (std::size_t e = 0; e < spectrum.elements.size(); ++e) {
    const SpectrumElement& x = spectrum.elements[e];
    if (x.radius != k_none && x.radius >= radii)
      return fmt::format("element {} names radius {} of {}", e, x.radius, radii);
    if (x.material != k_none && x.material >= materials)
      return fmt::format("element {} names material {} of {}", e, x.material, materials);
  }
  return {};
}

std::vector<std::uint8_t> encode_levels(const LodSpectra& spectra) {
  std::vector<std::uint8_t> out(k_levels_header);
  const std::span<std::uint8_t> bytes(out);
  put(bytes, 0, static_cast<std::uint32_t>(spectra.schedule.size()));
  put(bytes, 4, static_cast<std::uint32_t>(spectra.discrete.size()));
  put(bytes, 8, spectra.hysteresis), put(bytes, 12, spectra.near), put(bytes, 16, spectra.far);
  for (const LodLevel& l : spectra.schedule) add_level(out, l);
  for (const LodLevel& l : spectra.discrete) add_level(out, l);
  return out;
}

Result<void> decode_levels(std::span<const std::uint8_t> bytes, const std::string& name,
                           LodSpectra& spectra) {
  if (bytes.size() < k_levels_header) return bad(name, "section LSLD is cut off");
  const std::uint64_t knots = get<std::uint32_t>(bytes, 0), levels = get<std::uint32_t>(bytes, 4);
  if (bytes.size() != k_levels_header + (knots + levels) * k_level_record)
    return bad(name, "section LSLD has another size than its counts give");
  spectra.hysteresis = get<float>(bytes, 8), spectra.near = get<float>(bytes, 12),
  spectra.far = get<float>(bytes, 16);
  if (!(spectra.hysteresis >= 0 && spectra.hysteresis < 1) || !(spectra.near >= 0) ||
      !(spectra.far >= spectra.near) || !std::isfinite(spectra.far))
    return bad(name, "section LSLD: hysteresis or distances are out of range");
  for (std::uint64_t i = 0; i < knots + levels; ++i) {
    auto& list = i < knots ? spectra.schedule : spectra.discrete;
    const LodLevel level = level_at(bytes, k_levels_header + i * k_level_record);
    if (const std::string wrong = check_level(spectra, level, list.empty() ? nullptr : &list.back());
        !wrong.empty())
      return bad(name, fmt::format("section LSLD: level {} {}", i, wrong));
    list.push_back(level);
  }
  return {};
}

Result<SpectraCosts> put_spectra(ContainerWriter& writer, const LodSpectra& spectra,
                                 const SpectrumCodingOptions& options, const Tree* tree) {
  SpectraCosts costs;
  const auto add = [&](const char* name, const Spectrum& s, double& error,
                       std::vector<StreamCost>& streams) -> Result<void> {
    writer.remove(name);
    if (s.elements.empty()) return {};
    auto encoded = encode_spectrum(s, options, tree);
    if (!encoded) return std::unexpected(encoded.error());
    error = encoded->position_error, streams = std::move(encoded->streams);
    return writer.put(name, k_spectrum_version, 1, std::move(encoded->bytes));
  };
  if (auto done = add("LSTR", spectra.trunk, costs.trunk_error, costs.trunk); !done)
    return std::unexpected(done.error());
  if (auto done = add("LSLV", spectra.leaves, costs.leaf_error, costs.leaves); !done)
    return std::unexpected(done.error());
  const Encoding encoding = options.coding == SpectrumCoding::fast ? Encoding::raw : Encoding::zstd;
  if (auto done = writer.put("LSLD", k_spectrum_version, 1, encode_levels(spectra), encoding); !done)
    return std::unexpected(done.error());
  return costs;
}

bool has_spectra(const Container& file) {
  return file.find("LSLD") != nullptr;
}

Result<LodSpectra> load_spectra(const Container& file, std::size_t radii, std::size_t materials) {
  LodSpectra spectra;
  std::optional<Tree> tree;  // loaded when a spectrum is coded against it
  const auto load = [&](const char* name, Spectrum& out) -> Result<void> {
    const SectionInfo* section = file.find(name);
    if (!section) return {};
    if (section->version != k_spectrum_version)
      return file.refuse_section(*section, 0,
                                 fmt::format("version {} is unknown to this program", section->version));
    const auto bytes = file.read(*section);
    if (!bytes) return std::unexpected(bytes.error());
    if (!tree && is_based(*bytes)) {
      auto own = TreeFile::from_container(file);
      auto whole = own ? own->load() : std::unexpected(own.error());
      if (!whole) return std::unexpected(whole.error());
      tree = std::move(*whole);
    }
    auto decoded = decode_spectrum(*bytes, file.name(), tree ? &*tree : nullptr);
    if (!decoded) return file.refuse_section(*section, 0, decoded.error().what);
    if (const std::string wrong = check_spectrum_links(*decoded, radii, materials); !wrong.empty())
      return file.refuse_section(*section, 0, wrong);
    out = std::move(*decoded);
    return {};
  };
  if (auto done = load("LSTR", spectra.trunk); !done) return std::unexpected(done.error());
  if (auto done = load("LSLV", spectra.leaves); !done) return std::unexpected(done.error());
  const SectionInfo* levels = file.find("LSLD");
  if (!levels) return bad(file.name(), "there is no section LSLD");
  if (levels->version != k_spectrum_version)
    return file.refuse_section(*levels, 0,
                               fmt::format("version {} is unknown to this program", levels->version));
  const auto bytes = file.read(*levels);
  if (!bytes) return std::unexpected(bytes.error());
  if (auto done = decode_levels(*bytes, file.name(), spectra); !done) return std::unexpected(done.error());
  // The spectra's own errors were rounded up where they are coded small.
  for (std::vector<LodLevel>* list : {&spectra.schedule, &spectra.discrete})
    for (LodLevel& l : *list)
      l.error = std::max(error_at(spectra.trunk, l.trunk_steps), error_at(spectra.leaves, l.leaf_steps));
  return spectra;
}

}  // namespace copse
