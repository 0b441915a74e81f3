#include "lib/analysis/skeleton/limb_samples.h"

#include "lib/analysis/rings/axis.h"
#include "lib/analysis/rings/polyline_simplification.h"
#include "lib/analysis/surface/welded_tolerances.h"

#include <algorithm>
#include <cmath>

namespace copse {

namespace {

RingCircle between(const LimbSample& a, const LimbSample& b, double way) {
  const double gap = b.way - a.way, at = gap > 0 ? std::clamp((way - a.way) / gap, 0.0, 1.0) : 0;
  return {a.circle.centre + (b.circle.centre - a.circle.centre) * at,
          a.circle.radius + (b.circle.radius - a.circle.radius) * at};
}

}  // namespace

LimbProfile limb_profile(const CurveSkeleton& skeleton, const Limb& limb) {
  LimbProfile p;
  double way = 0;
  for (std::size_t i = 0; i < limb.nodes.size(); ++i) {
    if (i > 0) way += distance(skeleton.points[limb.nodes[i]], skeleton.points[limb.nodes[i - 1]]);
    p.way.push_back(way);
    p.thickness.push_back(skeleton.radii[limb.nodes[i]]);
  }
  const std::size_t n = p.way.size();
  for (std::size_t i = 1; i < n; ++i) {
    p.thickness[i] =
        std::max(p.thickness[i], p.thickness[i - 1] - k_steepest_taper * (p.way[i] - p.way[i - 1]));
  }
  for (std::size_t i = n; i-- > 1;) {
    p.thickness[i - 1] =
        std::max(p.thickness[i - 1], p.thickness[i] - k_steepest_taper * (p.way[i] - p.way[i - 1]));
  }
  return p;
}

Double3 LimbSampler::point_at(const Limb& limb, const LimbProfile& profile, double way,
                              std::uint32_t& node) const {
  const auto next = std::ranges::lower_bound(profile.way, way);
  const auto i = static_cast<std::size_t>(
      std::min(next - profile.way.begin(), static_cast<std::ptrdiff_t>(profile.way.size()) - 1));
  node = static_cast<std::uint32_t>(i);
  const Double3 b = k_.points[limb.nodes[i]];
  if (i == 0) return b;
  const Double3 a = k_.points[limb.nodes[i - 1]];
  const double gap = profile.way[i] - profile.way[i - 1];
  const double at = gap > 0 ? std::clamp((way - profile.way[i - 1]) / gap, 0.0, 1.0) : 1;
  if (at < 0.5) --node;
  return a + (b - a) * at;
}

std::vector<LimbSample> LimbSampler::spread(const Limb& limb, const LimbProfile& profile,
                                            std::span<const LimbFork> forks, double clearance) const {
  const double length = profile.way.back();
  std::vector<LimbSample> fixed;
  const bool is_child = limb.parent != k_none;
  const double start = is_child ? std::min(clearance, length / 2) : 0;
  fixed.push_back({{}, start, 0, false, false});
  for (const LimbFork& f : forks) {
    const double way = std::clamp(profile.way[f.node], start, length);
    if (way - fixed.back().way >= profile.thickness[f.node] / 2) fixed.push_back({{}, way, 0, true, false});
    fixed.back().fork = true;
  }
  if (length - fixed.back().way < profile.thickness.back() / 2 && fixed.size() > 1 && !fixed.back().fork) {
    fixed.pop_back();
  }
  if (length > fixed.back().way) fixed.push_back({{}, length, 0, false, false});

  std::vector<LimbSample> samples;
  const double finest =
      std::max(length * k_least_size, std::ranges::max(profile.thickness) * k_least_spacing);
  for (std::size_t i = 0; i + 1 < fixed.size(); ++i) {
    const double from = fixed[i].way, to = fixed[i + 1].way;
    samples.push_back(fixed[i]);
    // Steps that grow and shrink with the limb, stretched to end where the next fixed sample is.
    std::vector<double> steps;
    double way = from;
    while (way < to) {
      std::uint32_t node = 0;
      point_at(limb, profile, way, node);
      way += k_sample_spacing * std::max(profile.thickness[node], finest);
      steps.push_back(way);
    }
    const bool drop = steps.size() > 1 && steps.back() - to > to - steps[steps.size() - 2];
    if (drop) steps.pop_back();
    const double stretch = steps.empty() ? 1 : (to - from) / (steps.back() - from);
    for (std::size_t j = 0; j + 1 < steps.size(); ++j) {
      samples.push_back({{}, from + (steps[j] - from) * stretch, 0, false, false});
    }
  }
  samples.push_back(fixed.back());
  for (LimbSample& s : samples) {
    s.circle.centre = point_at(limb, profile, s.way, s.node);
    s.circle.radius = profile.thickness[s.node];
  }
  return samples;
}

bool LimbSampler::measure(const Limb& limb, LimbSample& sample, const Double3& normal, double thickness) {
  seeds_.clear();
  const std::size_t n = limb.nodes.size();
  for (std::size_t reach = 0; reach < n && seeds_.empty(); ++reach) {
    const std::size_t from = sample.node > reach ? sample.node - reach : 0,
                      to = std::min<std::size_t>(sample.node + reach + 1, n);
    for (std::size_t i = from; i < to; ++i) {
      const auto triangles = k_.triangles[limb.nodes[i]];
      seeds_.insert(seeds_.end(), triangles.begin(), triangles.end());
    }
    if (reach > k_seed_reach) break;
  }
  RingCircle c;
  if (!sections_.cut(sample.circle.centre, normal, seeds_, c)) return false;
  const double reach = std::max(thickness, c.radius);
  if (distance(c.centre, sample.circle.centre) > reach || c.radius > k_widest_section * thickness)
    return false;
  sample.circle = c;
  return true;
}

void LimbSampler::recentre(const Limb& limb, const LimbProfile& profile, std::vector<LimbSample>& samples) {
  std::vector<Double3> normals(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    // The skeleton's own ends lie anywhere on the surface's: beside one the limb's inner side alone tells its
    // way.
    const bool by_base = i == 1 && limb.parent == k_none && samples.size() > 3;
    const bool by_tip = i + 2 == samples.size() && samples.size() > 3;
    const std::size_t last = i > 0 && !by_base ? i - 1 : i,
                      next = i + 1 < samples.size() && !by_tip ? i + 1 : i;
    normals[i] = normalized(samples[next].circle.centre - samples[last].circle.centre);
  }
  // Where the surface ends, a plane at right angles to the limb misses some of it: finish_end() sees to
  // those.
  const std::size_t from = limb.parent == k_none ? 1 : 0;
  for (std::size_t i = from; i + 1 < samples.size(); ++i) {
    samples[i].measured = measure(limb, samples[i], normals[i], profile.thickness[samples[i].node]);
  }
}

// The circle of the border that the limb ends at, if it does.
bool LimbSampler::end_at_border(const Limb& limb, const LimbProfile& profile, const Double3& out,
                                LimbSample& end, bool tip) {
  const double thickness = profile.thickness[end.node];
  const std::size_t n = limb.nodes.size();
  std::vector<Double3> points;
  for (std::size_t i = 0; i < n && points.empty(); ++i) {
    const std::size_t at = tip ? n - 1 - i : i;
    if (std::abs(profile.way[at] - end.way) > thickness) break;
    for (const std::uint32_t t : k_.triangles[limb.nodes[at]]) {
      for (std::size_t e = 0; e < 3 && points.empty(); ++e) {
        if (s_.across[t][e] != k_none) continue;
        for (const std::uint32_t v : border_loop(s_, t, e)) points.push_back(s_.positions[v]);
      }
    }
  }
  if (points.size() < 3) return false;
  const RingCircle c = sections_.circle_round(points, out);
  if (c.radius > k_widest_section * thickness || c.radius * k_widest_section < thickness) return false;
  end.circle = c;
  return true;
}

// Moves the first or last sample to where the surface ends: on its border, or, where the end is closed, as
// far as the surface goes; there the limb is measured shortly before the end.
void LimbSampler::finish_end(const Limb& limb, const LimbProfile& profile, std::vector<LimbSample>& samples,
                             bool tip) {
  LimbSample& end = tip ? samples.back() : samples.front();
  const LimbSample& inner = tip ? samples[samples.size() - 2] : samples[1];
  const double thickness = profile.thickness[end.node];
  Double3 out = normalized(end.circle.centre - inner.circle.centre);
  if (samples.size() > 3) {  // straight on, unless the limb bends away: the last slices are torn
    const LimbSample& before = tip ? samples[samples.size() - 3] : samples[2];
    const Double3 on = normalized(inner.circle.centre - before.circle.centre);
    const bool is_short = distance(end.circle.centre, inner.circle.centre) < k_end_stretch * thickness;
    const double bend = dot(on, out);
    if (before.measured && inner.measured && (bend > k_straight_on || (is_short && bend > 0))) out = on;
  }
  if ((end.measured = end_at_border(limb, profile, out, end, tip))) return;
  double farthest = 0;
  const std::size_t n = limb.nodes.size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t at = tip ? n - 1 - i : i;
    if (std::abs(profile.way[at] - end.way) > profile.thickness[at]) break;
    for (const std::uint32_t v : vertices_of_[limb.nodes[at]]) {
      const Double3 from = s_.positions[v] - inner.circle.centre;
      const double along = dot(from, out);
      if (length(from - out * along) <= k_end_width * thickness) farthest = std::max(farthest, along);
    }
  }
  if (farthest == 0) return;
  LimbSample shortly_before = end;
  shortly_before.circle.centre = inner.circle.centre + out * (farthest * k_end_section);
  end.measured = measure(limb, shortly_before, out, thickness);
  end.circle.centre = inner.circle.centre + out * farthest;
  if (!end.measured) return;
  const Double3 moved = shortly_before.circle.centre - inner.circle.centre;
  end.circle.centre += moved - out * dot(moved, out);
  end.circle.radius = shortly_before.circle.radius;
}

