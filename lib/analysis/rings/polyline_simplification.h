// polyline_simplification: which points of a polyline stay when the others are implied.
//
// Source: Ramer 1972, Douglas and Peucker 1973: keep what is farthest from the line between two points that
// stay, until all is near enough. It finds the corners that a line was made from, but takes quadratic time
// where it always splits off an end, as on a curve that straightens; there the rest is found by reaching
// ahead.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

namespace copse {

// How much point `i` is needed where of the points from `a` to `b` (a < i < b) only these two stay: it may go
// unless this is more than 1. NaN counts as not needed.
using PointNeed = std::function<double(std::size_t a, std::size_t b, std::size_t i)>;

// `keep`, one a point: not 0 for those that stay in any case; is set for those that must stay between two of
// them. What lies before the first of these and behind the last is left alone. Afterwards no point between
// two consecutive ones that stay is needed. Of points that are needed as much, the first stays.
// Deterministic; the need is asked for O(n log n) times, whatever it says.
void simplify_polyline(std::span<std::uint8_t> keep, const PointNeed& need);

}  // namespace copse
