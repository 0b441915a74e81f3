// Every tolerance of the trunk analysis, in one place: name, value, unit, reason.
#pragma once

namespace copse {

// --- welding
// ------------------------------------------------------------------------------------------------- Positions
// that a generator computed twice (seams: angle 0 and angle 2 pi) or that a file rounded twice differ by a
// few units of the last stored digit, never by a visible share of the edges that meet there.

// Share of the bounding box's diagonal. Files with four decimals of a ten metre tree round at 1e-5 of it.
inline constexpr double k_weld_of_diagonal = 1.0 / (1 << 16);
// Share of the shortest edge at the vertex. A ring of any k has edges of its own length between its vertices,
// so a sixteenth of an edge can never join two of them, however thin the twig.
inline constexpr double k_weld_of_edge = 1.0 / 16;
// Share of the coordinate's own size: four units in the last place of a float32. Edges that are shorter than
// this are rounding noise themselves and do not shrink the tolerance.
inline constexpr double k_weld_float_noise = 1.0 / (1 << 22);
// ... but never more than this share of the diagonal, for meshes far from the origin stored in more digits.
inline constexpr double k_weld_noise_of_diagonal = 1.0 / (1 << 23);

}  // namespace copse
