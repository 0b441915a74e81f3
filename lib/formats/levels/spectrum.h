// A LOD spectrum: everything that one part of a tree (its trunk or its leaves) looks like between full detail
// and nothing, as one sequence of steps; and how one number, a level, picks from the spectra of both parts.
//
// A spectrum is made of elements: what appears and disappears as one (a leaf, one side of a tube, a
// triangle). After n steps, 0 <= n <= steps, exactly the elements with birth <= n < death are drawn. n = 0 is
// full detail: the triangles of the tree. So a level is never an index list of its own, whatever method made
// it (digest 003, hazard H-14), and going from one level to another touches only what differs.
#pragma once

#include "lib/formats/array.h"
#include "lib/formats/material.h"
#include "lib/formats/vec.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace copse {

// Which method made a spectrum (docs/lod.md). The value is stored.
enum class LodMethod : std::uint32_t {
  radii = 1,     // trunk by radii (000 section 5.7)
  edges = 2,     // half-edge collapses (003)
  collapse = 3,  // leaf collapse: two leaves become one bigger
  prune = 4,     // foliage pruning (001): leaves vanish in stratified random order, survivors grow
};

struct SpectrumVertex {
  Float3 position;  // relative to the tree's origin
  Float3 normal;    // length 1
  Float2 texcoord;  // (0, 0) where the tree has none; v up
  friend bool operator==(const SpectrumVertex&, const SpectrumVertex&) = default;
};

struct SpectrumElement {
  std::uint32_t birth = 0;          // there after n steps when birth <= n < death
  std::uint32_t death = k_none;     // k_none: after every number of steps
  std::uint32_t material = k_none;  // index into the tree's materials
  // The radius of the hierarchy that this hangs on: of a trunk's element the child radius of its segment (of
  // a tube that spans several segments the last one's), of a leaf the radius that bears it. k_none: no one
  // knows.
  std::uint32_t radius = k_none;
  friend bool operator==(const SpectrumElement&, const SpectrumElement&) = default;
};

struct Spectrum {
  LodMethod method = LodMethod::radii;
  Array<SpectrumVertex> vertices;
  Array<SpectrumElement> elements;                // by descending death, then ascending birth
  Array<std::uint32_t> first_triangle;            // elements + 1 offsets
  Array<std::array<std::uint32_t, 3>> triangles;  // vertices; element after element
  Array<std::uint32_t> counts;  // steps + 1: triangles after n steps, never more than before
  Array<float> errors;          // steps + 1: metres, 0 first, never less than before

  std::uint32_t steps() const { return counts.empty() ? 0 : static_cast<std::uint32_t>(counts.size() - 1); }
};

// One level: how many steps of each spectrum have been taken.
struct LodLevel {
  std::uint32_t trunk_steps = 0, leaf_steps = 0;
  std::uint32_t triangles = 0;  // of both parts together
  float error = 0;              // metres: the larger of both spectra's errors after these steps (an estimate)
  float distance = 0;           // metres from the camera at which it takes over from the finer one; between
                                // two knots that of the finer knot
  friend bool operator==(const LodLevel&, const LodLevel&) = default;
};

// The spectra of a tree, coupled. A part without a spectrum is drawn in full detail at every level.
struct LodSpectra {
  Spectrum trunk, leaves;
  // The division of triangles between the parts: knots from full detail to the coarsest level; both step
  // counts and the error never decrease, the triangles never increase. Between two knots both parts go in
  // proportion (level_of_triangles in lib/runtime/levels.h).
  std::vector<LodLevel> schedule;
  std::vector<LodLevel> discrete;  // the levels that were asked for, finest first, without full detail
  float hysteresis = 0.1f;         // share of a distance by which switching back is delayed (003 section 3.3)
  float near = 0, far = 0;         // metres: full detail up to near, the last level from far on
};

}  // namespace copse
