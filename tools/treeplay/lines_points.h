// --lod lines-points: a tree as triangles, lines and points, chosen frame by frame (digest 000, chapter 4).
#pragma once

#include "lib/formats/tree/tree.h"
#include "lib/runtime/line_point_selection.h"
#include "lib/runtime/sky_light.h"
#include "lib/runtime/tree_geometry.h"
#include "tools/treeplay/primitives.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace copse::treeplay {

class LinesPoints {
 public:
  // `colour`: of a material's surface in linear light, without light. `ranges`: those of make_geometry(tree).
  LinesPoints(const Tree& tree, const std::vector<DrawRange>& ranges,
              const std::function<Float3(std::uint32_t material, DrawPart part)>& colour);

  // How open the sky is where they are: without this, wide open.
  void take_light(const SkyLight& sky);

  struct Frame {
    // Triangles: indices and ranges of the geometry. Lines and points: as wide as they are at their depth.
    std::vector<std::uint32_t> indices;
    std::vector<DrawRange> ranges;
    std::vector<FlatLine> lines;
    std::vector<FlatDisc> points;
  };
  // `geometry`: make_geometry(tree). `eye` relative to the tree's origin, `forward` unit; `pixel`: metres of
  // a pixel at distance 1. `sun`: unit, towards it; (0, 0, 0) for colours as they are.
  void select(const TreeGeometry& geometry, const Double3& eye, const Double3& forward, double pixel,
              const Float3& sun, Frame& out) const;

 private:
  void add_lines(const TreeGeometry& geometry, const Double3& eye, const Double3& forward, double pixel,
                 const Float3& sun, Frame& out) const;
  void add_leaves(const Double3& eye, const Double3& forward, double pixel, const Float3& sun,
                  std::vector<std::uint32_t>& runs, Frame& out) const;

  struct Segment {
    Float3 a, b;
    Float4 sky{0, 0.5f, 0, 0.5f};
  };
  struct Leaf {
    Float3 centre, normal, colour;
    Float4 sky{0, 0.5f, 0, 0.5f};
  };
  std::vector<Segment> segments_;
  std::vector<float> diameters_;
  Float3 trunk_colour_, trunk_centre_;
  std::vector<LeafGroup> groups_;
  std::vector<Leaf> leaves_;  // in the order of the groups
  std::vector<std::vector<std::uint32_t>>
      keys_;  // of every range's triangles: segment, or place among the leaves
};

}  // namespace copse::treeplay
