#include "tools/bvfit/fits.h"

#include "tools/bvfit/measured_costs.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

namespace copse::bvfit {
namespace {

bool holds(const std::vector<std::string>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::string all_names() {
  std::string out;
  for (const FitMethod& m : fit_methods()) {
    if (out.find(m.name) == std::string::npos) out += fmt::format("{}{}", out.empty() ? "" : ", ", m.name);
  }
  return out;
}

Result<void> check_names(const Options& options) {
  for (const std::string& name : options.volumes) {
    if (name == "all" || volume_kind(name)) continue;
    return fail(Fault::usage, "", fmt::format("--volumes knows no '{}'", name),
                fmt::format("use all, {}", fmt::join(k_volume_names, ", ")));
  }
  for (const std::string& name : options.methods) {
    const auto all = fit_methods();
    const bool known =
        name == "all" || name == "best" || kdop_method(name) ||
        std::any_of(all.begin(), all.end(), [&](const FitMethod& m) { return m.name == name; });
    if (!known)
      return fail(Fault::usage, "", fmt::format("--methods knows no '{}'", name),
                  "use all, best, the even k of a k-DOP, " + all_names());
  }
  return {};
}

// Of each kind: what searches for the least volume, or, where only quick methods are wanted, all of those
// (the smallest of what they give is kept).
bool is_best(const FitMethod& m, FitQuality quality) {
  const auto all = fit_methods();
  const bool kind_has_quick =
      std::any_of(all.begin(), all.end(), [&](const FitMethod& o) { return o.kind == m.kind && o.quick; });
  // Of many points the hull alone takes longer than all closed forms.
  return quality == FitQuality::fast ? (m.quick && !m.on_hull) || !kind_has_quick : m.least;
}

Candidate candidate_of(const FittedVolume& v) {
  Candidate c{v.method.kind, v.measures, 0};
  if (const auto* k = std::get_if<Kdop<float>>(&v.volume)) c.slabs = k->normals.size();
  return c;
}

bool is_as_good_minimal(const FittedVolume& v, const FittedVolume& than) {
  return v.method.kind == VolumeKind::sphere && than.method.kind == VolumeKind::sphere && v.method.least &&
         v.measures.volume <= than.measures.volume;
}

// What was asked for by its name, and of the others of each kind the smallest, unless what was asked for is.
void keep_smallest(std::vector<FittedVolume>& volumes, const std::vector<std::string>& names) {
  std::array<std::size_t, k_volume_kinds> best;
  best.fill(volumes.size());
  for (std::size_t i = 0; i < volumes.size(); ++i) {
    std::size_t& b = best[static_cast<std::size_t>(volumes[i].method.kind)];
    const bool better = b == volumes.size() || volumes[i].measures.volume < volumes[b].measures.volume ||
                        is_as_good_minimal(volumes[i], volumes[b]);
    if (better) b = i;
  }
  std::vector<FittedVolume> kept;
  for (std::size_t i = 0; i < volumes.size(); ++i) {
    if (best[static_cast<std::size_t>(volumes[i].method.kind)] == i || holds(names, volumes[i].method.name))
      kept.push_back(std::move(volumes[i]));
  }
  volumes = std::move(kept);
}

// Of one kind; `otherwise` where there is none of it.
std::size_t smallest_of(VolumeKind kind, const std::vector<FittedVolume>& volumes, std::size_t otherwise) {
  std::size_t best = volumes.size();
  for (std::size_t i = 0; i < volumes.size(); ++i) {
    if (volumes[i].method.kind != kind) continue;
    if (best == volumes.size() || volumes[i].measures.volume < volumes[best].measures.volume ||
        is_as_good_minimal(volumes[i], volumes[best]))
      best = i;
  }
  return best == volumes.size() ? otherwise : best;
}

std::vector<FitMethod> methods_of(VolumeKind kind, const std::vector<FitMethod>& methods) {
  std::vector<FitMethod> out;
  for (const FitMethod& m : methods) {
    if (m.kind == kind) out.push_back(m);
  }
  return out;
}

AspectRatios ratios_of(const VolumeFitter& fitter) {
  const auto all = fit_methods();
  const auto turned = std::find_if(all.begin(), all.end(), [](const FitMethod& m) {
    return m.kind == VolumeKind::obb && m.name == "gaussian";
  });
  const auto box = fitter.fit(*turned, {.quality = FitQuality::fast});
  if (!box) return {};
  return aspect_ratios(to_double(std::get<OrientedBox<float>>(box->volume).half_extents));
}

template <class FitOne>
Result<std::vector<SetFit>> fit_each(std::size_t count, const FitOne& fit_one, Stage& stage) {
  std::vector<std::optional<Result<SetFit>>> results(count);
  std::atomic<std::size_t> done = 0;
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
    results[i] = fit_one(i);
    stage.progress(static_cast<double>(++done) / static_cast<double>(count));
  });
  std::vector<SetFit> fits;
  for (auto& result : results) {
    if (!*result) return std::unexpected(result->error());
    fits.push_back(std::move(**result));
  }
  return fits;
}

}  // namespace

