#include "tools/bvfit/run.h"

#include "tools/bvfit/compare.h"
#include "tools/bvfit/draw.h"
#include "tools/bvfit/fits.h"
#include "tools/bvfit/hierarchy.h"
#include "tools/bvfit/input.h"
#include "tools/bvfit/store.h"
#include "tools/bvfit/sweep.h"
#include "tools/bvfit/table.h"
#include "tools/bvfit/verify.h"
#include "tools/bvfit/volumes_json.h"
#include "tools/common/outputs.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace copse::bvfit {
namespace {

bool is_tree_name(const std::filesystem::path& path) {
  return path.extension() == ".tree" || path.extension() == ".stree";
}

// What only a person reads must have somewhere to go.
Result<void> check_printed(const Options& options, const CommonOptions& common) {
  const char* name = options.sweep                 ? "--sweep"
                     : options.compare_hierarchies ? "--compare-hierarchies"
                     : options.tune                ? "--tune"
                                                   : nullptr;
  if (name == nullptr) return {};
  const char* instead = !options.verify.empty()     ? "--verify"
                        : common.quiet              ? "-q"
                        : is_stdout(options.output) ? "-o -"
                                                    : nullptr;
  if (instead == nullptr) return {};
  const bool reported = options.verify.empty() && (!common.report.empty() || !common.html.empty());
  if (reported && !options.tune) return {};
  return fail(Fault::usage, "", fmt::format("with {} nothing is left of {}", instead, name),
              options.tune || !options.verify.empty()
                  ? fmt::format("leave {} out", instead)
                  : fmt::format("add --report or --html, or leave {} out", instead));
}

Result<void> check_options(const Options& options) {
  if (!options.aspect_tree.empty() && options.choose != Criterion::aspect && !options.tune)
    return fail(Fault::usage, "", "--aspect-tree changes nothing here",
                "add --choose aspect or --tune, or leave it out");
  if (!options.export_glb.empty() && !is_stdout(options.export_glb) &&
      options.export_glb.extension() != ".glb")
    return fail(Fault::usage, options.export_glb.string(), "--export-glb writes GLB alone", "name it .glb");
  if (options.output.empty() || is_stdout(options.output) || is_tree_name(options.output) ||
      options.output.extension() == ".json")
    return {};
  return fail(Fault::usage, options.output.string(), "the output's extension picks its kind",
              "name it .json, or .tree or .stree to store volumes in a tree");
}

struct Work {
  Input input;
  std::vector<PartSet> parts;
  std::vector<FitMethod> methods;
  Choosing choosing;
  std::vector<SetFit> sets;  // one a part, then one an inner node of the hierarchy
  std::vector<VolumeNode> nodes;
};

// With --sway every part has a second set: the envelope of its motion.
Result<void> add_envelopes(Work& work, double degrees) {
  const auto sway = Sway::make(work.input, round_up(degrees));
  if (!sway) return std::unexpected(sway.error());
  const std::size_t parts = work.parts.size();
  for (std::size_t i = 0; i < parts; ++i) {
    PartSet& part = work.parts[i];
    part.envelope = sway->envelope(part);
    part.sway = sway->degrees();
    PartSet envelope;
    envelope.part = part.part, envelope.index = part.index, envelope.motion = VolumeMotion::envelope;
    envelope.name = part.name + " envelope";
    envelope.sway = part.sway;
    envelope.points = part.envelope;
    work.parts.push_back(std::move(envelope));
  }
  return {};
}

Result<void> fit_stage(Work& work, const Options& options, Context& context) {
  Stage stage = context.stage("fit");
  auto sets = fit_sets(work.parts, work.methods, options, work.choosing, stage);
  if (!sets) return std::unexpected(sets.error());
  work.sets = std::move(*sets);
  stage.items(work.sets.size(), "sets");
  return {};
}

Result<void> hierarchy_stage(Work& work, const Options& options, Context& context) {
  if (options.hierarchy.empty()) return {};
  Stage stage = context.stage("hierarchy");
  auto h = build_hierarchy(options.hierarchy, work.parts, work.input);
  if (!h) return std::unexpected(h.error());
  if (auto ok = fit_hierarchy(*h, work.parts, work.methods, options, work.choosing, stage); !ok) return ok;
  work.nodes = stored_nodes(*h, work.sets);
  for (SetFit& set : h->inner) work.sets.push_back(std::move(set));
  return {};
}

// With --volumes all the rule chooses among the dissertation's types: a k-DOP, which knows more directions
// than any ratio, would be the smallest nearly always.
bool is_tuned_for(VolumeKind kind, const Options& options) {
  const bool extra = kind == VolumeKind::aabb || kind == VolumeKind::ellipsoid || kind == VolumeKind::kdop;
  return !extra || options.volumes != std::vector<std::string>{"all"};
}

// The aspect tree that comes nearest to the smallest volumes, told beside the one in use.
std::string tune(const Work& work, const Options& options) {
  std::vector<AspectSample> samples;
  for (const SetFit& set : work.sets) {
    AspectSample s{set.ratios, {}};
    s.volume.fill(std::numeric_limits<double>::infinity());
    for (const FittedVolume& v : set.volumes) {
      if (!is_tuned_for(v.method.kind, options)) continue;
      double& least = s.volume[static_cast<std::size_t>(v.method.kind)];
      least = std::min(least, v.measures.volume);
    }
    samples.push_back(s);
  }
  const AspectTree tuned = tune_aspect_tree(samples);
  const auto line = [&](const char* what, const AspectTree& tree) {
    const AspectAgreement a = agreement(tree, samples);
    if (!std::isfinite(a.excess))
      return fmt::format("    {:<8} picks types that were not fitted: {}\n", what, tree.text());
    return fmt::format("    {:<8} {:>5.1f} % the smallest, {:.3g} % over it on average: {}\n", what,
                       100 * a.agree, 100 * a.excess, tree.text());
  };
  return fmt::format("aspect trees on {} sets\n\n", samples.size()) + line("in use", work.choosing.aspect) +
         line("seed", AspectTree::seed()) + line("tuned", tuned) + "\n";
}

Result<void> write_output(const Work& work, const Options& options, Context& context) {
  if (options.output.empty()) return {};
  Stage stage = context.stage("write");
  if (!is_tree_name(options.output))
    return context.write(options.output, volumes_json(work.input, work.sets, work.nodes, options));
  const auto bytes = tree_with_volumes(work.input, work.sets, work.nodes);
  if (!bytes) return std::unexpected(bytes.error());
  stage.items(bytes->size(), "bytes");
  return context.write(options.output, {reinterpret_cast<const char*>(bytes->data()), bytes->size()});
}

Result<void> draw_stage(const Work& work, const Options& options, Context& context) {
  if (!options.export_glb.empty()) {
    Stage stage = context.stage("export");
    const auto glb = volumes_glb(work.input, work.sets, options.export_glb.filename().string(), context);
    if (!glb) return std::unexpected(glb.error());
    if (auto ok = context.write(options.export_glb, *glb); !ok) return ok;
  }
  if (context.options().html.empty()) return {};
  Stage stage = context.stage("draw");
  auto pictures = volume_pictures(work.input, work.sets, context);
  if (!pictures) return std::unexpected(pictures.error());
  context.report().pictures = std::move(*pictures);
  return {};
}

Result<void> check_outputs(const Options& options, Context& context) {
  for (const std::filesystem::path& path : {options.output, options.export_glb}) {
    if (path.empty()) continue;
    if (auto ok = context.check_output(path); !ok) return ok;
  }
  return {};
}

// What a person is told beside the table.
Result<std::string> extras(const Work& work, const Options& options, Context& context) {
  std::string text;
  if (options.tune) text += tune(work, options);
  if (options.compare_hierarchies) {
    const auto compared =
        compare_hierarchies(work.parts, work.sets, work.input, work.methods, options, work.choosing, context);
    if (!compared) return compared;
    text += *compared;
  }
  if (options.sweep) {
    std::vector<FitMethod> all;
    const auto methods = fit_methods();
    for (const FitMethod& m : methods) {
      if (std::any_of(work.methods.begin(), work.methods.end(),
                      [&](const FitMethod& w) { return w.kind == m.kind; }))
        all.push_back(m);
    }
    const auto swept = sweep(work.parts.front(), all, context);
    if (!swept) return swept;
    text += *swept;
  }
  return text;
}

}  // namespace

