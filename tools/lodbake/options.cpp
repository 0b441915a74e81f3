#include "tools/lodbake/options.h"

#include "tools/common/option_values.h"
#include "tools/lodbake/level_distances.h"
#include "tools/lodbake/run.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace copse::lodbake {

ToolInfo info() {
  return {.name = "lodbake",
          .summary =
              "Bakes the levels of detail of a tree: one file from which a program takes any level, from "
              "full detail to "
              "a handful of triangles, with its leaves, its silhouette and its structure.",
          .examples =
              {{"lodbake oak.stree -o oak.lod.stree --discrete 0.66,0.33,0.15 --continuous",
                "three levels to switch between, and everything in between"},
               {"lodbake oak.stree -o small.stree --discrete-error 0.05,0.2 --encode small --report oak.json",
                "levels by error in metres, as few bytes as possible"}},
          .limits = {{"levels of --discrete", k_max_discrete, "levels"},
                     {"side of an impostor's atlas", k_max_impostor_side, "pixels"}}};
}

namespace {

constexpr int k_impostor_pixels = 128;  // a side, when only the name is given

void take_methods(const std::vector<std::string>& names, Options& options) {
  options.methods = names;
  for (const std::string& name : names) {
    if (name == "radii") options.trunk = TrunkMethod::radii;
    if (name == "edges") options.trunk = TrunkMethod::edges;
    if (name == "collapse") options.foliage = FoliageMethod::collapse;
    if (name == "prune") options.foliage = FoliageMethod::prune;
    if (name == "lines-points") options.lines_points = true;
    if (name == "impostor" && options.impostor == 0) options.impostor = k_impostor_pixels;
  }
}

// Notes that an option was named.
auto given(bool& flag) {
  return [&flag](const std::string&) { flag = true; };
}

// What a runtime makes of the cells of --foliage prune (erratum P19).
void add_pruning(CLI::App& group, Options& options) {
  PruningOptions& p = options.pruning;
  using P = FoliageParameters;
  const auto note = given(options.pruning_given);
  add_choice<P::Ramp>(group, "--prune-ramp", p.ramp,
                      "of --foliage prune: leaves fall straight from --near to --far, or by equation 1",
                      {{"linear", P::Ramp::linear}, {"power", P::Ramp::power}})
      ->type_name("linear|power")
      ->each(note);
  group
      .add_option("--prune-half", p.half_distance,
                  "of --prune-ramp power: the multiple of --near at which half of the leaves are left")
      ->check(number_above(1))
      ->type_name("H")
      ->each(note)
      ->capture_default_str();
  group
      .add_option("--prune-least", p.least,
                  "of --foliage prune: share of the leaves that is left from --far on")
      ->check(number_between(0, 1))
      ->type_name("F")
      ->each(note)
      ->capture_default_str();
  group
      .add_option("--prune-growth", p.largest_enlargement,
                  "of --foliage prune: by so much the area of a leaf grows at most")
      ->check(number_between(1, 1e6))
      ->type_name("G")
      ->each(note)
      ->capture_default_str();
  add_choice<P::Distance>(group, "--prune-distance", p.distance,
                          "of --foliage prune: how far away each cell is, or the tree",
                          {{"cell", P::Distance::cell}, {"tree", P::Distance::tree}})
      ->type_name("cell|tree")
      ->each(note);
  add_choice<P::Compensation>(
      group, "--prune-compensation", p.compensation,
      "of --foliage prune: leaves grow for those that distance takes, or for hidden ones too",
      {{"distance", P::Compensation::distance}, {"total", P::Compensation::total}})
      ->type_name("distance|total")
      ->each(note);
}

}  // namespace