std::vector<LimbSample> LimbSampler::sample(const Limb& limb, const LimbProfile& profile,
                                            std::span<const LimbFork> forks, double clearance) {
  std::vector<LimbSample> samples = spread(limb, profile, forks, clearance);
  for (int round = 0; round < k_section_rounds; ++round) recentre(limb, profile, samples);
  if (samples.size() > 1) {
    finish_end(limb, profile, samples, true);
    if (limb.parent == k_none) finish_end(limb, profile, samples, false);
  }
  bridge_gaps(samples, forks);
  return samples;
}

namespace {

// Replaces the circles of what is not marked by what the nearest marked ones on both sides imply.
void interpolate(std::span<LimbSample> samples, std::span<const std::uint8_t> marked) {
  std::size_t last = samples.size();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (!marked[i]) continue;
    for (std::size_t j = last + 1; last < samples.size() && j < i; ++j) {
      samples[j].circle = between(samples[last], samples[i], samples[j].way);
    }
    last = i;
  }
}

}  // namespace

void bridge_gaps(std::span<LimbSample> samples, std::span<const LimbFork> forks) {
  const std::size_t n = samples.size();
  std::vector<int> forks_begin(n + 1, 0);  // how many forks' stretches begin at a sample, less those that end
  for (const LimbFork& f : forks) {
    const auto from = std::ranges::lower_bound(samples, f.from, {}, &LimbSample::way) - samples.begin();
    const auto to = std::ranges::upper_bound(samples, f.to, {}, &LimbSample::way) - samples.begin();
    if (from < to) ++forks_begin[static_cast<std::size_t>(from)], --forks_begin[static_cast<std::size_t>(to)];
  }
  std::vector<std::uint8_t> clean(n, 0), measured(n, 0);
  int forks_here = 0;
  for (std::size_t i = 0; i < n; ++i) {
    forks_here += forks_begin[i];
    measured[i] = samples[i].measured;
    clean[i] = measured[i] && (i == 0 || i + 1 == n || forks_here == 0);
  }
  // What the clean ones imply is what the others are judged by: a section that takes in another limb is
  // wider.
  std::vector<LimbSample> implied(samples.begin(), samples.end());
  if (std::ranges::count(clean, 1) > 1) {
    interpolate(implied, clean);
    for (std::size_t i = 0; i < n; ++i) {
      if (!clean[i] && samples[i].circle.radius > k_bulge * implied[i].circle.radius) measured[i] = 0;
    }
  }
  for (std::size_t i = 1; i + 1 < n; ++i) {
    if (!measured[i - 1] || !measured[i] || !measured[i + 1]) continue;
    const double widest = std::max(samples[i - 1].circle.radius, samples[i + 1].circle.radius);
    if (samples[i].circle.radius > k_bulge * widest) measured[i] = 0;
  }
  interpolate(samples, measured);
}

