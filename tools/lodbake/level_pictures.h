// Levels as pictures: for dividing triangles by what is seen.
#pragma once

#include "lib/analysis/lod/coupling.h"
#include "lib/analysis/lod/spectrum_pictures.h"
#include "lib/analysis/measure/drawn_mesh.h"
#include "lib/analysis/measure/picture.h"
#include "lib/formats/levels/spectrum.h"

#include <array>
#include <optional>
#include <vector>

namespace copse::lodbake {

DrawnMesh drawn_level(const LodSpectra& spectra, const LodLevel& level);

// Judges levels from six sides at about the size on screen at which they are drawn: the fewer triangles, the
// smaller the picture.
class LevelPictures {
 public:
  // Keeps references to both, and to what `looks` refers to.
  LevelPictures(const LodSpectra& spectra, const Looks& looks);
  // Root mean square error of the pictures against full detail's.
  double error(const TriedLevel& level);

 private:
  static constexpr std::array k_sizes{128, 96, 48};
  std::vector<OrthographicView> views(std::size_t size) const;

  const LodSpectra& spectra_;
  Looks looks_;
  double full_ = 0, radius_ = 0;
  Double3 centre_;
  std::array<std::vector<Picture>, k_sizes.size()> source_;
  std::array<std::optional<SpectrumPictures>, k_sizes.size()> pictures_;
};

}  // namespace copse::lodbake