Result<void> run(const Options& options, Context& context) {
  if (auto ok = check_options(options); !ok) return ok;
  if (auto ok = check_printed(options, context.options()); !ok) return ok;
  if (!options.verify.empty()) return verify_volumes(options, context);
  auto methods = wanted_methods(options);
  if (!methods) return std::unexpected(methods.error());
  auto how = choosing(options);
  if (!how) return std::unexpected(how.error());
  if (auto ok = check_outputs(options, context); !ok) return ok;
  auto input = read_input(options.inputs, context);
  if (!input) return std::unexpected(input.error());
  auto parts = part_sets(*input, options.per);
  if (!parts) return std::unexpected(parts.error());
  if (!options.hierarchy.empty() || options.compare_hierarchies) {
    if (auto ok = check_hierarchy(options.hierarchy, *parts, *input); !ok) return ok;
  }
  Work work{std::move(*input), std::move(*parts), std::move(*methods), std::move(*how), {}, {}};
  const auto named = [&](Result<void> result) {
    if (!result && result.error().file.empty()) result.error().file = work.input.name;
    return result;
  };
  if (options.sway > 0) {
    if (auto ok = add_envelopes(work, options.sway); !ok) return ok;
  }
  if (auto ok = named(fit_stage(work, options, context)); !ok) return ok;
  const auto more = extras(work, options, context);
  if (!more) return std::unexpected(more.error());
  if (auto ok = named(hierarchy_stage(work, options, context)); !ok) return ok;
  if (const std::string text = dropped_text(work.sets); !text.empty()) context.warn(text);
  if (const std::string text = not_asked_text(work.sets); !text.empty()) context.warn(text);
  if (options.quality == FitQuality::exact) {
    if (const std::string text = unproven_text(work.sets); !text.empty()) context.warn(text);
  }
  report_fits(work.sets, context.report());
  if (auto ok = write_output(work, options, context); !ok) return ok;
  if (auto ok = draw_stage(work, options, context); !ok) return ok;
  if (!context.options().quiet && !is_stdout(options.output))
    context.print(table_text(work.input, work.sets) + *more);
  return {};
}

}  // namespace copse::bvfit
