// The exact hierarchy of a grown mesh, in the mesh's own frame and units: what treeprep is asked to recover.
// docs/treegrow.md describes the JSON.
#pragma once

#include "lib/formats/material.h"
#include "lib/formats/vec.h"

#include <cstdint>
#include <string>
#include <vector>

namespace copse::grow {

// A ring of mesh vertices. Rings of a branch follow one another.
struct TruthRing {
  Double3 centre;                 // mean of its vertices
  double diameter = 0;            // 2/k sum |v - c|
  std::uint32_t parent = k_none;  // an earlier ring
  std::uint32_t branch = 0;
  bool tip = false;                // all vertices in one point
  std::uint32_t same_as = k_none;  // an earlier ring in the same place
};

struct TruthBranch {
  std::uint32_t parent = k_none;  // branch
  std::uint32_t level = 0;
  std::uint32_t first = 0, rings = 0;
  std::uint32_t k = 0;
  bool terminal = true;                        // nothing grows from it
  std::uint32_t attach[2] = {k_none, k_none};  // the parent's rings that it leaves from or between
};

struct TruthLeafGroup {  // the leaves of one branch
  Double3 centre;
  double radius = 0;  // of a sphere round their vertices
  std::uint32_t leaves = 0;
  std::uint32_t branch = 0;
};

struct Truth {
  std::string name;  // species
  std::string mesh;  // file
  bool z_up = false;
  double height = 0;  // of the mesh, roots included
  DoubleBox bounds;
  std::vector<TruthRing> rings;
  std::vector<TruthBranch> branches;
  std::vector<TruthLeafGroup> leaf_groups;
  std::uint64_t leaf_components = 0;  // connected pieces by index
  std::uint64_t leaf_triangles = 0;
  std::vector<Double3> leaf_centres;                      // mean of a leaf's vertices
  std::vector<std::uint32_t> leaf_branch;                 // one a leaf
  std::vector<std::pair<std::string, std::string>> made;  // species, seed, breaks, ...: for the reader
};

std::string to_json(const Truth& truth);

}  // namespace copse::grow
