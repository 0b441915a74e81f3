// The bytes of one spectrum (spectrum_file.h checks what comes out of them).
#pragma once

#include "lib/formats/levels/spectrum_file.h"

#include <expected>
#include <span>
#include <string>

namespace copse::spectrum_codec {

Result<EncodedSpectrum> encode(const Spectrum& spectrum, const SpectrumCodingOptions& options,
                               const Tree* tree);

// Sizes are checked against what is stored before memory is taken; the text of the error says what is wrong.
// Counts are left empty; elements and indices are not checked.
std::expected<Spectrum, std::string> decode(std::span<const std::uint8_t> bytes, const Tree* tree);

}  // namespace copse::spectrum_codec
