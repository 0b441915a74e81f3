// strict_model: the thesis' own trunk analysis on models that obey its rules, and every breach of the rules.
//
// Digest 000, sections 1.1 (the rules) to 1.3 (the algorithm, with an explicit stack instead of recursion).
#pragma once

#include "lib/formats/mesh.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace copse {

// One rule that the model breaks, and where.
struct Breach {
  std::string rule;     // numbered as in digest 000, section 1.1: "4.5: every radius has k vertices"
  std::string what;     // "radii of another number of vertices than the first root's 6"
  std::string element;  // what the numbers count: "vertex", "triangle", "face"; from 0, as in the mesh
  std::vector<std::uint32_t> elements;  // all of them, ascending
};

// "rule 4.5: every radius has k vertices: ...: 5 (vertex 12, 19, 40-42)"
std::string to_text(const Breach& breach);

struct StrictModel {
  std::uint32_t ring_size = 0;                 // k: vertices of the first root
  std::vector<std::uint32_t> parent;           // one a radius, parents first; k_none for a root
  std::vector<std::uint32_t> first_vertex{0};  // radii + 1
  std::vector<std::uint32_t> vertices;  // representatives as weld() gives them, ascending inside a ring
  std::vector<Breach> breaches;         // all of them; empty: the model is sound
};

// `welded`: weld()'s answer for mesh.positions. `leaf_of`: one a triangle, k_none on the trunk. Radii are
// read as far as the algorithm gets; a child with another number of vertices than k is named and still
// followed, so that one breach does not hide the next. O(n log n).
StrictModel read_strict_model(const Mesh& mesh, std::span<const std::uint32_t> welded,
                              std::span<const std::uint32_t> leaf_of);

}  // namespace copse
