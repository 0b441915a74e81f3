#include "tools/lodbake/run.h"

#include "lib/analysis/lod/discrete_spectra.h"
#include "lib/analysis/lod/floating_leaves.h"
#include "lib/formats/levels/spectrum_file.h"
#include "lib/formats/tree_file/tree_file.h"
#include "tools/lodbake/column_meanings.h"
#include "tools/lodbake/impostor_stage.h"
#include "tools/lodbake/level_strip.h"
#include "tools/lodbake/levels.h"
#include "tools/lodbake/looks.h"
#include "tools/lodbake/measure_stage.h"
#include "tools/lodbake/packing.h"
#include "tools/lodbake/projections.h"
#include "tools/lodbake/spectra.h"

#include <algorithm>

#include <fmt/format.h>

namespace copse::lodbake {
namespace {

// A mesh is no tree yet: says what makes one of it.
Result<TreeFile> open_tree(const Options& options) {
  auto file = TreeFile::open(options.input);
  const std::filesystem::path extension = options.input.extension();
  if (file || file.error().fault != Fault::refused || extension == ".tree" || extension == ".stree")
    return file;
  const std::filesystem::path tree = std::filesystem::path(options.input).replace_extension(".stree");
  return refuse(options.input.string(), "is no .tree or .stree",
                fmt::format("run treeprep first: treeprep {} -o {}", options.input.string(), tree.string()));
}

Result<Tree> load(const TreeFile& file, Context& context) {
  Stage stage = context.stage("read");
  stage.items(std::uint64_t{file.counts().trunk_triangles} + file.counts().leaf_triangles, "triangles");
  return file.load();
}

Result<void> check_output(const Options& options, const TreeFile& file) {
  const std::string extension = options.output.extension().string();
  const std::string wanted = file.header().kind == TreeKind::still ? ".tree" : ".stree";
  if (extension == wanted) return {};
  return fail(Fault::usage, options.output.string(), "the output is of the input's kind",
              "name it " + wanted);
}

// What a runtime draws lines and points from (000, chapter 4) is the order of the tree's own arrays.
Result<void> check_lines_points(const Options& options, const TreeFile& file) {
  if (!options.lines_points) return {};
  for (const char* section : {"TLIN", "TDIA", "TACC", "LCEN", "LGRP", "LORD"}) {
    const bool needed = section[0] == 'T' ? file.counts().segments > 0 : file.counts().leaves > 0;
    if (needed && !file.has(section))
      return refuse(options.input.string(),
                    fmt::format("section {}, which lines and points need, was left out", section),
                    "prepare the tree without --omit of lines, points or groups");
  }
  return {};
}

std::string number(double value) {
  return fmt::format("{:.4g}", value);
}

// What is low and wide, or lies on its side, is as large on the screen as what stands. What has no size at
// all is seen from nowhere, but its distances still ascend.
double largest_side(const FloatBox& box) {
  const Float3 e = box.extent();
  return std::max({double(e.x), double(e.y), double(e.z), 1e-12});
}

std::vector<LodLevel> with_full_detail(const LodSpectra& spectra) {
  std::vector<LodLevel> levels{spectra.schedule.empty() ? LodLevel{} : spectra.schedule.front()};
  levels.insert(levels.end(), spectra.discrete.begin(), spectra.discrete.end());
  return levels;
}

// Of the triangles of leaves, where there are any.
std::string leaves_left(const Spectrum& leaves, std::uint32_t steps) {
  if (leaves.counts.empty() || leaves.counts[0] == 0) return {};
  return fmt::format("; {} of {} triangles of leaves are left", leaves.counts[steps], leaves.counts[0]);
}

// What was asked for and is not to be had.
void warn_of_levels(const Options& options, const LodSpectra& spectra,
                    const std::vector<std::uint64_t>& floating, Context& context) {
  const std::string file = options.input.string();
  const std::vector<double> shares = asked_shares(options);
  const double full = spectra.schedule.empty() ? 0 : spectra.schedule.front().triangles;
  for (std::size_t i = 0; i < spectra.discrete.size(); ++i) {
    const LodLevel& level = spectra.discrete[i];
    if (i < shares.size()) {
      const double asked = std::max(std::floor(shares[i] * full), static_cast<double>(options.min_triangles));
      if (level.triangles > asked)
        context.warn(
            fmt::format("{}: level {} has {} triangles, not the {} that were asked for: fewer are not "
                        "to be had by these methods{}",
                        file, i + 1, level.triangles, asked, leaves_left(spectra.leaves, level.leaf_steps)));
    }
    if (i > 0 && level.trunk_steps == spectra.discrete[i - 1].trunk_steps &&
        level.leaf_steps == spectra.discrete[i - 1].leaf_steps)
      context.warn(fmt::format("{}: levels {} and {} are the same", file, i, i + 1));
    if (floating[i + 1] > 0)
      context.warn(
          fmt::format("{}: {} leaves of level {} float; --trunk radii with --foliage collapse leaves none",
                      file, floating[i + 1], i + 1));
  }
}

void report_levels(const Options& options, const Tree& tree, const LodSpectra& spectra, Context& context) {
  Report& report = context.report();
  const FloatingLeaves floating(tree, spectra);
  std::vector<std::uint64_t> counts;
  Table table{.name = "levels",
              .columns = {"Level", "Triangles", "Share", "Trunk", "Leaves", "Error (m)", "From (m)",
                          "Floating leaves"},
              .rows = {}};
  const double full = spectra.schedule.empty() ? 0 : spectra.schedule.front().triangles;
  const std::vector<LodLevel> levels = with_full_detail(spectra);
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const LodLevel& l = levels[i];
    counts.push_back(floating.count(l));
    const auto part = [](const Spectrum& s, std::uint32_t steps) {
      return s.counts.empty() ? 0 : s.counts[steps];
    };
    table.rows.push_back({fmt::format("{}", i), fmt::format("{}", l.triangles),
                          number(full > 0 ? l.triangles / full : 1),
                          fmt::format("{}", part(spectra.trunk, l.trunk_steps)),
                          fmt::format("{}", part(spectra.leaves, l.leaf_steps)), number(l.error),
                          number(i == 0 ? 0 : l.distance), fmt::format("{}", counts.back())});
  }
  report.tables.push_back(std::move(table));
  warn_of_levels(options, spectra, counts, context);
  Curve curve{.name = "estimated error", .x = "triangles", .y = "metres", .points = {}};
  for (const LodLevel& l : spectra.schedule)
    curve.points.push_back({.label = {}, .x = static_cast<double>(l.triangles), .y = l.error});
  report.curves.push_back(std::move(curve));
}

// Names every level that errs too much, so that the limit need not be found by trial.
Result<void> check_errors(const Options& options, const LodSpectra& spectra,
                          const std::vector<SurfaceDistances>& surfaces) {
  if (!options.max_error) return {};
  std::string beyond;
  for (std::size_t i = 1; i < surfaces.size(); ++i) {
    const double error = std::max(surfaces[i].from_level.max, surfaces[i].from_source.max);
    if (error <= *options.max_error) continue;
    beyond += fmt::format("{}level {} ({} triangles) by {:.4g} m", beyond.empty() ? "" : ", ", i,
                          spectra.discrete[i - 1].triangles, error);
  }
  if (beyond.empty()) return {};
  return fail(Fault::limit, options.input.string(),
              fmt::format("measured to err: {}; --max-error allows {:.4g} m", beyond, *options.max_error),
              "ask for more triangles, or allow more error");
}

// A tree that is too small for levels loses those that it had.
Result<void> write_without_levels(const Options& options, const TreeFile& file,
                                  const std::optional<PackedTree>& packed, Context& context) {
  ContainerWriter writer(file.container());
  if (auto done = write_base(options, file, packed, writer, context); !done) return done;
  for (const char* section : {"LSTR", "LSLV", "LSLD", "FCEL", "FORD", "FVWS", "FVTR", "FVIS", "FPAR"})
    writer.remove(section);
  if (auto done = put_impostor(writer, {}); !done) return done;
  const auto bytes = writer.finish();
  if (!bytes) return std::unexpected(bytes.error());
  return context.write(options.output, {reinterpret_cast<const char*>(bytes->data()), bytes->size()});
}

Result<void> write(const Options& options, const TreeFile& file, const Tree& tree,
                   const std::optional<PackedTree>& packed, const LodSpectra& stored,
                   const BakedSpectra& baked, const std::optional<BakedImpostor>& impostor,
                   Context& context) {
  Stage stage = context.stage("write");
  ContainerWriter writer(file.container());
  if (auto done = write_base(options, file, packed, writer, context); !done) return done;
  const auto costs = put_spectra(writer, stored, options.coding, &tree);
  if (!costs) return std::unexpected(costs.error());
  for (const char* cells : {"FCEL", "FORD", "FVWS", "FVTR", "FVIS", "FPAR"}) writer.remove(cells);
  if (baked.cells) {
    if (auto done = put_foliage_cells(writer, *baked.cells); !done) return done;
  }
  if (auto done = put_impostor(writer, impostor ? impostor->atlas : ImpostorAtlas{}); !done) return done;
  const auto bytes = writer.finish();
  if (!bytes) return std::unexpected(bytes.error());
  stage.items(bytes->size(), "bytes");
  if (options.coding.coding == SpectrumCoding::small) {
    const auto tell = [&](const char* name, double error) {
      context.report().errors.push_back({name, error, "m", error, {}, {}, "the spectrum before coding"});
    };
    tell("quantisation of the trunk, largest", costs->trunk_error);
    tell("quantisation of the leaves, largest", costs->leaf_error);
    tell_streams({{"PACK", packed ? packed->streams : std::vector<StreamCost>{}},
                  {"LSTR", costs->trunk},
                  {"LSLV", costs->leaves}},
                 context);
  }
  return context.write(options.output, {reinterpret_cast<const char*>(bytes->data()), bytes->size()});
}

// What was asked for, and the page's strip; the distances of full detail and every level if they were
// measured.
Result<std::vector<SurfaceDistances>> measure(const Options& options, const Tree& tree, const Looks& looks,
                                              const BakedSpectra& baked,
                                              const std::optional<BakedImpostor>& impostor,
                                              Context& context) {
  const LodSpectra& spectra = baked.spectra;
  const std::vector<LodLevel> levels = with_full_detail(spectra);
  std::vector<LevelFigures> figures;
  std::vector<SurfaceDistances> surfaces;
  if (options.measure) figures = measure_levels(tree, spectra, looks, levels, options, context);
  if (options.measure || options.max_error) surfaces = measure_surfaces(tree, spectra, levels, context);
  if (options.sweep) sweep(tree, baked, looks, options, context);
  if (context.options().html.empty()) return surfaces;
  Stage stage = context.stage("draw");
  auto strip = level_strip(spectra, looks, {levels, figures, surfaces, impostor ? &*impostor : nullptr});
  if (!strip) return std::unexpected(strip.error());
  context.report().pictures.push_back(std::move(*strip));
  context.report().tables.push_back(column_meanings(context.report().tables));
  return surfaces;
}

}  // namespace

