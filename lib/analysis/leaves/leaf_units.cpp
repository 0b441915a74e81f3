#include "lib/analysis/leaves/leaf_units.h"

#include "lib/analysis/trunk/weld.h"

#include <algorithm>
#include <cmath>

namespace copse {
namespace {

constexpr double k_same_centre = 1e-3;  // of the square root of the median leaf's area
constexpr double k_same_area = 0.9;     // smaller over larger

struct Cards {
  std::vector<std::uint32_t> piece;  // the pieces that are leaves, ascending
  std::vector<Double3> centre;       // of their boxes
  std::vector<double> area;
};

double area_of(const Mesh& mesh, const Triangle& t) {
  const Double3 a = mesh.positions[t[0]];
  return length(cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a)) / 2;
}

Cards read_cards(const Mesh& mesh, const PieceTriangles& pieces, std::span<const std::uint8_t> is_leaf) {
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
    cards.centre.push_back(box.min * 0.5 + box.max * 0.5);
    cards.area.push_back(area);
  }
  return cards;
}

double tolerance(std::vector<double> areas) {
  const auto middle = areas.begin() + static_cast<std::ptrdiff_t>(areas.size() / 2);
  std::nth_element(areas.begin(), middle, areas.end());
  return std::isfinite(*middle) ? k_same_centre * std::sqrt(*middle) : 0;
}

// For every card the lowest card that it would be one leaf with, itself for none.
std::vector<std::uint32_t> partners(const PieceTriangles& pieces, const Cards& cards) {
  std::vector<std::uint32_t> partner = weld(cards.centre, tolerance(cards.area));
  for (std::uint32_t c = 0; c < partner.size(); ++c) {
    const std::uint32_t first = partner[c];
    const auto [small, large] = std::minmax(cards.area[c], cards.area[first]);
    const bool alike = pieces.of(cards.piece[c]).size() == pieces.of(cards.piece[first]).size();
    if (!alike || small < k_same_area * large) partner[c] = c;
  }
  return partner;
}

// By number of triangles: whether most cards with so many have a partner. A few that meet do so by chance.
std::vector<bool> are_paired(const PieceTriangles& pieces, const Cards& cards,
                             std::span<const std::uint32_t> partner) {
  std::vector<bool> has_partner(partner.size(), false);
  std::size_t most = 0;
  for (std::uint32_t c = 0; c < partner.size(); ++c) {
    if (partner[c] != c) has_partner[c] = has_partner[partner[c]] = true;
    most = std::max(most, pieces.of(cards.piece[c]).size());
  }
  std::vector<std::uint32_t> all(most + 1, 0), paired(most + 1, 0);
  for (std::uint32_t c = 0; c < partner.size(); ++c) {
    const std::size_t n = pieces.of(cards.piece[c]).size();
    ++all[n];
    paired[n] += has_partner[c];
  }
  std::vector<bool> most_are(most + 1);
  for (std::size_t n = 0; n <= most; ++n) most_are[n] = 2 * std::uint64_t{paired[n]} > all[n];
  return most_are;
}

}  // namespace

LeafUnits leaf_units(const Mesh& mesh, const PieceTriangles& pieces, std::span<const std::uint8_t> is_leaf) {
  LeafUnits units;
  units.of.assign(is_leaf.size(), k_none);
  const Cards cards = read_cards(mesh, pieces, is_leaf);
  if (cards.piece.empty()) return units;
  const std::vector<std::uint32_t> partner = partners(pieces, cards);
  const std::vector<bool> paired = are_paired(pieces, cards, partner);
  for (std::uint32_t c = 0; c < cards.piece.size(); ++c) {
    const bool joins = partner[c] != c && paired[pieces.of(cards.piece[c]).size()];
    units.of[cards.piece[c]] = joins ? units.of[cards.piece[partner[c]]] : units.count++;
  }
  return units;
}

}  // namespace copse
