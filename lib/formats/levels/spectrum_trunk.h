// The spectrum of a trunk by radii, coded against the tree whose trunk it is: full detail is the tree's own
// triangles and costs nothing; a tube that is made is known by the two radii between which it stands, takes
// the place of what stood there, and its rings lie round centres that the hierarchy gives.
#pragma once

#include "lib/formats/levels/spectrum.h"
#include "lib/formats/levels/spectrum_file.h"
#include "lib/formats/tree/tree.h"

#include <cstdint>
#include <expected>
#include <optional>
#include <span>
#include <string>

namespace copse::spectrum_trunk {

// Nothing when full detail is not the tree's, or an element hangs on no radius. Steps, elements, lifetimes,
// materials, radii and triangles are exact; places are on a grid of twice the step of position_bits beside
// the ring's centre, normals octahedral and within 4 steps of 127, texture coordinates on a grid of two bits
// less than texcoord_bits, errors rounded up by less than a thousandth.
std::optional<EncodedSpectrum> encode(const Spectrum& spectrum, const Tree& tree,
                                      const SpectrumCodingOptions& options);

// `bytes`: behind the spectrum's header (spectrum_file.h). Counts are left empty.
std::expected<Spectrum, std::string> decode(std::span<const std::uint8_t> bytes, LodMethod method,
                                            const Tree& tree);

}  // namespace copse::spectrum_trunk