Result<std::vector<FitMethod>> wanted_methods(const Options& options) {
  if (auto ok = check_names(options); !ok) return std::unexpected(ok.error());
  std::vector<FitMethod> out;
  const bool all_kinds = holds(options.volumes, "all"), all = holds(options.methods, "all"),
             best = holds(options.methods, "best");
  for (const FitMethod& m : fit_methods()) {
    if (!all_kinds && !holds(options.volumes, name_of(m.kind))) continue;
    if (all || holds(options.methods, m.name) || (best && is_best(m, options.quality))) out.push_back(m);
  }
  const bool slabs = all_kinds || holds(options.volumes, name_of(VolumeKind::kdop));
  for (const std::string& name : options.methods) {
    const auto method = kdop_method(name);
    const bool there =
        std::any_of(out.begin(), out.end(), [&](const FitMethod& m) { return m.name == name; });
    if (slabs && method && !there) out.push_back(*method);
  }
  if (out.empty()) {
    return fail(Fault::usage, "",
                fmt::format("none of the --volumes has a method '{}'", fmt::join(options.methods, ", ")),
                "use --methods best, or name a method of theirs");
  }
  return out;
}

Result<Choosing> choosing(const Options& options) {
  Choosing c{
      options.choose, options.costs == "measured" ? measured_costs() : table_costs(), options.expected, {}};
  if (!options.aspect_tree.empty()) {
    auto tree = AspectTree::parse(options.aspect_tree);
    if (!tree) return std::unexpected(tree.error());
    c.aspect = *tree;
  }
  return c;
}

std::size_t choose_volume(const SetFit& fit, const Choosing& choosing) {
  std::vector<Candidate> candidates;
  for (const FittedVolume& v : fit.volumes) candidates.push_back(candidate_of(v));
  std::size_t best = choose(candidates, choosing.criterion, choosing.costs, choosing.expected, fit.size);
  for (std::size_t i = 0; i < fit.volumes.size(); ++i) {
    if (is_as_good_minimal(fit.volumes[i], fit.volumes[best])) best = i;
  }
  return best;
}

std::string not_asked_text(std::span<const SetFit> fits) {
  std::size_t sets = 0;
  std::string names;
  for (std::size_t kind = 0; kind < k_volume_names.size(); ++kind) {
    const auto missed =
        static_cast<std::size_t>(std::count_if(fits.begin(), fits.end(), [&](const SetFit& f) {
          return f.not_asked == static_cast<VolumeKind>(kind);
        }));
    if (missed > 0) names += fmt::format("{}{}", names.empty() ? "" : ", ", k_volume_names[kind]);
    sets += missed;
  }
  if (sets == 0) return "";
  return fmt::format(
      "for {} of {} sets the aspect tree picks what was not asked for ({}), so the least "
      "volume was chosen: add it to --volumes",
      sets, fits.size(), names);
}

std::string unproven_text(std::span<const SetFit> fits) {
  constexpr double k_rounding = 1e-6;
  std::size_t searched = 0, unproven = 0;
  double worst = 0;
  std::string of;
  for (const SetFit& fit : fits) {
    for (const FittedVolume& v : fit.volumes) {
      const double wanted = exact_gap(v.method.kind);
      if (!v.method.least || !std::isfinite(wanted) || is_flat(v.measures, fit.size)) continue;
      ++searched;
      // What float32 adds on the way out is told apart.
      const double gap =
          v.lower_bound > 0 ? v.fitted / v.lower_bound - 1 : std::numeric_limits<double>::infinity();
      if (gap <= wanted + k_rounding) continue;
      ++unproven;
      if (gap / wanted <= worst) continue;
      worst = gap / wanted;
      const std::string over =
          std::isfinite(gap) ? fmt::format("{:.3g} % over its bound", 100 * gap) : "without a bound";
      of = fmt::format("{} ({}) of '{}', {} instead of {:.3g} %", name_of(v.method.kind), v.method.name,
                       fit.name, over, 100 * wanted);
    }
  }
  if (unproven == 0) return "";
  return fmt::format(
      "{} of {} searched volumes are not proven as near to the least as --quality exact promises; the "
      "worst is {}",
      unproven, searched, of);
}

