// The hierarchy of a tree as lines, points and spheres: what a tree looks like to the analysis (digest 000,
// fig. 2.4). Widths are diameters in metres; who draws them decides how (copse expands them to quads that
// face the camera).
#pragma once

#include "lib/formats/tree/tree.h"

#include <cstdint>
#include <vector>

namespace copse {

struct SkeletonLine {
  Float3 a, b;  // from the parent to the child, relative to the tree's origin
  float diameter_a = 0, diameter_b = 0;
  std::uint32_t level = 0;  // of the branch: 0 for a stem, 1 for what grows from it, ...
  bool joint = false;       // no surface joins the two: a free tube hangs here
  friend bool operator==(const SkeletonLine&, const SkeletonLine&) = default;
};

struct SkeletonPoint {
  Float3 centre;
  float diameter = 0;
  std::uint32_t level = 0;
  bool root = false, terminal = false;
  friend bool operator==(const SkeletonPoint&, const SkeletonPoint&) = default;
};

// A leaf as the point that can stand for it.
struct LeafPoint {
  Float3 centre;
  float diameter = 0;            // of the disc that has the area of a leaf of its group
  std::uint32_t group = k_none;  // k_none: in no group
  friend bool operator==(const LeafPoint&, const LeafPoint&) = default;
};

struct GroupSphere {
  Float3 centre;
  float radius = 0;
  std::uint32_t leaves = 0;
  Float3 terminal;     // the centre of the terminal radius that it hangs on
  bool hangs = false;  // false: no radius names it (a .tree, or leaves without a trunk)
  friend bool operator==(const GroupSphere&, const GroupSphere&) = default;
};

struct Skeleton {
  std::vector<SkeletonLine> lines;
  std::vector<SkeletonPoint> points;
  std::vector<LeafPoint> leaves;    // in the order of the leaf groups
  std::vector<GroupSphere> groups;  // as stored
  std::uint32_t levels = 0;         // one more than the largest level
};

// Of an .stree: a line from every radius to its parent, a point for every radius. Of a .tree: its lines; the
// points are their ends, and a line's child end is as thick as the thickest line that starts there.
// Levels: of the children of a radius the thickest one that is not a joint continues the branch (the first
// one when equal); every other child begins a branch one level up.
Skeleton make_skeleton(const Tree& tree);

}  // namespace copse
