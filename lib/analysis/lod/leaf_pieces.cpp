#include "lib/analysis/lod/leaf_pieces.h"

#include "lib/analysis/lod/radius_ancestors.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace copse {
namespace {

// Below this a texture is a cut-out; above it, its alpha is a rim that no one sees.
constexpr double k_opaque = 0.995;

class Cutter {
 public:
  explicit Cutter(const Tree& tree) : tree_(tree) { out_.part = leaf_triangles(tree); }

  LeafPieces run() {
    for (const Material& m : tree_.materials) out_.opacity.push_back(m.alpha_coverage);
    for (double& o : out_.opacity) o = o > 0 && o <= 1 ? o : 1;
    const RadiusAncestors ancestors(tree_);
    std::vector<std::uint32_t> group(tree_.leaf_count(), k_none);
    for (std::uint32_t g = 0; g < tree_.leaves.groups.size(); ++g) {
      const LeafGroup& range = tree_.leaves.groups[g];
      for (std::uint64_t i = range.first;
           i < std::uint64_t{range.first} + range.count && i < tree_.leaves.order.size(); ++i)
        if (tree_.leaves.order[i] < group.size()) group[tree_.leaves.order[i]] = g;
    }
    for (std::uint32_t l = 0; l < group.size(); ++l) {
      const std::uint32_t radius = group[l] == k_none ? k_none : ancestors.of_group()[group[l]];
      cut(l, group[l], radius);
    }
    return std::move(out_);
  }

 private:
  std::uint32_t find(std::uint32_t t) {
    while (parent_[t] != t) t = parent_[t] = parent_[parent_[t]];
    return t;
  }

  void cut(std::uint32_t leaf, std::uint32_t group, std::uint32_t radius) {
    const std::size_t begin = std::min(tree_.first_triangle_of_leaf(leaf), out_.part.triangles.size());
    const std::size_t end = std::min(tree_.first_triangle_of_leaf(leaf + 1), out_.part.triangles.size());
    connect(begin, end);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> by_root;
    for (std::size_t t = begin; t < end; ++t)
      by_root.emplace_back(find(static_cast<std::uint32_t>(t - begin)), static_cast<std::uint32_t>(t));
    std::sort(by_root.begin(), by_root.end());
    for (std::size_t i = 0, j = 0; i < by_root.size(); i = j) {
      LeafPiece piece{
          leaf, static_cast<std::uint32_t>(out_.triangles.size()), 0, k_none, group, radius, false, {}};
      for (j = i; j < by_root.size() && by_root[j].first == by_root[i].first; ++j)
        out_.triangles.push_back(by_root[j].second);
      piece.last = static_cast<std::uint32_t>(out_.triangles.size());
      piece.material = out_.part.materials[by_root[i].second];
      piece.card = !tree_.leaves.texcoords.empty() && out_.opacity_of(by_root[i].second) < k_opaque;
      piece.cut = piece.card && j - i > 1 ? LeafCut::card : LeafCut::triangle;
      out_.list.push_back(piece);
    }
  }

  // The smaller triangle is the root, so that pieces come in the order of their first triangles.
  void connect(std::size_t begin, std::size_t end) {
    parent_.resize(end - begin);
    std::iota(parent_.begin(), parent_.end(), 0u);
    corners_.clear();
    for (std::size_t t = begin; t < end; ++t)
      for (const std::uint32_t v : out_.part.triangles[t])
        corners_.emplace_back(out_.part.position_of[v], static_cast<std::uint32_t>(t - begin));
    std::sort(corners_.begin(), corners_.end());
    for (std::size_t i = 1; i < corners_.size(); ++i) {
      if (corners_[i].first != corners_[i - 1].first) continue;
      const std::uint32_t a = find(corners_[i - 1].second), b = find(corners_[i].second);
      parent_[std::max(a, b)] = std::min(a, b);
    }
  }

  const Tree& tree_;
  LeafPieces out_;
  std::vector<std::uint32_t> parent_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> corners_;
};

}  // namespace

LeafPieces leaf_pieces(const Tree& tree) {
  return Cutter(tree).run();
}

Double3 LeafPieces::up_of(std::uint32_t triangle) const {
  const auto& [a, b, c] = part.triangles[triangle];
  const SpectrumVertex &p = part.vertices[a], &q = part.vertices[b], &r = part.vertices[c];
  const Double3 e = to_double(q.position) - to_double(p.position),
                f = to_double(r.position) - to_double(p.position);
  const double eu = double(q.texcoord.x) - p.texcoord.x, ev = double(q.texcoord.y) - p.texcoord.y;
  const double fu = double(r.texcoord.x) - p.texcoord.x, fv = double(r.texcoord.y) - p.texcoord.y;
  const double det = eu * fv - ev * fu;
  if (!(std::abs(det) > 0)) return {};
  return normalized((f * eu - e * fu) / det, {});
}

std::array<Float2, 4> LeafPieces::texcoords(std::uint32_t piece, std::uint32_t triangle) const {
  if (list[piece].cut == LeafCut::triangle) {
    std::array<Float2, 4> uv{};
    int lowest = 0;
    for (int c = 0; c < 3; ++c) uv[c] = part.vertices[part.triangles[triangle][c]].texcoord;
    for (int c = 1; c < 3; ++c)
      if (uv[c].y < uv[lowest].y) lowest = c;
    std::rotate(uv.begin(), uv.begin() + lowest, uv.begin() + 3);
    return uv;
  }
  FloatBox box;
  for (std::uint32_t t = list[piece].first; t < list[piece].last; ++t)
    for (const std::uint32_t v : part.triangles[triangles[t]])
      box.grow(Float3{part.vertices[v].texcoord.x, part.vertices[v].texcoord.y, 0});
  return {
      Float2{box.min.x, box.min.y}, {box.max.x, box.min.y}, {box.max.x, box.max.y}, {box.min.x, box.max.y}};
}

}  // namespace copse
