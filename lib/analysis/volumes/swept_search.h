// swept_search: the least capsule, lozenge or line around points that descents from many frames find.
//
// Every frame of a fixed set, laid out from the principal frame, is tried with a rough descent over a few
// points; the best half of them (of a small hull all) go on to the end over all points. A dozen points or
// fewer get more starts, as their volumes have few, deep valleys. Deterministic. What is found is the global
// optimum nearly always (docs/volumes.md has figures); swept_bound.h proves how far from it it can be.
#pragma once

#include "lib/analysis/volumes/swept_descent.h"

namespace copse {

// `points`: hull vertices in canonical order, at least one, |p| about 1 or less.
SweptFit search_around(Swept kind, std::span<const Double3> points);

}  // namespace copse
