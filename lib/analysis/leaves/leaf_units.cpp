#include "lib/analysis/leaves/leaf_units.h"

#include "lib/analysis/surface/weld.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>

namespace copse {
namespace {

constexpr double k_same_centre = 1e-3;  // of the square root of the median leaf's area
// Smaller reach from the centre over larger. The cards of a cross are as long, and may differ in width.
constexpr double k_like_reach = 0.6;

struct Cards {
  std::vector<std::uint32_t> piece;  // the pieces that are leaves, ascending
  std::vector<Double3> centre;       // of their boxes
  std::vector<double> area;
  std::vector<double> reach;             // from the centre to the farthest corner
  std::vector<std::uint32_t> triangles;  // sound ones
};

double area_of(const Mesh& mesh, const Triangle& t) {
  const Double3 a = mesh.positions[t[0]];
  const Double3 n = cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a);
  return std::sqrt(dot(n, n)) / 2;
}

Cards read_cards(const Mesh& mesh, std::span<const std::uint32_t> welded, const PieceTriangles& pieces,
                 std::span<const std::uint8_t> is_leaf) {
  Cards cards;
  for (std::uint32_t p = 0; p < is_leaf.size(); ++p) {
    if (!is_leaf[p]) continue;
    DoubleBox box;
    double area = 0;
    for (const std::uint32_t t : pieces.of(p)) {
      area += area_of(mesh, mesh.triangles[t]);
      for (const std::uint32_t v : mesh.triangles[t]) box.grow(mesh.positions[v]);
    }
    cards.piece.push_back(p);
    cards.triangles.push_back(static_cast<std::uint32_t>(sound_triangles(mesh, welded, pieces.of(p)).size()));
    cards.centre.push_back(box.min * 0.5 + box.max * 0.5);
    cards.area.push_back(area);
    double square = 0;  // of the reach; only ratios of reaches matter, so that overflow may make two unlike
    for (const std::uint32_t t : pieces.of(p)) {
      for (const std::uint32_t v : mesh.triangles[t]) {
        const Double3 d = mesh.positions[v] - cards.centre.back();
        square = std::max(square, dot(d, d));
      }
    }
    cards.reach.push_back(std::sqrt(square));
  }
  return cards;
}

double tolerance(std::vector<double> areas) {
  const auto middle = areas.begin() + static_cast<std::ptrdiff_t>(areas.size() / 2);
  std::nth_element(areas.begin(), middle, areas.end());
  return std::isfinite(*middle) ? k_same_centre * std::sqrt(*middle) : 0;
}

// Cells of 32 tolerances, hashed to counters of two bits. Tells in two passes over a small table which points
// can have another within the tolerance at all: in most crowns nearly none, and those need no search.
class Crowding {
 public:
  Crowding(std::span<const Double3> points, double tolerance)
      : tolerance_(tolerance), counts_(std::bit_ceil(4 * points.size() + 64), 0) {
    for (const Double3& p : points) low_.grow(p);
    for (const Double3& p : points) {
      const std::size_t at = slot(cell(p.x, 0), cell(p.y, 1), cell(p.z, 2));
      std::uint8_t& byte = counts_[at >> 2];
      const unsigned shift = 2 * (at & 3);
      if ((byte >> shift & 3) < 2) byte = static_cast<std::uint8_t>(byte + (1u << shift));
    }
  }

  bool may_meet(const Double3& p) const {
    const auto reach = [&](double x, int axis) {
      return std::array{cell(x - tolerance_, axis), cell(x + tolerance_, axis)};
    };
    const auto x = reach(p.x, 0), y = reach(p.y, 1), z = reach(p.z, 2);
    unsigned found = 0;  // itself, and others
    for (std::int64_t i = x[0]; i <= x[1]; ++i) {
      for (std::int64_t j = y[0]; j <= y[1]; ++j) {
        for (std::int64_t k = z[0]; k <= z[1]; ++k) {
          const std::size_t at = slot(i, j, k);
          found += counts_[at >> 2] >> 2 * (at & 3) & 3;
        }
      }
    }
    return found > 1;
  }