std::vector<LimbSample> thin_out(const std::vector<LimbSample>& samples) {
  std::vector<std::uint8_t> keep;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    keep.push_back(i == 0 || i + 1 == samples.size() || samples[i].fork);
  }
  const double least_size = samples.back().way * k_least_size;
  simplify_polyline(keep, [&](std::size_t a, std::size_t b, std::size_t i) {
    const RingCircle& c = samples[i].circle;
    const Double3 &pa = samples[a].circle.centre, &pb = samples[b].circle.centre;
    const double at = nearest_on_segment(pa, pb, c.centre);
    const double radius =
        samples[a].circle.radius + (samples[b].circle.radius - samples[a].circle.radius) * at;
    const double off = distance(pa + (pb - pa) * at, c.centre) + std::abs(radius - c.radius);
    const double gap = samples[b].way - samples[a].way;
    const double wider = std::max(samples[a].circle.radius, samples[b].circle.radius);
    const double size = std::max({c.radius, wider / 4, least_size});
    // Of samples that are as far off, the middle one; so a limb that is too long for one segment is halved.
    const double middle = 1 - std::abs(static_cast<double>(2 * i) - static_cast<double>(a + b)) /
                                  static_cast<double>(2 * (b - a));
    return size > 0 ? std::max(off / (k_sample_tolerance * size), gap / (k_sample_gap * size) * middle) : 0;
  });
  std::vector<LimbSample> kept;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (keep[i]) kept.push_back(samples[i]);
  }
  return kept;
}

}  // namespace copse
