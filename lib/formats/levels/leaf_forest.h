// Which leaves give way to which: the structure of a spectrum of leaves (spectrum_leaves.h).
#pragma once

#include "lib/formats/levels/part_triangles.h"
#include "lib/formats/levels/spectrum.h"
#include "lib/formats/tree/tree.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace copse {

// Nodes come with the children of one together and after it; node 0 stands for what is left at the end.
struct LeafForest {
  struct Node {
    std::uint32_t parent = k_none;
    std::uint32_t first_child = 0, children = 0;  // made leaves that give way to this one
    std::uint32_t first_source = 0, sources = 0;  // triangles of the tree that do
    std::uint32_t step = k_none;                  // at which it is made; k_none for node 0
    std::uint32_t material = k_none, radius = k_none;
    bool drawn = true;  // otherwise the others just go
    std::vector<std::array<std::uint32_t, 3>> faces;
    std::vector<SpectrumVertex> vertices;  // by first use
  };
  std::vector<Node> nodes;
  std::vector<std::uint32_t> sources;  // triangles of the tree's leaves, node after node, depth first
  std::vector<std::uint32_t>
      piece_of;                      // of every triangle of the tree: the element that it belongs to at first
  std::vector<std::uint32_t> radii;  // of the pieces
  std::uint32_t steps = 0;
};

// Nothing when the spectrum has another structure.
std::optional<LeafForest> leaf_forest(const Spectrum& spectrum, const PartTriangles& part);

// The spectrum of a forest, without counts and errors. What is wrong with the forest instead.
std::string spectrum_of(const LeafForest& forest, const PartTriangles& part, Spectrum& spectrum);

}  // namespace copse
