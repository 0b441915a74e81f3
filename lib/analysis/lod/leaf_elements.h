// leaf_elements: the leaves that a collapse works on, and the spectrum that becomes of them.
//
// A node is what collapses as one: a triangle of an opaque piece (the cheapest leaf there is), a whole piece
// that is cut out of a picture. In the spectrum a piece is one element until the first of its nodes goes.
#pragma once

#include "lib/analysis/lod/leaf_pieces.h"
#include "lib/analysis/lod/spectrum_builder.h"

#include <array>
#include <cmath>
#include <deque>
#include <span>
#include <vector>

namespace copse {

// A piece of the source that is more than a card.
struct Frond {
  std::vector<SpectrumVertex> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

// What is drawn of a node.
struct DrawnLeaf {
  using Face = std::array<std::uint32_t, 3>;
  std::array<SpectrumVertex, 4> corner{};
  std::array<Face, 2> face{};
  std::uint32_t corners = 0, faces = 0;
  const Frond* frond = nullptr;  // instead of these

  std::span<const SpectrumVertex> vertices() const {
    return frond != nullptr ? std::span<const SpectrumVertex>(frond->vertices)
                            : std::span(corner).first(corners);
  }
  std::span<const Face> triangles() const {
    return frond != nullptr ? std::span<const Face>(frond->triangles) : std::span(face).first(faces);
  }
  std::span<SpectrumVertex> own() { return std::span(corner).first(corners); }
  double area() const {
    double sum = 0;
    const auto v = vertices();
    for (const Face& f : triangles()) {
      const Double3 a = to_double(v[f[0]].position);
      const Double3 n = cross(to_double(v[f[1]].position) - a, to_double(v[f[2]].position) - a);
      sum += 0.5 * std::sqrt(dot(n, n));
    }
    return sum;
  }
  Double3 centre() const {
    Double3 sum{};
    for (const SpectrumVertex& v : vertices()) sum += to_double(v.position);
    return sum / double(vertices().size());
  }
};

// A leaf with the corners that leaf_shape gives, that looks like a triangle of a piece: with its texture; a
// card where the piece is one. `normal`: of its vertices, and the side to which it faces.
DrawnLeaf leaf_of_shape(const LeafPieces& pieces, std::uint32_t piece, std::uint32_t triangle,
                        const std::array<Double3, 4>& corners, const Double3& normal);

class LeafElements {
 public:
  // Keeps a reference to `pieces`.
  explicit LeafElements(const LeafPieces& pieces);

  std::uint32_t size() const { return static_cast<std::uint32_t>(piece_.size()); }  // nodes at full detail
  std::uint32_t piece(std::uint32_t node) const { return piece_[node]; }
  // The triangles of `pieces.part` that the node is at full detail.
  std::span<const std::uint32_t> source(std::uint32_t node) const;
  // A frond lives as long as this.
  DrawnLeaf drawn(std::uint32_t node);

  // One step: all of `nodes` go, and the first of them is from now on what is drawn here. Cost: the
  // nodes, and once the triangles of each piece.
  void merge(std::span<const std::uint32_t> nodes, const DrawnLeaf& leaf, std::uint32_t material,
             std::uint32_t radius);
  // One step: the nodes go and nothing takes their place.
  void remove(std::span<const std::uint32_t> nodes);
  // From now on the nodes that were removed are back and merges go on, but nothing of it is drawn before
  // show_at() is told that no more than `triangles` are left. `order`: all nodes.
  void hold(std::vector<std::uint32_t> order, double triangles);
  // In small steps, each node in its turn, what is drawn becomes what has been merged since hold().
  void show_at(double triangles);
  // What the builder says of the steps so far; all errors are 0. Leaves nothing here.
  Spectrum finish() { return builder_.finish(); }

 private:
  struct Pending {
    DrawnLeaf leaf;
    std::uint32_t material = k_none, radius = k_none;
  };
  void vanish(std::uint32_t node);
  void dissolve(std::uint32_t node);
  std::uint32_t put(const DrawnLeaf& leaf, std::uint32_t material, std::uint32_t radius);

  const LeafPieces& pieces_;
  SpectrumBuilder builder_;
  std::vector<std::uint32_t> piece_;               // of each node
  std::vector<std::uint32_t> first_;               // node of each piece, and one number more
  std::vector<std::uint32_t> element_;             // of each node, while it has one of its own
  std::vector<std::uint32_t> piece_element_;       // of each piece, while it is whole
  std::vector<std::uint8_t> gone_;                 // of each node: one of a merge
  std::vector<std::uint32_t> number_, used_;       // while a leaf is drawn
  std::vector<std::array<std::uint32_t, 3>> put_;  // while one is put
  std::deque<Frond> fronds_;
  bool held_ = false;
  double shown_ = 0;                       // triangles at which what is held is shown,
  std::vector<std::uint32_t> order_;       // node by node
  std::vector<Pending> pending_;           // leaves that are merged and not yet drawn
  std::vector<std::uint32_t> pending_of_;  // of each node: one of them, k_gone or k_none
  std::vector<std::uint8_t> removed_;      // of each node: by remove()
};

}  // namespace copse
