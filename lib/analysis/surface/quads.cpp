#include "lib/analysis/surface/quads.h"

#include "lib/analysis/surface/welded_tolerances.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace copse {

namespace {

double angle_at(const Double3& corner, const Double3& a, const Double3& b) {
  const Double3 u = a - corner, v = b - corner;
  return std::atan2(length(cross(u, v)), dot(u, v));
}

// How far from rectangles two triangles with a common edge are. Remembers the angles at their corners.
class Skew {
 public:
  explicit Skew(const Surface& s) : s_(s), angles_(s.triangles.size(), {k_unknown, 0, 0}) {}

  // Of `t` and the triangle across its edge `e`: the sum over the corners of the deviation from a right
  // angle.
  float operator()(std::uint32_t t, std::size_t e) {
    const std::uint32_t u = s_.across[t][e];
    const auto f = static_cast<std::size_t>(
        edge_between(s_.triangles[u], s_.triangles[t][e], s_.triangles[t][(e + 1) % 3]));
    const bool turned = s_.triangles[u][f] == s_.triangles[t][e];  // both run the same way along the edge
    const std::array<float, 3>&x = angles(t), &y = angles(u);
    const float begin = y[turned ? f : (f + 1) % 3], end = y[turned ? (f + 1) % 3 : f];
    return off(x[(e + 2) % 3]) + off(y[(f + 2) % 3]) + off(x[e] + begin) + off(x[(e + 1) % 3] + end);
  }

 private:
  static constexpr float k_unknown = -1;
  static float off(float angle) { return std::abs(angle - std::numbers::pi_v<float> / 2); }

  const std::array<float, 3>& angles(std::uint32_t triangle) {
    std::array<float, 3>& angles = angles_[triangle];
    if (angles[0] != k_unknown) return angles;
    const Triangle& t = s_.triangles[triangle];
    const Double3 &a = s_.positions[t[0]], &b = s_.positions[t[1]], &c = s_.positions[t[2]];
    const double at_a = angle_at(a, b, c), at_b = angle_at(b, c, a);
    angles = {static_cast<float>(at_a), static_cast<float>(at_b),
              static_cast<float>(std::numbers::pi - at_a - at_b)};
    return angles;
  }

  const Surface& s_;
  std::vector<std::array<float, 3>> angles_;  // one a triangle, at its corners
};

// Pairs neighbours along runs of consecutive triangles that share edges: of all ways to pair them the one
// with the fewest left over, then the least skew.
void pair_runs(const Surface& s, Skew& skew, std::span<const std::uint32_t> taken, double most_skew,
               std::vector<std::uint32_t>& partner) {
  const auto n = static_cast<std::uint32_t>(s.triangles.size());
  // cost[t]: skew of pairing t with t + 1, negative when they cannot be paired.
  const auto cost_of = [&](std::uint32_t t) {
    if (t + 1 >= n || s.order[t + 1] != s.order[t] + 1) return -1.0;
    if (taken[t] != k_none || taken[t + 1] != k_none) return -1.0;
    for (std::size_t e = 0; e < 3; ++e) {
      if (s.across[t][e] != t + 1) continue;
      const double c = skew(t, e);
      return c <= most_skew ? c : -1.0;
    }
    return -1.0;
  };
  // Best cost of triangles 0 .. t - 1, when t - 1 is left over or paired with t - 2.
  constexpr double k_left_over = 2 * k_quad_skew_in_order;
  std::vector<double> best(n + 1, 0);
  std::vector<std::uint8_t> pairs(n + 1, 0);
  for (std::uint32_t t = 1; t <= n; ++t) {
    best[t] = best[t - 1] + k_left_over;
    const double c = t >= 2 ? cost_of(t - 2) : -1.0;
    if (c >= 0 && best[t - 2] + c < best[t]) best[t] = best[t - 2] + c, pairs[t] = 1;
  }
  for (std::uint32_t t = n; t > 0; t -= pairs[t] ? 2 : 1) {
    if (pairs[t]) partner[t - 1] = t - 2, partner[t - 2] = t - 1;
  }
}

void pair_by_shape(const Surface& s, Skew& skew, std::span<const std::uint32_t> taken,
                   std::vector<std::uint32_t>& partner) {
  struct Candidate {
    float skew;
    std::uint32_t t, u;
  };
  std::vector<Candidate> candidates;
  const auto is_free = [&](std::uint32_t t) { return taken[t] == k_none && partner[t] == k_none; };
  for (std::uint32_t t = 0; t < s.triangles.size(); ++t) {
    for (std::size_t e = 0; e < 3 && is_free(t); ++e) {
      const std::uint32_t u = s.across[t][e];
      if (u == k_none || u < t || !is_free(u)) continue;
      const float c = skew(t, e);
      if (c <= k_quad_skew) candidates.push_back({c, t, u});
    }
  }
  std::ranges::sort(candidates, [](const Candidate& a, const Candidate& b) {
    if (a.skew != b.skew) return a.skew < b.skew;
    return a.t != b.t ? a.t < b.t : a.u < b.u;
  });
  for (const Candidate& c : candidates) {
    if (partner[c.t] == k_none && partner[c.u] == k_none) partner[c.t] = c.u, partner[c.u] = c.t;
  }
}

// The edge a -> b of a quad through which a strip enters it, named by the triangle that holds the edge.
struct Gate {
  std::uint32_t triangle, a, b;
};

class Strips {
 public:
  Strips(const Surface& s, std::span<const std::uint32_t> partner, Bands& bands)
      : s_(s),
        partner_(partner),
        bands_(bands),
        passed_(3 * s.triangles.size(), 0),
        mark_(s.positions.size(), 0) {}

