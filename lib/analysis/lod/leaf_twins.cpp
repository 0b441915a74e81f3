#include "lib/analysis/lod/leaf_twins.h"

#include "lib/analysis/lod/spectrum_builder.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <utility>

namespace copse {
namespace {

using Places = std::array<std::array<float, 3>, 3>;

// The places of a triangle, whichever way round.
Places places_of(const PartTriangles& part, std::uint32_t triangle) {
  Places places;
  for (int c = 0; c < 3; ++c) {
    const Float3& p = part.vertices[part.triangles[triangle][c]].position;
    places[c] = {p.x, p.y, p.z};
  }
  std::sort(places.begin(), places.end());
  return places;
}

// Of any order of the places; of equal places equal.
std::uint64_t hash_of(const PartTriangles& part, std::uint32_t triangle) {
  std::uint64_t sum = 0;
  for (const std::uint32_t v : part.triangles[triangle]) {
    const Float3& p = part.vertices[v].position;
    const auto bits = [](float x) {
      return std::uint64_t{std::bit_cast<std::uint32_t>(x + 0.0f)};
    };  // -0 is 0
    std::uint64_t h = (bits(p.x) << 32 | bits(p.y)) * 0x9e3779b97f4a7c15u ^ bits(p.z);
    h = (h ^ h >> 32) * 0xd6e8feb86659fd93u;
    sum += h ^ h >> 32;
  }
  return sum;
}

std::vector<std::uint32_t> find_twins(const LeafPieces& pieces) {
  std::vector<std::pair<std::uint64_t, std::uint32_t>> hashes;
  hashes.reserve(pieces.triangles.size());
  for (const std::uint32_t t : pieces.triangles) hashes.emplace_back(hash_of(pieces.part, t), t);
  std::sort(hashes.begin(), hashes.end());
  std::vector<std::uint32_t> gone;
  std::vector<std::pair<Places, std::uint32_t>> alike;
  for (std::size_t i = 0, next = 0; i < hashes.size(); i = next) {
    for (next = i + 1; next < hashes.size() && hashes[next].first == hashes[i].first;) ++next;
    if (next == i + 1) continue;
    alike.clear();
    for (std::size_t k = i; k < next; ++k)
      alike.emplace_back(places_of(pieces.part, hashes[k].second), hashes[k].second);
    std::sort(alike.begin(), alike.end());
    for (std::size_t k = 1; k < alike.size(); ++k)
      if (alike[k].first == alike[k - 1].first) gone.push_back(alike[k].second);
  }
  std::sort(gone.begin(), gone.end());
  return gone;
}

// The pieces without some of their triangles, which have other numbers now.
LeafPieces without(const LeafPieces& pieces, std::span<const std::uint32_t> gone) {
  LeafPieces left{.part = pieces.part, .list = {}, .triangles = {}, .opacity = pieces.opacity};
  left.part.triangles.clear(), left.part.materials.clear();
  std::vector<std::uint32_t> number(pieces.part.triangles.size());
  for (std::uint32_t t = 0, next = 0; t < number.size(); ++t) {
    if (next < gone.size() && gone[next] == t) {
      number[t] = k_none, ++next;
      continue;
    }
    number[t] = static_cast<std::uint32_t>(left.part.triangles.size());
    left.part.triangles.push_back(pieces.part.triangles[t]);
    left.part.materials.push_back(pieces.part.materials[t]);
  }
  for (LeafPiece piece : pieces.list) {
    const auto all = std::span(pieces.triangles).subspan(piece.first, piece.last - piece.first);
    piece.first = static_cast<std::uint32_t>(left.triangles.size());
    for (const std::uint32_t t : all)
      if (number[t] != k_none) left.triangles.push_back(number[t]);
    piece.last = static_cast<std::uint32_t>(left.triangles.size());
    if (piece.last - piece.first < 2) piece.cut = LeafCut::triangle;
    if (piece.last > piece.first) left.list.push_back(piece);
  }
  return left;
}

}  // namespace

std::optional<LeafTwins> part_twins(const LeafPieces& pieces) {
  std::vector<std::uint32_t> gone = find_twins(pieces);
  if (gone.empty()) return {};
  LeafPieces left = without(pieces, gone);
  return LeafTwins{std::move(left), std::move(gone)};
}

Spectrum twins_first(const LeafPieces& pieces, const LeafTwins& twins, const Spectrum& then) {
  const std::size_t steps = std::min(k_twin_steps, twins.gone.size());
  SpectrumBuilder builder(then.method);
  for (std::size_t n = 0; n < steps + then.steps(); ++n) builder.step(0);
  for (const SpectrumVertex& v : then.vertices) builder.vertex(v);
  for (std::size_t e = 0; e < then.elements.size(); ++e) {
    SpectrumElement element = then.elements[e];
    if (element.birth > 0) element.birth += static_cast<std::uint32_t>(steps);
    if (element.death != k_none) element.death += static_cast<std::uint32_t>(steps);
    const std::uint32_t first = then.first_triangle[e];
    builder.element(element, std::span(then.triangles).subspan(first, then.first_triangle[e + 1] - first));
  }
  std::vector<std::uint32_t> radius(pieces.part.triangles.size(), k_none);
  for (const LeafPiece& piece : pieces.list)
    for (std::uint32_t i = piece.first; i < piece.last; ++i) radius[pieces.triangles[i]] = piece.radius;
  for (std::size_t i = 0; i < twins.gone.size(); ++i) {
    const std::uint32_t t = twins.gone[i];
    std::array<std::uint32_t, 3> corners{};
    for (int c = 0; c < 3; ++c)
      corners[c] = builder.vertex(pieces.part.vertices[pieces.part.triangles[t][c]]);
    const auto death = static_cast<std::uint32_t>(1 + i * steps / twins.gone.size());
    builder.element({.birth = 0, .death = death, .material = pieces.part.materials[t], .radius = radius[t]},
                    std::span(&corners, 1));
  }
  return builder.finish();
}

}  // namespace copse