void add_options(CLI::App& app, Options& options) {
  app.add_option("INPUT", options.input, "a .tree or .stree file, as treeprep writes it")
      ->required()
      ->type_name("FILE");
  app.add_option("-o,--output", options.output, "the same tree with its levels")
      ->required()
      ->type_name("FILE");

  CLI::Option_group* levels = app.add_option_group("Which levels");
  auto* discrete = levels
                       ->add_option("--discrete", options.discrete,
                                    "levels with these shares of the triangles, descending")
                       ->delimiter(',')
                       ->type_name("R,...")
                       ->check(number_between(0, 1));
  levels
      ->add_option("--discrete-error", options.discrete_error,
                   "the coarsest levels whose error is estimated to be within these, metres, ascending")
      ->delimiter(',')
      ->type_name("E,...")
      ->check(number_from(0))
      ->excludes(discrete);
  levels->add_flag("--continuous", options.continuous,
                   "store every level in between too; without it the file has only what the discrete "
                   "levels need");
  levels->add_option("--min-triangles", options.min_triangles, "no level has fewer")
      ->check(whole_number_from(0))
      ->type_name("N")
      ->capture_default_str();
  levels
      ->add_option("--threshold", options.threshold, "a tree with no more triangles than this gets no levels")
      ->check(whole_number_from(0))
      ->type_name("N")
      ->capture_default_str();
  levels->add_option("--near", options.near, "full detail up to this distance in metres")
      ->type_name("D")
      ->check(number_from(0));
  levels->add_option("--medium", options.medium, "the second level begins here")
      ->type_name("D")
      ->check(number_above(0));
  levels->add_option("--far", options.far, "the last level begins here")
      ->type_name("D")
      ->check(number_above(0));
  levels
      ->add_option("--hysteresis", options.hysteresis,
                   "switching back happens this share of the distance later, percent")
      ->type_name("P")
      ->check(number_between(0, 99))
      ->capture_default_str();
  levels
      ->add_option("--max-error", options.max_error,
                   "refuse (exit status 4) when the surface of a discrete level is measured to be farther "
                   "from that of full "
                   "detail, metres")
      ->type_name("E")
      ->check(number_from(0));

  CLI::Option_group* methods = app.add_option_group("How they are made");
  methods
      ->add_option_function<std::vector<std::string>>(
          "--method", [&options](const std::vector<std::string>& names) { take_methods(names, options); },
          "the systems by name: radii or edges for the trunk, collapse or prune for the leaves, impostor, "
          "lines-points; lines-points alone bakes nothing else")
      ->delimiter(',')
      ->type_name("NAME,...")
      ->check(CLI::IsMember({"radii", "edges", "collapse", "prune", "impostor", "lines-points"}));
  add_choice<TrunkMethod>(*methods, "--trunk", options.trunk,
                          "by radii (rings, sides, ribbons) or by edge collapses",
                          {{"radii", TrunkMethod::radii}, {"edges", TrunkMethod::edges}})
      ->type_name("radii|edges")
      ->each(given(options.trunk_given));
  add_choice<RemovalOrder>(
      *methods, "--removal", options.removal,
      "of --trunk radii: which rings go first, by what the silhouette loses, by the angle "
      "of the axis there (real, or as level views see it), or the thinnest",
      {{"silhouette", RemovalOrder::silhouette},
       {"angle", RemovalOrder::angle},
       {"projected-angle", RemovalOrder::projected_angle},
       {"diameter", RemovalOrder::diameter}})
      ->type_name("silhouette|angle|projected-angle|diameter");
  add_choice<FoliageMethod>(
      *methods, "--foliage", options.foliage,
      "leaves become one bigger, two at a time, or vanish in stratified random order, cell by cell",
      {{"collapse", FoliageMethod::collapse}, {"prune", FoliageMethod::prune}})
      ->type_name("collapse|prune")
      ->each(given(options.foliage_given));
  add_choice<CollapseQuality>(
      *methods, "--quality", options.quality,
      "of --foliage collapse; fast: closed forms; balanced: pictures decide, seen at some points; exact: all "
      "of their pixels, and more candidates",
      {{"fast", CollapseQuality::fast},
       {"balanced", CollapseQuality::balanced},
       {"exact", CollapseQuality::exact}})
      ->type_name("fast|balanced|exact")
      ->each(given(options.quality_given));
  methods
      ->add_option(
          "--cells", options.cells,
          "of --foliage prune: at most so many cells, each with its visibility from --views directions")
      ->check(whole_number_from(1, 1 << 20))
      ->each(given(options.cells_given))
      ->type_name("N")
      ->capture_default_str();
  add_pruning(*methods, options);
  methods
      ->add_option("--impostor", options.impostor,
                   "behind the last level the tree as pictures, so many pixels a side each")
      ->check(whole_number_from(8, 1024))
      ->type_name("SIZE")
      ->default_str("");
  methods
      ->add_option("--impostor-views", options.impostor_views,
                   "views along a side of the atlas, or round the trunk of a billboard")
      ->check(whole_number_from(1, k_max_impostor_views))
      ->type_name("N")
      ->each(given(options.impostor_views_given))
      ->capture_default_str();
  add_choice<ImpostorLayout>(
      *methods, "--impostor-layout", options.impostor_layout,
      "views from everywhere (octahedral), or level ones round the trunk (billboard)",
      {{"octahedral", ImpostorLayout::octahedral}, {"billboard", ImpostorLayout::billboard}})
      ->type_name("octahedral|billboard")
      ->each(given(options.impostor_layout_given));
  methods->add_flag("--lines-points", options.lines_points,
                    "refuse a tree that lacks what lines and points are drawn from (segments by diameter, "
                    "accumulated lengths, leaf centres, groups in order)");
  add_choice<Division>(
      *methods, "--divide", options.division,
      "triangles between trunk and leaves: as the picture is best, or the same share to each",
      {{"picture", Division::picture}, {"even", Division::even}})
      ->type_name("picture|even");

  CLI::Option_group* measuring = app.add_option_group("How wrong they are (into --report and --html)");
  measuring->add_flag("--measure", options.measure,
                      "area, coverage, silhouette and image error of every level");
  measuring->add_flag("--sweep", options.sweep,
                      "the same for every method, and for meshoptimizer at the same triangle counts");
  measuring->add_option("--views", options.views, "directions from which is measured, at least")
      ->check(whole_number_from(1, 642))
      ->type_name("N")
      ->capture_default_str();

  CLI::Option_group* file = app.add_option_group("How they are stored");
  add_choice<SpectrumCoding>(*file, "--encode", options.coding.coding,
                             "fast: exact, as it lies in memory; small: quantised and compressed",
                             {{"fast", SpectrumCoding::fast}, {"small", SpectrumCoding::small}})
      ->type_name("fast|small");
  file->add_option("--position-bits", options.coding.position_bits,
                   "of --encode small: bits of the longest side of the box")
      ->check(whole_number_from(8, 16))
      ->type_name("N")
      ->capture_default_str();
}

