// The spectrum of leaves that become fewer and bigger, coded against the tree whose leaves they are.
//
// What is stored is how leaves go: which triangles of the tree and which made leaves give way to each leaf
// that is made (a forest, walked depth first, so that leaves in that order need no numbers), in which order
// that happens, and how the made leaf lies beside those that it stands for: one of them, grown about a point;
// or a frame; or its corners. Full detail is the tree's own triangles and costs nothing.
#pragma once

#include "lib/formats/levels/spectrum.h"
#include "lib/formats/levels/spectrum_file.h"
#include "lib/formats/tree/tree.h"

#include <cstdint>
#include <expected>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace copse::spectrum_leaves {

// A corner of a made leaf is within this share of the leaf's size (the root of its area) of where it was.
inline constexpr double k_place_tolerance = 0.06;

// Nothing when the spectrum is not made in that way: full detail is not the tree's, an element goes without
// reason. Steps, elements, lifetimes, materials and radii are exact; places within the tolerance, normals
// within 2 degrees, errors rounded up by less than a thousandth.
std::optional<EncodedSpectrum> encode(const Spectrum& spectrum, const Tree& tree,
                                      const SpectrumCodingOptions& options);

// `bytes`: behind the spectrum's header (spectrum_file.h). Counts are left empty.
std::expected<Spectrum, std::string> decode(std::span<const std::uint8_t> bytes, LodMethod method,
                                            const Tree& tree);

// The leaves of the tree in the order in which the forest reaches them; empty when it is none.
std::vector<std::uint32_t> leaf_order(const Spectrum& spectrum, const Tree& tree);

}  // namespace copse::spectrum_leaves
