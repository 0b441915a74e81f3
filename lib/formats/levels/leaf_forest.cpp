#include "lib/formats/levels/leaf_forest.h"

#include "lib/formats/levels/spectrum_draft.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <map>
#include <numeric>
#include <span>

namespace copse {
namespace {

constexpr std::uint64_t k_most_looks = 300'000'000;  // beyond it the first leaf of a step takes what dies

using Face = std::array<std::uint32_t, 3>;
using Key = std::array<std::uint32_t, 8>;

Key key_of(const SpectrumVertex& v) {
  Key key{};
  std::memcpy(key.data(), &v, sizeof key);
  return key;
}

class Reader {
 public:
  Reader(const Spectrum& s, const PartTriangles& part) : s_(s), part_(part) {}

  std::optional<LeafForest> run() {
    number_vertices();
    if (!find_sources() || !make_nodes()) return std::nullopt;
    number_pieces();
    walk();
    return std::move(out_);
  }

 private:
  // Vertices of the tree by what they hold; those of the spectrum that are none of them have no number.
  void number_vertices() {
    std::map<Key, std::uint32_t> numbers;
    std::vector<std::uint32_t> of_part;
    for (const SpectrumVertex& v : part_.vertices)
      of_part.push_back(
          numbers.try_emplace(key_of(v), static_cast<std::uint32_t>(numbers.size())).first->second);
    for (const SpectrumVertex& v : s_.vertices) {
      const auto at = numbers.find(key_of(v));
      number_.push_back(at == numbers.end() ? k_none : at->second);
    }
    for (std::uint32_t t = 0; t < part_.triangles.size(); ++t) {
      const Face& f = part_.triangles[t];
      triangles_[{of_part[f[0]], of_part[f[1]], of_part[f[2]]}].push_back(t);
    }
  }
  std::vector<std::uint32_t>* same_as(std::uint32_t triangle) {
    const Face& f = s_.triangles[triangle];
    const auto at = triangles_.find({number_[f[0]], number_[f[1]], number_[f[2]]});
    return at == triangles_.end() ? nullptr : &at->second;
  }

  // Elements of full detail tile the tree's triangles; later ones that are a triangle of the tree are what is
  // left of a piece that has gone.
  bool find_sources() {
    out_.piece_of.assign(part_.triangles.size(), k_none);
    death_.assign(part_.triangles.size(), k_none);
    is_source_.assign(s_.elements.size(), 0);
    std::vector<std::uint32_t> pieces;
    for (std::uint32_t e = 0; e < s_.elements.size(); ++e)
      if (s_.elements[e].birth == 0) pieces.push_back(e);
    // Of coincident triangles the first ones go to the piece that begins first in the tree.
    for (const std::uint32_t e : pieces) {
      const auto piece = static_cast<std::uint32_t>(out_.radii.size());
      for (std::uint32_t t = s_.first_triangle[e]; t < s_.first_triangle[e + 1]; ++t) {
        std::vector<std::uint32_t>* same = same_as(t);
        if (same == nullptr) return false;
        const auto free = std::find_if(same->begin(), same->end(),
                                       [&](std::uint32_t x) { return out_.piece_of[x] == k_none; });
        if (free == same->end()) return false;
        out_.piece_of[*free] = piece, death_[*free] = s_.elements[e].death;
        if (s_.elements[e].material != part_.materials[*free]) return false;
      }
      out_.radii.push_back(s_.elements[e].radius), piece_death_.push_back(s_.elements[e].death);
      is_source_[e] = 1;
    }
    if (std::find(out_.piece_of.begin(), out_.piece_of.end(), k_none) != out_.piece_of.end()) return false;
    // Not all of them: where the last one comes again as it was, it has been made.
    std::vector<std::uint8_t> single(part_.triangles.size(), 0);
    std::vector<std::uint32_t> left(out_.radii.size(), 0);
    for (const std::uint32_t piece : out_.piece_of) ++left[piece];
    for (std::uint32_t e = 0; e < s_.elements.size(); ++e) {
      const SpectrumElement& x = s_.elements[e];
      if (x.birth == 0 || s_.first_triangle[e + 1] - s_.first_triangle[e] != 1) continue;
      const std::vector<std::uint32_t>* same = same_as(s_.first_triangle[e]);
      if (same == nullptr) continue;
      for (const std::uint32_t t : *same) {
        const std::uint32_t piece = out_.piece_of[t];
        if (single[t] || left[piece] == 1 || piece_death_[piece] != x.birth ||
            out_.radii[piece] != x.radius || part_.materials[t] != x.material)
          continue;
        --left[piece];
        single[t] = 1, death_[t] = x.death, is_source_[e] = 1;
        break;
      }
    }
    return true;
  }

