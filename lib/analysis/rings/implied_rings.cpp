#include "lib/analysis/rings/implied_rings.h"

#include "lib/analysis/rings/axis.h"
#include "lib/analysis/rings/polyline_simplification.h"
#include "lib/analysis/surface/welded_tolerances.h"

#include <algorithm>
#include <cmath>

namespace copse {

namespace {

class Thinning {
 public:
  explicit Thinning(const Hierarchy& h) : h_(h), keep_(h.radii.size(), 0), next_(h.radii.size(), k_none) {}

  Hierarchy run() {
    keep_fixed();
    // Every chain of rings between two that stay, from its far end back.
    for (std::uint32_t r = 0; r < keep_.size(); ++r) {
      if (fixed_[r] && h_.radii[r].parent != k_none) thin_chain(r);
    }
    return what_is_left();
  }

 private:
  void keep_fixed() {
    std::vector<std::uint32_t> children(keep_.size(), 0);
    for (const RadiusNode& r : h_.radii) {
      if (r.parent != k_none) ++children[r.parent];
    }
    fixed_.assign(keep_.size(), 0);
    for (std::uint32_t r = 0; r < keep_.size(); ++r) {
      const RadiusNode& node = h_.radii[r];
      fixed_[r] =
          node.parent == k_none || children[r] != 1 || node.source != RadiusSource::ring || node.joint;
      if (node.parent != k_none && node.branch != h_.radii[node.parent].branch) fixed_[r] = 1;
    }
    keep_ = fixed_;
  }

  void thin_chain(std::uint32_t end) {
    chain_.assign(1, end);
    do {
      chain_.push_back(h_.radii[chain_.back()].parent);
    } while (!fixed_[chain_.back()]);
    way_.assign(1, 0);
    for (std::size_t i = 1; i < chain_.size(); ++i) {
      way_.push_back(way_.back() + distance(node(i).centre, node(i - 1).centre));
    }
    mark_corners();
    std::vector<std::uint8_t> stays;
    for (const std::uint32_t r : chain_) stays.push_back(keep_[r]);
    simplify_polyline(stays, [this](std::size_t a, std::size_t b, std::size_t i) { return need(a, b, i); });
    for (std::size_t i = 0; i < chain_.size(); ++i) keep_[chain_[i]] = stays[i];
  }

  const RadiusNode& node(std::size_t i) const { return h_.radii[chain_[i]]; }

  void mark_corners() {
    const std::size_t n = chain_.size();
    std::vector<double> bend(n, 0);
    for (std::size_t i = 1; i + 1 < n; ++i) {
      bend[i] = length(normalized(node(i + 1).centre - node(i).centre, {}) -
                       normalized(node(i).centre - node(i - 1).centre, {}));
    }
    for (std::size_t i = 1; i + 1 < n; ++i) {
      if (bend[i] > k_corner_bend && bend[i] >= bend[i - 1] && bend[i] >= bend[i + 1]) keep_[chain_[i]] = 1;
    }
  }

  // Of the ring `i` in the chain, by how far it is off the line from `a` to `b`.
  double need(std::size_t a, std::size_t b, std::size_t i) const {
    const double at = way_[b] > way_[a] ? (way_[i] - way_[a]) / (way_[b] - way_[a]) : 0;
    const Double3 centre = node(a).centre + (node(b).centre - node(a).centre) * at;
    const double diameter = node(a).diameter + (node(b).diameter - node(a).diameter) * at;
    const double off = distance(centre, node(i).centre) + std::abs(diameter - node(i).diameter) / 2;
    return off / (k_implied_tolerance * node(i).diameter / 2);
  }

  Hierarchy what_is_left() {
    Hierarchy out;
    std::vector<std::uint32_t> id(keep_.size(),
                                  k_none);  // of a radius, or of the nearest before it that stays
    for (std::uint32_t r = 0; r < keep_.size(); ++r) {
      const std::uint32_t parent = h_.radii[r].parent;
      if (!keep_[r]) {
        id[r] = id[parent];
        continue;
      }
      id[r] = static_cast<std::uint32_t>(out.radii.size());
      out.radii.push_back(h_.radii[r]);
      if (parent != k_none) out.radii.back().parent = id[parent];
      const auto first = h_.ring_vertices.begin() + h_.first_vertex[r];
      const auto end = h_.ring_vertices.begin() + h_.first_vertex[r + 1];
      out.ring_vertices.insert(out.ring_vertices.end(), first, end);
      out.first_vertex.push_back(static_cast<std::uint32_t>(out.ring_vertices.size()));
    }
    // The segment that a radius ends belongs to the next one that stays.
    for (std::uint32_t r = static_cast<std::uint32_t>(keep_.size()); r-- > 0;) {
      if (keep_[r]) next_[r] = id[r];
      const std::uint32_t parent = h_.radii[r].parent;
      if (parent != k_none && !keep_[parent]) next_[parent] = next_[r];
    }
    out.segment_of.reserve(h_.segment_of.size());
    for (const std::uint32_t s : h_.segment_of) out.segment_of.push_back(s == k_none ? k_none : next_[s]);
    out.notes = h_.notes;
    return out;
  }

  const Hierarchy& h_;
  std::vector<std::uint8_t> keep_, fixed_;
  std::vector<std::uint32_t>
      next_;  // of each radius: itself or the next one outward that stays, in the answer
  std::vector<std::uint32_t> chain_;  // in hand, from its end back
  std::vector<double> way_;
};

}  // namespace

bool is_evenly_cut(const Hierarchy& hierarchy) {
  std::vector<double> steps, radii;
  for (const RadiusNode& r : hierarchy.radii) {
    if (r.parent == k_none || r.source != RadiusSource::ring) continue;
    const RadiusNode& parent = hierarchy.radii[r.parent];
    const double radius = (r.diameter + parent.diameter) / 4;
    if (parent.source != RadiusSource::ring || radius <= 0) continue;
    steps.push_back(distance(r.centre, parent.centre) / radius);
    radii.push_back(radius);
  }
  if (steps.size() < k_even_steps) return false;
  std::ranges::sort(radii);
  const std::size_t tenth = radii.size() / 10;
  if (radii[radii.size() - 1 - tenth] < k_uneven_radii * radii[tenth]) return false;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::ranges::nth_element(steps, middle);
  const double median = *middle;
  if (median > k_square_step || median * k_square_step < 1) return false;
  const auto even = std::ranges::count_if(
      steps, [&](double s) { return s >= median / k_even_ratio && s <= median * k_even_ratio; });
  return static_cast<double>(even) >= k_even_share * static_cast<double>(steps.size());
}

Hierarchy without_implied_rings(const Hierarchy& hierarchy) {
  return Thinning(hierarchy).run();
}

}  // namespace copse
