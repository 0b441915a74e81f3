#include "tools/ecogen/pack_tree.h"

#include "lib/formats/container/mapped_file.h"
#include "lib/formats/levels/foliage_cells.h"
#include "lib/formats/levels/impostors.h"
#include "lib/formats/levels/spectrum_file.h"
#include "lib/formats/tree/tree_sections.h"
#include "lib/formats/tree_file/tree_file.h"
#include "lib/formats/tree_file/tree_volumes.h"

#include <algorithm>
#include <array>
#include <limits>
#include <set>
#include <system_error>

#include <fmt/format.h>

namespace copse::ecogen {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 3> k_level_sections{"LSTR", "LSLV", "LSLD"};
constexpr std::array<std::string_view, 3> k_impostor_sections{"IMPO", "IMPA", "IMPN"};
constexpr std::array<std::string_view, 6> k_cell_sections{"FCEL", "FORD", "FVWS", "FVTR", "FVIS", "FPAR"};
constexpr std::array<std::string_view, 4> k_volume_sections{"VSET", "VOLU", "VNUM", "VNOD"};

template <class Names>
bool is_one_of(const Names& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

template <class Names>
std::uint64_t stored_bytes(const Container& file, const Names& names) {
  std::uint64_t bytes = 0;
  for (const std::string_view name : names)
    if (const SectionInfo* section = file.find(name)) bytes += section->stored_size;
  return bytes;
}

// Up to where a tree is drawn in full detail: the nearest that any level takes over, with the hysteresis of
// switching back. Not a number that a file need have: 0 then, and its levels are kept.
double full_detail(const LodSpectra& spectra) {
  double nearest = std::numeric_limits<double>::infinity();
  if (!spectra.discrete.empty())
    nearest = double{spectra.discrete.front().distance} * (1 - double{spectra.hysteresis});
  if (spectra.schedule.size() > 1) nearest = std::min(nearest, double{spectra.near});
  return nearest;
}

class Packer {
 public:
  Packer(const fs::path& path, const TreeFile& file, const TreeUse& use, std::vector<LeftOut>& left_out,
         Context& context)
      : path_(path), file_(file), use_(use), left_out_(left_out), context_(context) {}

  Result<std::vector<std::uint8_t>> pack() {
    auto tree = file_.load();
    if (!tree) return std::unexpected(tree.error());
    drop_textures(*tree);
    for (Texture& t : tree->textures)
      if (auto done = copy_in(t); !done) return std::unexpected(done.error());
    WriteOptions options{.encoding = encoding(), .omit = file_.omitted()};
    if (!tree->provenance.empty()) {
      options.omit.emplace_back("PROV");
      note("provenance", "no frame shows it", tree->provenance.size());
    }
    const auto bytes = encode_tree(*tree, options);
    if (!bytes) return std::unexpected(bytes.error());
    return with_additions(*bytes);
  }

 private:
  void note(std::string_view what, std::string why, std::uint64_t bytes) {
    left_out_.push_back({fmt::format("{} of {}", what, path_.string()), std::move(why), bytes});
  }

  Encoding encoding() const {
    for (const SectionInfo& s : file_.sections())
      if (s.encoding == Encoding::zstd) return Encoding::zstd;
    return Encoding::raw;
  }

  // Materials stay where they are, because levels of detail number them.
  void drop_textures(Tree& tree) {
    std::vector<bool> made_of(tree.materials.size()), used(tree.textures.size());
    const auto mark = [&](bool own, std::uint32_t material, const Array<std::uint32_t>& each) {
      if (!own) return;
      if (material != k_none) made_of[material] = true;
      for (const std::uint32_t m : each)
        if (m != k_none) made_of[m] = true;
    };
    mark(use_.own_trunk_material, tree.trunk.material, tree.trunk.materials);
    mark(use_.own_leaf_material, tree.leaves.material, tree.leaves.materials);
    for (std::size_t m = 0; m < made_of.size(); ++m) {
      std::uint32_t& texture = tree.materials[m].texture;
      if (!made_of[m]) texture = k_none;
      if (texture != k_none) used[texture] = true;
    }
    std::vector<std::uint32_t> number(used.size(), k_none);
    std::vector<Texture> kept;
    for (std::size_t t = 0; t < used.size(); ++t) {
      if (used[t]) {
        number[t] = static_cast<std::uint32_t>(kept.size());
        kept.push_back(std::move(tree.textures[t]));
        continue;
      }
      const Texture& gone = tree.textures[t];
      std::error_code error;
      const auto size = gone.uri.empty() ? gone.bytes.size() : fs::file_size(beside(gone), error);
      note(gone.uri.empty() ? fmt::format("texture {}", t) : fmt::format("texture '{}'", gone.uri),
           "no instance shows a material that has it", error ? 0 : size);
    }
    tree.textures = std::move(kept);
    for (Material& m : tree.materials)
      if (m.texture != k_none) m.texture = number[m.texture];
  }

  fs::path beside(const Texture& t) const { return path_.parent_path() / t.uri; }

  Result<void> copy_in(Texture& t) {
    if (t.uri.empty()) return {};
    std::error_code error;
    if (!fs::exists(beside(t), error)) {
      context_.warn(
          fmt::format("{}: the texture '{}' is not there, so it stays a name", path_.string(), t.uri));
      return {};
    }
    const auto file = MappedFile::open(beside(t));
    if (!file) return std::unexpected(file.error());
    context_.read(beside(t), true);
    t.bytes.assign(file->bytes().begin(), file->bytes().end());
    t.uri.clear();
    return {};
  }

  // And its picture from afar, which players show behind the levels only.
  bool shows_levels() {
    if (!has_spectra(file_.container())) return true;  // none to drop
    const auto spectra = load_spectra(file_.container(), file_.counts().radii, file_.counts().materials);
    const auto impostor = read_impostor(file_);
    if (!spectra || !impostor) return true;  // what is unsound is not for us to drop
    double near = full_detail(*spectra);
    if (!impostor->empty()) near = std::min(near, double{impostor->distance});
    if (near <= use_.farthest) return true;
    const std::string why =
        fmt::format("full detail reaches {:.4g} m, it is shown up to {:.4g} m", near, use_.farthest);
    note("levels of detail", why, stored_bytes(file_.container(), k_level_sections));
    if (!impostor->empty())
      note("picture from afar", why, stored_bytes(file_.container(), k_impostor_sections));
    return false;
  }

  bool shows_cells() {
    if (!file_.has("FCEL")) return false;
    const auto cells = read_foliage_cells(file_);
    if (!cells || double{cells->parameters.near} <= use_.farthest) return true;
    note("foliage cells",
         fmt::format("all leaves are drawn up to {:.4g} m, it is shown up to {:.4g} m",
                     cells->parameters.near, use_.farthest),
         stored_bytes(file_.container(), k_cell_sections));
    return false;
  }

  // What tests are made with: of each set the chosen volume. Sets of nodes stay, whatever their motion.
  static TreeVolumes needed(const TreeVolumes& all, bool moves, bool cells) {
    std::vector<bool> of_node(all.sets.size());
    for (const VolumeNode& n : all.nodes) of_node[n.set] = true;
    std::vector<VolumeSet> sets;
    std::vector<VolumeRecord> records;
    std::vector<float> numbers;
    std::vector<std::uint32_t> number(all.sets.size(), k_none);
    for (std::size_t s = 0; s < all.sets.size(); ++s) {
      VolumeSet set = all.sets[s];
      const bool envelope = set.motion == VolumeMotion::envelope && !moves;
      const bool of_cell = set.part == VolumePart::cell && !cells;
      if (!of_node[s] && (envelope || of_cell)) continue;
      VolumeRecord r = all.volumes[set.first + set.chosen];
      const auto values = all.numbers.span().subspan(r.first, r.count);
      r.first = static_cast<std::uint32_t>(numbers.size());
      numbers.insert(numbers.end(), values.begin(), values.end());
      set.first = static_cast<std::uint32_t>(records.size()), set.count = 1, set.chosen = 0;
      records.push_back(r);
      number[s] = static_cast<std::uint32_t>(sets.size());
      sets.push_back(set);
    }
    std::vector<VolumeNode> nodes = all.nodes.to_vector();
    for (VolumeNode& n : nodes) n.set = number[n.set];
    return {std::move(sets), std::move(records), std::move(numbers), std::move(nodes)};
  }

  // The sections that are not the tree's own: levels, cells, volumes, and those that nobody here knows.
  Result<std::vector<std::uint8_t>> with_additions(const std::vector<std::uint8_t>& tree) {
    const auto base = Container::from_bytes(tree, path_.string());
    if (!base) return std::unexpected(base.error());
    ContainerWriter writer(*base);
    std::set<std::string, std::less<>> own{"HEAD", "OMIT", "MATL", "MNAM", "TEXR", "TNAM", "TDAT", "PROV"};
    for (const Omissible& o : omissible_sections()) own.emplace(o.name);
    const bool levels = shows_levels(), cells = shows_cells();
    for (const SectionInfo& s : file_.sections()) {
      if (own.contains(s.name) || base->find(s.name)) continue;
      if (!levels && (is_one_of(k_level_sections, s.name) || is_one_of(k_impostor_sections, s.name)))
        continue;
      if (!cells && is_one_of(k_cell_sections, s.name)) continue;
      const auto bytes = file_.container().read(s);
      if (!bytes) return std::unexpected(bytes.error());
      if (auto done = writer.put(s.name, s.version, s.stride, *bytes, s.encoding); !done)
        return std::unexpected(done.error());
    }
    auto whole = writer.finish();
    if (!whole || !file_.has("VSET")) return whole;
    return with_needed_volumes(std::move(*whole), cells);
  }

  Result<std::vector<std::uint8_t>> with_needed_volumes(std::vector<std::uint8_t> bytes, bool cells) {
    const auto all = load_volumes(file_);
    if (!all) return std::unexpected(all.error());
    const auto file = Container::from_bytes(std::move(bytes), path_.string());
    if (!file) return std::unexpected(file.error());
    auto out = with_volumes(*file, needed(*all, use_.moves, cells));
    if (!out) return out;
    const auto packed = Container::from_bytes(*out, path_.string());
    if (!packed) return std::unexpected(packed.error());
    const auto before = stored_bytes(file_.container(), k_volume_sections),
               after = stored_bytes(*packed, k_volume_sections);
    if (after < before)
      note(
          "bounding volumes",
          use_.moves ? "tests are made with one of each set" : "tests are made with one of each set, at rest",
          before - after);
    return out;
  }

  const fs::path& path_;
  const TreeFile& file_;
  const TreeUse& use_;
  std::vector<LeftOut>& left_out_;
  Context& context_;
};

}  // namespace

Result<std::vector<std::uint8_t>> pack_tree(const fs::path& tree, const TreeUse& use,
                                            std::vector<LeftOut>& left_out, Context& context) {
  const auto file = TreeFile::open(tree);
  if (!file) return std::unexpected(file.error());
  return Packer(tree, *file, use, left_out, context).pack();
}

}  // namespace copse::ecogen