  // One node a made element; the first of a step is that to which what dies in it gives way. A step without
  // one gets a node that is not drawn.
  bool make_nodes() {
    out_.steps = static_cast<std::uint32_t>(s_.errors.size() - 1);
    nodes_.push_back({});
    host_.assign(std::size_t{out_.steps} + 1, k_none);
    for (std::uint32_t e = 0; e < s_.elements.size(); ++e) {
      if (is_source_[e]) continue;
      LeafForest::Node n{.step = s_.elements[e].birth,
                         .material = s_.elements[e].material,
                         .radius = s_.elements[e].radius,
                         .faces = {},
                         .vertices = {}};
      std::map<std::uint32_t, std::uint32_t> local;
      for (std::uint32_t t = s_.first_triangle[e]; t < s_.first_triangle[e + 1]; ++t) {
        Face& face = n.faces.emplace_back();
        for (std::size_t c = 0; c < 3; ++c) {
          const std::uint32_t v = s_.triangles[t][c];
          const auto [at, is_new] = local.try_emplace(v, static_cast<std::uint32_t>(local.size()));
          if (is_new) n.vertices.push_back(s_.vertices[v]);
          face[c] = at->second;
        }
      }
      std::uint32_t& host = host_[n.step];
      if (n.step == 0 || n.vertices.size() > 64) return false;
      if (host == k_none) host = static_cast<std::uint32_t>(nodes_.size());
      death_of_.resize(nodes_.size() + 1, k_none);
      death_of_.back() = s_.elements[e].death;
      nodes_.push_back(std::move(n));
    }
    for (std::uint32_t n = 1; n <= out_.steps; ++n) {
      if (host_[n] != k_none) continue;
      host_[n] = static_cast<std::uint32_t>(nodes_.size());
      LeafForest::Node none;
      none.step = n, none.drawn = false;
      nodes_.push_back(none);
    }
    death_of_.resize(nodes_.size(), k_none);
    return true;
  }

  // By their first triangles.
  void number_pieces() {
    std::vector<std::uint32_t> number(out_.radii.size(), k_none), radii;
    for (std::uint32_t& p : out_.piece_of) {
      if (number[p] == k_none)
        number[p] = static_cast<std::uint32_t>(radii.size()), radii.push_back(out_.radii[p]);
      p = number[p];
    }
    out_.radii = std::move(radii);
  }

  static Double3 middle_of(std::span<const SpectrumVertex> vertices) {
    Double3 sum{};
    for (const SpectrumVertex& v : vertices) sum += to_double(v.position) / double(vertices.size());
    return sum;
  }
  // Where a step makes several leaves, what dies in it gives way to the nearest.
  std::uint32_t host_for(std::uint32_t death, const Double3& middle) {
    if (death == k_none) return 0;
    const std::uint32_t first = host_[death];
    if (makers_.empty()) {
      makers_.resize(host_.size());
      for (std::uint32_t n = 1; n < nodes_.size(); ++n)
        makers_[nodes_[n].step].emplace_back(n, middle_of(nodes_[n].vertices));
    }
    if (makers_[death].size() < 2 || (looked_ += makers_[death].size()) > k_most_looks) return first;
    std::uint32_t best = first;
    double least = std::numeric_limits<double>::infinity();
    for (const auto& [n, at] : makers_[death])
      if (const double d = dot(at - middle, at - middle); d < least) least = d, best = n;
    return best;
  }

