// weld: which positions of a mesh are one point.
//
// Exporters repeat a position for every normal and texture seam; topology can only be read once the copies
// are one. Thesis (digest 000) section 1.3: "adjacency must be computed on positions".
#pragma once

#include "lib/formats/mesh.h"

#include <cstdint>
#include <span>
#include <vector>

namespace copse {

// The representative of each position: the lowest index of the positions that it is welded to, itself when it
// is welded to none; representative[r] == r for every representative r. Positions are visited by ascending
// index; each joins the lowest representative within the tolerance (of both points, where they differ), so
// welding never chains: a point and its representative are never farther apart than the tolerance.
// Equal positions are always welded. Positions are finite, tolerances finite and >= 0, in the unit of the
// positions. O(n), hashed.
std::vector<std::uint32_t> weld(std::span<const Double3> positions, double tolerance);
std::vector<std::uint32_t> weld(std::span<const Double3> positions, std::span<const double> tolerances);

// The same where `equal` is weld(positions, 0.0) already.
std::vector<std::uint32_t> weld(std::span<const Double3> positions, std::span<const double> tolerances,
                                std::vector<std::uint32_t> equal);

// The same with tolerances from the mesh itself.
std::vector<std::uint32_t> weld(std::span<const Double3> positions, std::span<const Triangle> triangles);

// These tolerances, one a position (tolerances.h): far below the edges that meet there (at it or at an equal
// position), above rounding. 0 for positions that no triangle uses.
std::vector<double> weld_tolerances(std::span<const Double3> positions, std::span<const Triangle> triangles);

// The same where `equal` is weld(positions, 0.0) already.
std::vector<double> weld_tolerances(std::span<const Double3> positions, std::span<const Triangle> triangles,
                                    std::span<const std::uint32_t> equal);

}  // namespace copse
