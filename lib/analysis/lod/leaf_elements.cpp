#include "lib/analysis/lod/leaf_elements.h"

#include <algorithm>
#include <utility>

namespace copse {
namespace {

constexpr std::uint32_t k_gone = k_none - 1;

}  // namespace

DrawnLeaf leaf_of_shape(const LeafPieces& pieces, std::uint32_t piece, std::uint32_t triangle,
                        const std::array<Double3, 4>& corners, const Double3& normal) {
  const std::array<Float2, 4> uv = pieces.texcoords(piece, triangle);
  DrawnLeaf leaf;
  leaf.corners = pieces.list[piece].cut == LeafCut::card ? 4 : 3, leaf.faces = leaf.corners - 2;
  for (std::uint32_t c = 0; c < leaf.corners; ++c)
    leaf.corner[c] = {to_float(corners[c]), to_float(normal), uv[c]};
  leaf.face = {{{0, 1, 2}, {0, 2, 3}}};
  if (dot(cross(corners[1] - corners[0], corners[2] - corners[0]), normal) < 0)
    for (auto& f : leaf.face) std::swap(f[1], f[2]);
  return leaf;
}

LeafElements::LeafElements(const LeafPieces& pieces)
    : pieces_(pieces), builder_(LodMethod::collapse), number_(pieces.part.vertices.size(), k_none) {
  for (const SpectrumVertex& v : pieces.part.vertices) builder_.vertex(v);
  for (std::uint32_t p = 0; p < pieces.list.size(); ++p) {
    const LeafPiece& piece = pieces.list[p];
    put_.clear();
    for (std::uint32_t t = piece.first; t < piece.last; ++t)
      put_.push_back(pieces.part.triangles[pieces.triangles[t]]);
    piece_element_.push_back(builder_.element(piece.material, piece.radius, put_));
    first_.push_back(size());
    piece_.insert(piece_.end(), piece.card ? 1 : piece.last - piece.first, p);
  }
  first_.push_back(size());
  element_.assign(piece_.size(), k_none), gone_.assign(piece_.size(), 0);
  pending_of_.assign(piece_.size(), k_none), removed_.assign(piece_.size(), 0);
}

std::span<const std::uint32_t> LeafElements::source(std::uint32_t node) const {
  const LeafPiece& piece = pieces_.list[piece_[node]];
  const auto all = std::span(pieces_.triangles).subspan(piece.first, piece.last - piece.first);
  return piece.card ? all : all.subspan(node - first_[piece_[node]], 1);
}

DrawnLeaf LeafElements::drawn(std::uint32_t node) {
  const auto triangles = source(node);
  used_.clear(), put_.clear();
  for (const std::uint32_t t : triangles) {
    DrawnLeaf::Face face;
    for (int c = 0; c < 3; ++c) {
      const std::uint32_t v = pieces_.part.triangles[t][c];
      if (number_[v] == k_none) number_[v] = static_cast<std::uint32_t>(used_.size()), used_.push_back(v);
      face[c] = number_[v];
    }
    put_.push_back(face);
  }
  DrawnLeaf leaf;
  if (used_.size() > leaf.corner.size() || put_.size() > leaf.face.size()) {
    fronds_.push_back({{}, put_});
    for (const std::uint32_t v : used_) fronds_.back().vertices.push_back(pieces_.part.vertices[v]);
    leaf.frond = &fronds_.back();
  } else {
    for (const std::uint32_t v : used_) leaf.corner[leaf.corners++] = pieces_.part.vertices[v];
    for (const auto& face : put_) leaf.face[leaf.faces++] = face;
  }
  for (const std::uint32_t v : used_) number_[v] = k_none;
  return leaf;
}

void LeafElements::merge(std::span<const std::uint32_t> nodes, const DrawnLeaf& leaf, std::uint32_t material,
                         std::uint32_t radius) {
  if (held_) {
    const std::uint32_t before = pending_of_[nodes.front()];
    for (const std::uint32_t n : nodes) pending_of_[n] = k_gone;
    const bool again = before < pending_.size();
    pending_of_[nodes.front()] = again ? before : static_cast<std::uint32_t>(pending_.size());
    if (!again) pending_.emplace_back();
    pending_[pending_of_[nodes.front()]] = {leaf, material, radius};
    return;
  }
  builder_.step(0);
  for (const std::uint32_t n : nodes) gone_[n] = 1;
  for (const std::uint32_t n : nodes) vanish(n);
  element_[nodes.front()] = put(leaf, material, radius);
}

void LeafElements::remove(std::span<const std::uint32_t> nodes) {
  builder_.step(0);
  for (const std::uint32_t n : nodes) gone_[n] = removed_[n] = 1;
  for (const std::uint32_t n : nodes) vanish(n);
}

void LeafElements::hold(std::vector<std::uint32_t> order, double triangles) {
  held_ = true, order_ = std::move(order), shown_ = triangles;
}

void LeafElements::show_at(double triangles) {
  if (!held_ || triangles > shown_) return;
  held_ = false;
  builder_.step(0);
  for (const std::uint32_t n : order_) {
    const std::uint32_t p = pending_of_[n];
    if (p == k_none && removed_[n] == 0) continue;  // it is drawn as it was
    if (p == k_gone && removed_[n] != 0) continue;
    gone_[n] = 1;
    if (p == k_gone) builder_.step(0);  // the others are part of the step before: triangles only go
    if (removed_[n] == 0) vanish(n);
    if (p == k_gone) continue;
    const LeafPiece& piece = pieces_.list[piece_[n]];
    const Pending now = p == k_none ? Pending{drawn(n), piece.material, piece.radius} : pending_[p];
    element_[n] = put(now.leaf, now.material, now.radius);
  }
  pending_.clear(), order_.clear();
}

// What is drawn of the node is drawn no longer.
void LeafElements::vanish(std::uint32_t node) {
  dissolve(node);
  if (element_[node] != k_none) builder_.remove(element_[node]);
  element_[node] = k_none;
}

// A piece of the source goes as a whole: those of its triangles that stay get elements of their own.
void LeafElements::dissolve(std::uint32_t node) {
  const std::uint32_t p = piece_[node];
  if (piece_element_[p] == k_none) return;
  builder_.remove(piece_element_[p]);
  piece_element_[p] = k_none;
  for (std::uint32_t n = first_[p]; n < first_[p + 1]; ++n) {
    if (gone_[n] != 0) continue;
    const std::uint32_t triangle = source(n).front();
    element_[n] = builder_.element(pieces_.list[p].material, pieces_.list[p].radius,
                                   std::span(&pieces_.part.triangles[triangle], 1));
  }
}

std::uint32_t LeafElements::put(const DrawnLeaf& leaf, std::uint32_t material, std::uint32_t radius) {
  used_.clear(), put_.clear();
  for (const SpectrumVertex& v : leaf.vertices()) used_.push_back(builder_.vertex(v));
  for (const auto& t : leaf.triangles()) put_.push_back({used_[t[0]], used_[t[1]], used_[t[2]]});
  return builder_.element(material, radius, put_);
}

}  // namespace copse
