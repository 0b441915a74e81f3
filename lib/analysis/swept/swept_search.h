// swept_search: the least capsule, lozenge or line around points that descents from many frames find.
//
// Some hundreds of frames, laid out from the principal frame, are judged by a volume in closed form; from the
// best of them that are apart a rough descent each, then to the end from those that can still be the best.
// Deterministic. What is found is the global optimum nearly always (docs/swept.md has figures);
// swept_bound.h proves how far from it it can be.
#pragma once

#include "lib/analysis/hull/deadline.h"
#include "lib/analysis/swept/swept_descent.h"

namespace copse {

// `points`: hull vertices in canonical order, at least one, |p| about 1 or less. With a deadline, as many
// starts as the time allows, at least one.
SweptFit search_around(Swept kind, std::span<const Double3> points, const Deadline& deadline = {});

}  // namespace copse
