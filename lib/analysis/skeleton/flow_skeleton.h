// flow_skeleton: the curve skeleton of a closed surface by mean-curvature flow (Tagliasacchi, Alhashim,
// Olson, Zhang 2012), as CGAL's Surface_mesh_skeletonization computes it.
#pragma once

#include "lib/analysis/skeleton/curve_skeleton.h"
#include "lib/analysis/surface/surface.h"

namespace copse {

// The surface is repaired first: triangles are turned to agree with one another and come apart where they
// cannot (edges of many triangles, Moebius bands), every border is filled, pieces that enclose no volume are
// left out. Each closed piece flows on its own; the skeletons are then joined where the surface joins their
// vertices. Radii are mean distances of the vertices that flowed to a point. No points when nothing can be
// closed.
//
// Costs a sparse factorisation a step, some 10 000 triangles a second. Pieces of more than k_flow_triangles
// are thinned out first.
CurveSkeleton flow_skeleton(const Surface& surface);

}  // namespace copse