std::string dropped_text(std::span<const SetFit> fits) {
  std::string names;
  for (std::size_t kind = 0; kind < k_volume_names.size(); ++kind) {
    const bool missing = std::any_of(fits.begin(), fits.end(), [&](const SetFit& fit) {
      return std::find(fit.dropped.begin(), fit.dropped.end(), static_cast<VolumeKind>(kind)) !=
             fit.dropped.end();
    });
    if (missing) names += fmt::format("{}{}", names.empty() ? "" : ", ", k_volume_names[kind]);
  }
  return names.empty() ? "" : "left out, as float32 cannot hold them: volumes of type " + names;
}

Result<SetFit> fit_set(const PartSet& set, const std::vector<FitMethod>& methods, const Options& options,
                       const Choosing& choosing) {
  const Deadline deadline = options.budget > 0 ? Deadline::after(options.budget) : Deadline();
  const auto fitter = VolumeFitter::make(set.points, set.triangles);
  if (!fitter) return std::unexpected(fitter.error());
  SetFit fit;
  fit.name = set.name, fit.part = set.part, fit.index = set.index, fit.motion = set.motion;
  fit.sway = set.motion == VolumeMotion::envelope ? set.sway : 0;
  fit.points = set.points.size();
  fit.size = length(fitter->cloud().box.extent()) * fitter->cloud().frame.scale;
  if (choosing.criterion == Criterion::aspect || options.tune) fit.ratios = ratios_of(*fitter);
  std::vector<FitMethod> wanted = methods;
  if (choosing.criterion == Criterion::aspect) {  // only what the tree picks is fitted, but to tune on
    const VolumeKind picked = choosing.aspect.choose(fit.ratios);
    std::vector<FitMethod> of_it = methods_of(picked, methods);
    if (of_it.empty()) {
      fit.not_asked = picked;
    } else if (!options.tune) {
      wanted = std::move(of_it);
    }
  }
  // What quick methods leave of their shares is the searches'.
  std::vector<std::size_t> order(wanted.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto needs_hull = std::stable_partition(
      order.begin(), order.end(), [&](std::size_t i) { return wanted[i].quick && !wanted[i].on_hull; });
  std::vector<std::optional<FittedVolume>> fitted(wanted.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    // All that follow work on it, so it gets more than one method's share.
    if (order.begin() + static_cast<std::ptrdiff_t>(k) == needs_hull) fitter->hull(deadline.share(3));
    fitted[order[k]] = fitter->fit(wanted[order[k]], {options.quality, deadline.share(order.size() - k)});
  }
  if (fitter->has_hull()) {
    fit.hull_points = fitter->hull().vertices.size();
    fit.hull_loss = fitter->hull().loss * fitter->cloud().frame.scale;
  }
  fit.hull_seconds = fitter->hull_seconds();
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (fitted[i]) {
      fit.volumes.push_back(std::move(*fitted[i]));
    } else {
      fit.dropped.push_back(wanted[i].kind);
    }
  }
  if (fit.volumes.empty()) return refuse("", set.name + " is too large for float32", "use a smaller scale");
  fitter->share_lower_bounds(fit.volumes);
  if (holds(options.methods, "best") && !holds(options.methods, "all"))
    keep_smallest(fit.volumes, options.methods);
  fit.chosen = choose_volume(fit, choosing);
  if (choosing.criterion == Criterion::aspect)
    fit.chosen = smallest_of(choosing.aspect.choose(fit.ratios), fit.volumes, fit.chosen);
  const VolumeMeasures& chosen = fit.volumes[fit.chosen].measures;
  fit.chosen_as_flat = choosing.criterion != Criterion::expected && is_flat(chosen, fit.size) &&
                       std::any_of(fit.volumes.begin(), fit.volumes.end(),
                                   [&](const FittedVolume& v) { return v.measures.volume < chosen.volume; });
  return fit;
}

Result<std::vector<SetFit>> fit_sets(std::span<const PartSet> sets, const std::vector<FitMethod>& methods,
                                     const Options& options, const Choosing& choosing, Stage& stage) {
  return fit_each(
      sets.size(), [&](std::size_t i) { return fit_set(sets[i], methods, options, choosing); }, stage);
}

Result<std::vector<SetFit>> fit_sets(std::size_t count, const std::function<PartSet(std::size_t)>& make,
                                     const std::vector<FitMethod>& methods, const Options& options,
                                     const Choosing& choosing, Stage& stage) {
  return fit_each(
      count, [&](std::size_t i) { return fit_set(make(i), methods, options, choosing); }, stage);
}

}  // namespace copse::bvfit
