// hull_frames: the square rings round the forks of a skin as they were before their corners were merged.
#pragma once

#include "lib/analysis/surface/lists.h"
#include "lib/formats/vec.h"

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace copse {

// What a skin modifier laid round a tree of lines: square rings, and forks, round which it laid none.
struct FrameGraph {
  using Corners = std::array<std::uint32_t, 4>;
  std::vector<Corners> corners;          // one a node, in order round it: vertices; k_none: a fork
  std::vector<std::uint8_t> is_regular;  // one a node: whether a ring is a square as it stands
  Lists neighbours;                      // one a node: the nodes beside it along the lines
};

// A ring by its centre, the unit normal of its plane and the distance of its corners; of a fork only the
// centre.
struct Frame {
  Double3 centre{}, normal{};
  double reach = 0;
  bool is_solved = false;  // whether a fork, and every ring next to it, is known
  bool is_face = false;    // whether it is no ring but a face of the hull that the next ring was hung on
};

// The modifier (after Ji, Liu and Wang, B-Mesh, 2010) sets a square across each point of a line, in the plane
// that halves the bend there and without twist between one and the next, and hulls the squares next to a
// fork; corners of theirs that come close are first merged in their middle, and a square that is not wholly
// on the hull is hung on one of its faces, its corners doubled. The fork itself leaves no trace but these
// squares. They and the fork's place follow from all that together: the middle of merged corners, halved
// bends and no twist (Levenberg and Marquardt's iteration). Rings that are regular and share no corner are
// used and not changed. A fork is solved when everything round it is as foretold, to noise(reach) metres;
// what else there is stays as it was taken for: the mean of a ring's corners, of a fork's neighbours. A
// corner that more than two rings share says nothing. Which rings are faces is told by doubled corners, or by
// what makes a fork of up to 16 limbs solved. Where fewer than half of the rings are regular that is no skin,
// and nothing is solved. Deterministic; about linear in rings.
std::vector<Frame> solve_hull_frames(std::span<const Double3> positions, const FrameGraph& graph,
                                     const std::function<double(double)>& noise);

}  // namespace copse
