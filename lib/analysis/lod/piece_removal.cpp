#include "lib/analysis/lod/piece_removal.h"

#include "lib/analysis/lod/spectrum_builder.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <span>
#include <tuple>
#include <vector>

namespace copse {
namespace {

struct Piece {
  std::vector<std::uint32_t> elements;
  std::uint64_t triangles = 0;
  double area = 0;
  DoubleBox box;
};

class Union {
 public:
  explicit Union(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0u); }
  std::uint32_t root(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  // The lower number is the root.
  void join(std::uint32_t a, std::uint32_t b) {
    a = root(a), b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

// What is drawn after the last step.
std::vector<std::uint32_t> left(const Spectrum& s) {
  std::vector<std::uint32_t> elements;
  for (std::uint32_t e = 0; e < s.elements.size(); ++e)
    if (s.elements[e].birth <= s.steps() && s.elements[e].death > s.steps()) elements.push_back(e);
  return elements;
}

// In order of their first elements.
std::vector<Piece> pieces_of(const Spectrum& s, std::span<const std::uint32_t> elements) {
  struct Corner {
    Float3 at;
    std::uint32_t element;
  };
  std::vector<Corner> corners;
  for (std::uint32_t i = 0; i < elements.size(); ++i)
    for (std::uint32_t t = s.first_triangle[elements[i]]; t < s.first_triangle[elements[i] + 1]; ++t)
      for (const std::uint32_t v : s.triangles[t]) corners.push_back({s.vertices[v].position, i});
  std::sort(corners.begin(), corners.end(), [](const Corner& a, const Corner& b) {
    return std::tie(a.at.x, a.at.y, a.at.z, a.element) < std::tie(b.at.x, b.at.y, b.at.z, b.element);
  });
  Union joined(elements.size());
  for (std::size_t c = 1; c < corners.size(); ++c)
    if (corners[c].at == corners[c - 1].at) joined.join(corners[c].element, corners[c - 1].element);
  std::vector<Piece> pieces;
  std::vector<std::uint32_t> number(elements.size(), k_none);
  for (std::uint32_t i = 0; i < elements.size(); ++i) {
    const std::uint32_t root = joined.root(i);
    if (number[root] == k_none)
      number[root] = static_cast<std::uint32_t>(pieces.size()), pieces.emplace_back();
    Piece& piece = pieces[number[root]];
    piece.elements.push_back(elements[i]);
    for (std::uint32_t t = s.first_triangle[elements[i]]; t < s.first_triangle[elements[i] + 1]; ++t) {
      std::array<Double3, 3> p;
      for (std::size_t c = 0; c < 3; ++c) {
        p[c] = to_double(s.vertices[s.triangles[t][c]].position);
        piece.box.grow(p[c]);
      }
      piece.area += 0.5 * length(cross(p[1] - p[0], p[2] - p[0]));
      ++piece.triangles;
    }
  }
  return pieces;
}

}  // namespace

Spectrum remove_pieces(const Spectrum& spectrum, std::uint64_t min_triangles) {
  if (spectrum.counts.empty()) return spectrum;
  std::vector<Piece> pieces = pieces_of(spectrum, left(spectrum));
  std::stable_sort(pieces.begin(), pieces.end(),
                   [](const Piece& a, const Piece& b) { return a.area < b.area; });
  SpectrumBuilder builder(spectrum.method);
  for (const SpectrumVertex& v : spectrum.vertices) builder.vertex(v);
  for (std::uint32_t step = 1; step <= spectrum.steps(); ++step) builder.step(spectrum.errors[step]);
  std::vector<std::uint32_t> death(spectrum.elements.size(), k_none);
  std::uint64_t triangles = spectrum.counts[spectrum.steps()];
  for (std::size_t i = 0; i + 1 < pieces.size(); ++i) {
    if (triangles < min_triangles + pieces[i].triangles) break;
    triangles -= pieces[i].triangles;
    builder.step(length(pieces[i].box.extent()));
    for (const std::uint32_t e : pieces[i].elements) death[e] = builder.steps();
  }
  for (std::uint32_t e = 0; e < spectrum.elements.size(); ++e) {
    SpectrumElement element = spectrum.elements[e];
    if (death[e] != k_none) element.death = death[e];
    const std::uint32_t first = spectrum.first_triangle[e], last = spectrum.first_triangle[e + 1];
    builder.element(element, std::span(spectrum.triangles).subspan(first, last - first));
  }
  return builder.finish();
}

}  // namespace copse