  void walk() {
    std::vector<std::vector<std::uint32_t>> children(nodes_.size()), sources(nodes_.size());
    for (std::uint32_t n = 1; n < nodes_.size(); ++n)
      children[host_for(death_of_[n], middle_of(nodes_[n].vertices))].push_back(n);
    for (std::uint32_t t = 0; t < death_.size(); ++t) {
      const Face& f = part_.triangles[t];
      const std::array<SpectrumVertex, 3> corners{part_.vertices[f[0]], part_.vertices[f[1]],
                                                  part_.vertices[f[2]]};
      sources[host_for(death_[t], middle_of(corners))].push_back(t);
    }
    std::vector<std::pair<std::uint32_t, std::uint32_t>> open{{0, 0}};  // old number, new number
    out_.nodes.push_back(std::move(nodes_[0]));
    while (!open.empty()) {
      const auto [old, now] = open.back();
      open.pop_back();
      LeafForest::Node* n = &out_.nodes[now];
      n->first_source = static_cast<std::uint32_t>(out_.sources.size());
      n->sources = static_cast<std::uint32_t>(sources[old].size());
      out_.sources.insert(out_.sources.end(), sources[old].begin(), sources[old].end());
      n->first_child = static_cast<std::uint32_t>(out_.nodes.size());
      n->children = static_cast<std::uint32_t>(children[old].size());
      for (const std::uint32_t c : children[old]) {
        out_.nodes.push_back(std::move(nodes_[c]));
        out_.nodes.back().parent = now;
      }
      for (std::size_t k = children[old].size(); k-- > 0;)
        open.emplace_back(children[old][k], out_.nodes[now].first_child + static_cast<std::uint32_t>(k));
    }
  }

  const Spectrum& s_;
  const PartTriangles& part_;
  LeafForest out_;
  std::vector<std::uint32_t> number_;
  std::map<Face, std::vector<std::uint32_t>> triangles_;
  std::vector<std::vector<std::pair<std::uint32_t, Double3>>> makers_;  // of every step
  std::uint64_t looked_ = 0;
  std::vector<std::uint32_t> death_, piece_death_, host_, death_of_;
  std::vector<std::uint8_t> is_source_;
  std::vector<LeafForest::Node> nodes_;
};

}  // namespace

std::optional<LeafForest> leaf_forest(const Spectrum& spectrum, const PartTriangles& part) {
  return Reader(spectrum, part).run();
}

std::string spectrum_of(const LeafForest& forest, const PartTriangles& part, Spectrum& spectrum) {
  const auto death_below = [&](std::uint32_t node) { return node == 0 ? k_none : forest.nodes[node].step; };
  std::vector<std::uint32_t> death(part.triangles.size(), k_none);
  std::vector<SpectrumVertex> vertices = part.vertices;
  std::vector<SpectrumDraft> drafts;
  for (std::uint32_t n = 0; n < forest.nodes.size(); ++n) {
    const LeafForest::Node& node = forest.nodes[n];
    for (std::uint32_t i = node.first_source; i < node.first_source + node.sources; ++i)
      death[forest.sources[i]] = death_below(n);
    if (n == 0 || !node.drawn) continue;
    SpectrumDraft d{{.birth = node.step,
                     .death = death_below(node.parent),
                     .material = node.material,
                     .radius = node.radius},
                    {}};
    if (d.element.birth >= d.element.death) return "a leaf goes before it is made";
    const auto base = static_cast<std::uint32_t>(vertices.size());
    for (const Face& f : node.faces) d.faces.push_back({base + f[0], base + f[1], base + f[2]});
    vertices.insert(vertices.end(), node.vertices.begin(), node.vertices.end());
    drafts.push_back(std::move(d));
  }
  std::vector<std::uint32_t> piece_death(forest.radii.size(), k_none);
  for (std::uint32_t t = 0; t < death.size(); ++t)
    piece_death[forest.piece_of[t]] = std::min(piece_death[forest.piece_of[t]], death[t]);
  std::vector<SpectrumDraft> pieces(forest.radii.size());
  for (std::uint32_t t = 0; t < death.size(); ++t) {
    const std::uint32_t p = forest.piece_of[t];
    pieces[p].faces.push_back(part.triangles[t]);
    pieces[p].element = {
        .birth = 0, .death = piece_death[p], .material = part.materials[t], .radius = forest.radii[p]};
    if (death[t] == piece_death[p]) continue;
    drafts.push_back({{.birth = piece_death[p],
                       .death = death[t],
                       .material = part.materials[t],
                       .radius = forest.radii[p]},
                      {part.triangles[t]}});
  }
  drafts.insert(drafts.end(), std::make_move_iterator(pieces.begin()), std::make_move_iterator(pieces.end()));
  return assemble_spectrum(drafts, vertices, spectrum);
}

}  // namespace copse