 private:
  std::int64_t cell(double x, int axis) const {
    return static_cast<std::int64_t>(std::clamp((x - low_.min[axis]) / (32 * tolerance_), -1.0, 0x1p60));
  }
  std::size_t slot(std::int64_t x, std::int64_t y, std::int64_t z) const {
    std::uint64_t h = static_cast<std::uint64_t>(x) * 0x9e3779b97f4a7c15u;
    h = (h ^ static_cast<std::uint64_t>(y)) * 0xff51afd7ed558ccdu;
    h = (h ^ static_cast<std::uint64_t>(z)) * 0xc4ceb9fe1a85ec53u;
    return (h ^ h >> 32) & (4 * counts_.size() - 1);
  }

  double tolerance_;
  DoubleBox low_;
  std::vector<std::uint8_t> counts_;
};

// weld() of the points that may have company; every other one is its own.
std::vector<std::uint32_t> weld_few(std::span<const Double3> points, double tolerance) {
  std::vector<std::uint32_t> met(points.size()), crowded;
  std::iota(met.begin(), met.end(), 0u);
  if (!(tolerance > 0)) return weld(points, 0.0);
  const Crowding crowding(points, tolerance);
  std::vector<Double3> few;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (!crowding.may_meet(points[i])) continue;
    crowded.push_back(i);
    few.push_back(points[i]);
  }
  const std::vector<std::uint32_t> joined = weld(few, tolerance);
  for (std::size_t i = 0; i < joined.size(); ++i) met[crowded[i]] = crowded[joined[i]];
  return met;
}

// For every card the lowest card that it would be one leaf with, itself for none.
std::vector<std::uint32_t> partners(const Cards& cards) {
  std::vector<std::uint32_t> partner = weld_few(cards.centre, tolerance(cards.area));
  for (std::uint32_t c = 0; c < partner.size(); ++c) {
    const std::uint32_t first = partner[c];
    const auto [small, large] = std::minmax(cards.reach[c], cards.reach[first]);
    const bool alike = cards.triangles[c] == cards.triangles[first];
    if (!alike || small < k_like_reach * large) partner[c] = c;
  }
  return partner;
}

// By number of triangles: whether most cards with so many have a partner. A few that meet do so by chance.
std::vector<bool> are_paired(const Cards& cards, std::span<const std::uint32_t> partner) {
  std::vector<bool> has_partner(partner.size(), false);
  std::uint32_t most = 0;
  for (std::uint32_t c = 0; c < partner.size(); ++c) {
    if (partner[c] != c) has_partner[c] = has_partner[partner[c]] = true;
    most = std::max(most, cards.triangles[c]);
  }
  std::vector<std::uint32_t> all(most + std::size_t{1}, 0), paired(most + std::size_t{1}, 0);
  for (std::uint32_t c = 0; c < partner.size(); ++c) {
    const std::uint32_t n = cards.triangles[c];
    ++all[n];
    paired[n] += has_partner[c];
  }
  std::vector<bool> most_are(most + std::size_t{1});
  for (std::size_t n = 0; n <= most; ++n) most_are[n] = 2 * std::uint64_t{paired[n]} > all[n];
  return most_are;
}

}  // namespace

LeafUnits leaf_units(const Mesh& mesh, std::span<const std::uint32_t> welded, const PieceTriangles& pieces,
                     std::span<const std::uint8_t> is_leaf) {
  LeafUnits units;
  units.of.assign(is_leaf.size(), k_none);
  const Cards cards = read_cards(mesh, welded, pieces, is_leaf);
  if (cards.piece.empty()) return units;
  const std::vector<std::uint32_t> partner = partners(cards);
  const std::vector<bool> paired = are_paired(cards, partner);
  for (std::uint32_t c = 0; c < cards.piece.size(); ++c) {
    const bool joins = partner[c] != c && paired[cards.triangles[c]];
    units.of[cards.piece[c]] = joins ? units.of[cards.piece[partner[c]]] : units.count++;
  }
  return units;
}

}  // namespace copse
