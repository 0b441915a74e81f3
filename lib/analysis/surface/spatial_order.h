// spatial_order: the order in which to work on what lies scattered in its file.
//
// An exporter that sorts by material or hash, or a tool that shuffles, leaves neighbours a cache apart, and
// every pass over the surface then waits for memory: three times as long as over the same surface in order.
#pragma once

#include "lib/formats/mesh.h"

#include <cstdint>
#include <span>
#include <vector>

namespace copse {

// Whether points that follow one another are as a rule far apart: on average by more than k_scattered of the
// diagonal of all. `at`: indices into `positions`. Never for fewer than k_least_scattered: those fit into a
// cache. O(n).
bool is_scattered(std::span<const Double3> positions, std::span<const std::uint32_t> at);

// 0 .. at.size() - 1, by the cell of a grid that the point lies in, 64 cells along the longest axis; cells
// follow Morton's curve (1966), and within one the order is kept. O(n).
std::vector<std::uint32_t> spatial_order(std::span<const Double3> positions,
                                         std::span<const std::uint32_t> at);

// Puts the triangles of a mesh in which they lie scattered into spatial order, by their first corners, and
// its positions, normals and texture coordinates into that of their first use (what nothing uses comes last).
// The answer: where each triangle was before; empty where nothing had to be moved. O(n).
std::vector<std::uint32_t> order_by_place(Mesh& mesh);

}  // namespace copse