  void add_all() {
    for (std::uint32_t t = 0; t < s_.triangles.size(); ++t) {
      for (std::size_t e = 0; e < 3; ++e) {
        if (!is_quad(t) || passed_[3 * t + e] || s_.across[t][e] == partner_[t]) continue;
        const Gate start{t, s_.triangles[t][e], s_.triangles[t][(e + 1) % 3]};
        if (walk(start, true)) strips_.push_back({girth(), start});
      }
    }
    std::ranges::stable_sort(strips_, {}, &Strip::girth);
    for (const Strip& strip : strips_) {
      if (is_quad(strip.start.triangle) && walk(strip.start, false)) bands_.add(left_, right_, triangles_);
    }
  }

 private:
  struct Strip {
    double girth;
    Gate start;
  };

  bool is_quad(std::uint32_t t) const {
    return t != k_none && partner_[t] != k_none && bands_.band_of[t] == k_none &&
           bands_.band_of[partner_[t]] == k_none;
  }
  std::size_t edge(std::uint32_t t, std::uint32_t a, std::uint32_t b) const {
    return static_cast<std::size_t>(edge_between(s_.triangles[t], a, b));
  }

  // Follows the strip through the gate, leaving each quad by the opposite edge, until it is back at the gate
  // the same way round. False when it ends, or crosses or touches itself; and, when only strips that are
  // `unknown` are wanted, when it comes to a gate that was passed before: no gate is then passed twice.
  bool walk(const Gate& start, bool unknown) {
    left_.clear(), right_.clear(), triangles_.clear();
    ++stamp_;
    Gate g = start;
    do {
      const std::uint32_t t = g.triangle;
      if (!is_quad(t)) return false;
      const std::uint32_t u = partner_[t];
      std::uint8_t& passed = passed_[3 * t + edge(t, g.a, g.b)];
      if (unknown && passed) return false;
      passed = 1;
      if (mark_[g.a] == stamp_ || mark_[g.b] == stamp_) return false;
      mark_[g.a] = mark_[g.b] = stamp_;
      left_.push_back(g.a), right_.push_back(g.b);
      triangles_.push_back(t), triangles_.push_back(u);
      // The diagonal runs from one end of the gate to the corner of t across from it; the partner's own
      // corner lies opposite that end.
      const std::uint32_t c = third_corner(s_.triangles[t], g.a, g.b);
      const bool from_a = s_.across[t][edge(t, g.a, c)] == u;
      const std::uint32_t d = third_corner(s_.triangles[u], from_a ? g.a : g.b, c);
      const std::uint32_t a = from_a ? d : c, b = from_a ? c : d;
      passed_[3 * u + edge(u, a, b)] = 1;
      const std::uint32_t next = s_.across[u][edge(u, a, b)];
      if (next == k_none) return false;
      g = {next, a, b};
    } while (g.triangle != start.triangle || g.a != start.a || g.b != start.b);
    return left_.size() >= 3;
  }

  double girth() const {
    double sum = 0;
    for (std::size_t i = 0; i < left_.size(); ++i) {
      const std::size_t j = (i + 1) % left_.size();
      sum += distance(s_.positions[left_[i]], s_.positions[left_[j]]) +
             distance(s_.positions[right_[i]], s_.positions[right_[j]]);
    }
    return sum / 2;
  }

  const Surface& s_;
  std::span<const std::uint32_t> partner_;
  Bands& bands_;
  std::vector<std::uint8_t> passed_;  // one an edge of each triangle
  std::vector<std::uint32_t> mark_;
  std::uint32_t stamp_ = 0;
  std::vector<Strip> strips_;
  std::vector<std::uint32_t> left_, right_, triangles_;
};

constexpr double k_any_skew = std::numeric_limits<double>::infinity();

// Whether each triangle has a neighbour that it could be paired with: next to it in the file, or nearly a
// rectangle with it.
bool may_all_pair(const Surface& s, Skew& skew) {
  std::vector<std::uint8_t> may_pair(s.triangles.size(), 0);
  for (std::uint32_t t = 0; t < s.triangles.size(); ++t) {
    for (std::size_t e = 0; e < 3; ++e) {
      const std::uint32_t u = s.across[t][e];
      if (u == k_none || u < t || (may_pair[t] && may_pair[u])) continue;
      const bool in_order = u == t + 1 && s.order[u] == s.order[t] + 1;
      if (in_order || skew(t, e) <= k_quad_skew) may_pair[t] = may_pair[u] = 1;
    }
    if (!may_pair[t]) return false;
  }
  return true;
}

}  // namespace

std::vector<std::uint32_t> pair_quads(const Surface& surface, std::span<const std::uint32_t> taken,
                                      QuadOrder order) {
  std::vector<std::uint32_t> partner(surface.triangles.size(), k_none);
  Skew skew(surface);
  if (order == QuadOrder::file) pair_runs(surface, skew, taken, k_quad_skew_in_order, partner);
  pair_by_shape(surface, skew, taken, partner);
  return partner;
}

std::vector<std::uint32_t> pair_all_quads(const Surface& surface) {
  Skew skew(surface);
  if (!may_all_pair(surface, skew)) return {};
  std::vector<std::uint32_t> partner(surface.triangles.size(), k_none);
  const std::vector<std::uint32_t> taken = partner;
  pair_runs(surface, skew, taken, k_any_skew, partner);
  pair_by_shape(surface, skew, taken, partner);
  if (std::ranges::find(partner, k_none) != partner.end()) partner.clear();
  return partner;
}

void add_quad_bands(const Surface& surface, std::span<const std::uint32_t> partner, Bands& bands) {
  Strips(surface, partner, bands).add_all();
}

}  // namespace copse
