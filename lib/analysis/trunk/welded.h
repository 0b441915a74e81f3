// A connected surface without readable rings -> the part of the hierarchy that lies inside it.
#pragma once

#include "lib/analysis/rings/hierarchy.h"
#include "lib/analysis/surface/trunk_mesh.h"

#include <cstdint>
#include <span>

namespace copse {

enum class WeldedMethod : std::uint8_t {
  automatic,  // rings where fork-to-fork tubes can be read, otherwise a surface skeleton
  rings,      // rings only; what cannot be read stays unexplained
  surface,    // surface skeleton only
};

// How a surface skeleton is found.
enum class SurfaceMethod : std::uint8_t {
  automatic,  // by levels; by flow too where levels fit badly and the surface is small enough, and the better
              // one kept
  levels,     // level_skeleton.h
  flow,       // flow_skeleton.h; by levels where that can close nothing
};

struct WeldedOptions {
  WeldedMethod method = WeldedMethod::automatic;
  SurfaceMethod surface = SurfaceMethod::automatic;
};

// Recovers the hierarchy of one connected surface. `triangles` are ids of whole.triangles, ascending; they
// are connected through shared vertices, and no other triangle of `whole` shares a vertex with them.
//
// The answer:
// - radii: parents before children, radii[0] is the one root, everything hangs on it (the caller reroots and
//   attaches); at least one radius, whatever the surface. `branch` is numbered from 0.
// - first_vertex, ring_vertices: ids of whole.positions. A vertex belongs to at most one radius.
// - segment_of: one entry a triangle of `triangles`, in that order: the local id of the child radius of the
//   segment that explains it, or k_none.
// - notes: what a user should know, one line each.
// Never fails; every number is finite; the cost is near-linear; deterministic.
Hierarchy recover_welded(const TrunkMesh& whole, std::span<const std::uint32_t> triangles,
                         const WeldedOptions& options = {});

}  // namespace copse