Result<void> run(const Options& options, Context& context) {
  if (auto right = check(options); !right) return right;
  if (auto writable = context.check_output(options.output); !writable) return writable;
  context.read(options.input, true);
  auto file = open_tree(options);
  if (!file) return std::unexpected(file.error());
  if (auto right = check_output(options, *file); !right) return right;
  auto tree = load(*file, context);
  if (!tree) return std::unexpected(tree.error());
  auto packed = pack_base(options, *file, *tree, context);
  if (!packed) return std::unexpected(packed.error());
  const std::uint64_t triangles = tree->trunk.triangles.size() + tree->leaves.triangles.size();
  if (options.threshold > 0 && triangles <= options.threshold) {
    context.warn(fmt::format("{}: {} triangles are not more than --threshold {}: written without levels",
                             options.input.string(), triangles, options.threshold));
    return write_without_levels(options, *file, *packed, context);
  }
  const TreeLooks looks(*tree, options.input, context);
  if (auto right = check_lines_points(options, *file); !right) return right;
  if (lines_points_alone(options)) {
    report_projections(*tree, options.views, context);
    return write_without_levels(options, *file, *packed, context);
  }
  if (options.cells_given && options.foliage != FoliageMethod::prune && !options.sweep)
    context.warn("--cells is of --foliage prune, and leaves collapse: it changes nothing");
  auto baked = make_spectra(*tree, looks.looks(), options, context);
  if (!baked) return std::unexpected(baked.error());
  LodSpectra* spectra = &baked->spectra;
  {
    Stage stage = context.stage("levels");
    choose_levels(options, largest_side(tree->header.bounds), *spectra, context);
    report_levels(options, *tree, *spectra, context);
    // Where only one border was asked for, the other one is that of the levels.
    if (baked->cells && (options.near || options.far))
      baked->cells->parameters.near = spectra->near, baked->cells->parameters.far = spectra->far;
    stage.items(spectra->discrete.size(), "levels");
  }
  if (options.lines_points) report_projections(*tree, options.views, context);
  std::optional<BakedImpostor> impostor;
  if (options.impostor > 0) {
    auto made = bake_impostor(*spectra, looks, options, context);
    if (!made) return std::unexpected(made.error());
    impostor = std::move(*made);
  }
  const auto surfaces = measure(options, *tree, looks.looks(), *baked, impostor, context);
  if (!surfaces) return std::unexpected(surfaces.error());
  if (auto within = check_errors(options, *spectra, *surfaces); !within) return within;
  // Without --continuous the file has what the discrete levels need and no more.
  const LodSpectra stored = options.continuous ? *spectra : discrete_spectra(*spectra);
  if (auto done = number_leaves(stored.leaves, *packed, *tree); !done) return done;
  return write(options, *file, *tree, *packed, stored, *baked, impostor, context);
}

}  // namespace copse::lodbake