namespace {

std::unexpected<Error> usage(std::string what, std::string remedy) {
  return fail(Fault::usage, "", std::move(what), std::move(remedy));
}

bool names(const Options& options, std::string_view method) {
  return std::find(options.methods.begin(), options.methods.end(), method) != options.methods.end();
}

// What is named twice must be the same both times.
Result<void> check_methods(const Options& options) {
  const auto conflict = [&](const char* one, const char* other, bool given, bool is_one) {
    return (names(options, one) && names(options, other)) || (given && names(options, is_one ? other : one));
  };
  if (conflict("radii", "edges", options.trunk_given, options.trunk == TrunkMethod::radii))
    return usage("--method: the trunk goes by radii or by edges, not by both", "name one of them");
  if (conflict("collapse", "prune", options.foliage_given, options.foliage == FoliageMethod::collapse))
    return usage("--method: leaves collapse or are pruned, not both", "name one of them");
  if (options.quality_given && options.foliage == FoliageMethod::prune)
    return usage("--quality is of --foliage collapse, and leaves are to be pruned", "drop one of them");
  if (options.pruning_given && options.foliage != FoliageMethod::prune && !options.sweep)
    return usage("the options --prune-... are of --foliage prune, and leaves collapse",
                 "drop them, or add --foliage prune");
  if (lines_points_alone(options) && (options.continuous || !options.discrete.empty() ||
                                      !options.discrete_error.empty() || options.impostor > 0))
    return usage("--method lines-points bakes no levels, and levels are asked for",
                 "name the other methods too, or use --lines-points");
  return {};
}

}  // namespace

bool lines_points_alone(const Options& options) {
  return !options.methods.empty() &&
         std::all_of(options.methods.begin(), options.methods.end(),
                     [](const std::string& name) { return name == "lines-points"; }) &&
         !options.trunk_given && !options.foliage_given;
}

Result<void> check(const Options& options) {
  if (auto right = check_methods(options); !right) return right;
  if (options.discrete.size() > k_max_discrete || options.discrete_error.size() > k_max_discrete)
    return usage("too many levels are named", fmt::format("name at most {}", k_max_discrete));
  if (!std::is_sorted(options.discrete.begin(), options.discrete.end(), std::greater_equal<>()))
    return usage("--discrete: the shares do not fall", "name them in descending order, each once");
  if (!std::is_sorted(options.discrete_error.begin(), options.discrete_error.end(), std::less_equal<>()))
    return usage("--discrete-error: the errors do not grow", "name them in ascending order, each once");
  if (auto right = check_distances(options); !right) return right;
  if ((options.impostor_views_given || options.impostor_layout_given) && options.impostor == 0)
    return usage("--impostor-views and --impostor-layout are of an impostor, and none is asked for",
                 "add --impostor SIZE or --method impostor");
  if (static_cast<std::uint32_t>(options.impostor * options.impostor_views) > k_max_impostor_side)
    return usage("--impostor: the atlas is too large",
                 fmt::format("let SIZE times --impostor-views be at most {}", k_max_impostor_side));
  return {};
}

}  // namespace copse::lodbake
