// The last step of decoding a spectrum: elements as they come become a spectrum in order.
#pragma once

#include "lib/formats/levels/spectrum.h"

#include <string>
#include <vector>

namespace copse {

struct SpectrumDraft {
  SpectrumElement element;
  std::vector<std::array<std::uint32_t, 3>> faces;  // of the vertices beside the drafts
};

// Elements by descending death, then ascending birth, then as they come; vertices that are used, by first
// use. Counts and errors are not touched. What is wrong, empty when nothing is: an element has no triangle.
std::string assemble_spectrum(std::vector<SpectrumDraft>& drafts, const std::vector<SpectrumVertex>& vertices,
                              Spectrum& spectrum);

}  // namespace copse
