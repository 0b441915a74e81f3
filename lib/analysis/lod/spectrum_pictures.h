// spectrum_pictures: pictures of many levels of the same spectra. A level has most of its elements in common
// with those before it, so where each element is seen is found once and kept.
#pragma once

#include "lib/analysis/measure/picture.h"
#include "lib/formats/levels/spectrum.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace copse {

class SpectrumPictures {
 public:
  // At most so many samples of elements are kept a view, of 12 bytes each; what is beyond is found anew for
  // every picture.
  static constexpr std::size_t k_kept = std::size_t{1} << 21;

  // Keeps references to `spectra` and to what `looks` refers to. Linear in the triangles of both spectra.
  SpectrumPictures(const LodSpectra& spectra, const Looks& looks, std::span<const OrthographicView> views,
                   int samples = 2, std::size_t kept = k_kept);
  ~SpectrumPictures();
  SpectrumPictures(const SpectrumPictures&) = delete;
  SpectrumPictures& operator=(const SpectrumPictures&) = delete;

  // One picture a view, bit for bit as draw_picture draws the trunk after so many steps and, behind it in
  // order, the elements of the leaves that `leaves` says are drawn (one entry each, not 0). Cost: elements
  // that were in no picture before as draw_picture's, those that were by the samples they cover. Views are
  // drawn in parallel; calls are not to be.
  std::vector<Picture> draw(std::uint32_t trunk_steps, std::span<const std::uint8_t> leaves);

 private:
  class Part;
  class View;

  const LodSpectra& spectra_;
  std::vector<std::uint8_t> known_;  // whether an element has been drawn; those of the trunk first
  std::unique_ptr<const Part> trunk_, leaves_;
  std::vector<Float3> shades_;  // of every triangle, those of the trunk first
  std::vector<View> views_;
};

}  // namespace copse
