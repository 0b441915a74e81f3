// LOD spectra in a tree's file: sections LSTR (trunk), LSLV (leaves) and LSLD (the levels). docs/formats.md
// has the bytes.
//
// A reader trusts nothing: what does not fit together is refused with the section and what is wrong; what is
// decoded is bounded by the size of what is stored.
#pragma once

#include "lib/formats/container/container.h"
#include "lib/formats/levels/spectrum.h"
#include "lib/formats/packing/range_coder.h"
#include "lib/formats/result.h"
#include "lib/formats/tree/tree.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace copse {

inline constexpr std::uint32_t k_spectrum_version = 3;

enum class SpectrumCoding : std::uint32_t {
  fast = 0,   // every array as it lies in memory: exact, nothing to decode
  small = 1,  // quantised, then coded by meshoptimizer and zstd
  based = 2,  // against the tree that it is of: full detail is the tree's, the rest lies beside it
};

struct SpectrumCodingOptions {
  SpectrumCoding coding = SpectrumCoding::fast;
  int position_bits = 14;  // of the longest side of the box, 8 to 16
  int texcoord_bits = 12;  // of the range of each coordinate, 8 to 16
};

struct EncodedSpectrum {
  std::vector<std::uint8_t> bytes;
  double position_error =
      0;  // the largest distance of a vertex from where it was, metres; at most half a step a side, of a tube
          // that is coded against the tree a sixteenth of the error of its state where that is more, of a
          // leaf that was made for a level a thirty-second of its size
  std::vector<StreamCost> streams = {};  // of what is coded against the tree
};

// Deterministic. Errors: a spectrum whose arrays do not fit together is a bug of the caller.
// SpectrumCoding::small becomes `based` where there is a tree whose full detail the spectrum's is, and a
// method that can be.
Result<EncodedSpectrum> encode_spectrum(const Spectrum& spectrum, const SpectrumCodingOptions& options,
                                        const Tree* tree = nullptr);

// `name` stands in messages. Indices, lifetimes, order and sizes are checked; counts are made anew from the
// elements. Radii and materials are not known here: check_spectrum_links does those.
// `tree`: without it, what is coded against the tree is refused.
Result<Spectrum> decode_spectrum(std::span<const std::uint8_t> bytes, const std::string& name,
                                 const Tree* tree = nullptr);

// Radii and materials of the elements are below these, or none; empty when all is well.
std::string check_spectrum_links(const Spectrum& spectrum, std::size_t radii, std::size_t materials);

std::vector<std::uint8_t> encode_levels(const LodSpectra& spectra);
// Fills schedule, discrete, hysteresis, near and far; the spectra must be there, their steps bound the
// levels'.
Result<void> decode_levels(std::span<const std::uint8_t> bytes, const std::string& name, LodSpectra& spectra);

struct SpectraCosts {
  double trunk_error = 0, leaf_error = 0;  // of positions, metres
  std::vector<StreamCost> trunk, leaves;   // of what is coded against the tree
};
// Adds or replaces the three sections; an empty spectrum has none.
Result<SpectraCosts> put_spectra(ContainerWriter& writer, const LodSpectra& spectra,
                                 const SpectrumCodingOptions& options, const Tree* tree = nullptr);

// Whether there are levels; and all of them, checked against the tree's counts.
bool has_spectra(const Container& file);
// The tree is taken from the file itself where it is needed.
Result<LodSpectra> load_spectra(const Container& file, std::size_t radii, std::size_t materials);

}  // namespace copse
