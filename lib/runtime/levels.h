// Levels of detail at run time: which level, and the index list to draw it with.
//
// Source: digest 003 sections 3.2, 3.3, 8.5 and its hazards H-07 to H-10; digest 001 section 7. No call
// allocates.
#pragma once

#include "lib/formats/levels/spectrum.h"

#include <cstdint>
#include <span>
#include <vector>

namespace copse {

// A spectrum made ready for drawing: built once when a tree is loaded.
class LevelExtractor {
 public:
  // Keeps a reference to `spectrum`.
  explicit LevelExtractor(const Spectrum& spectrum);

  // Writes the indices of what is drawn after `steps` steps (clamped), three a triangle; returns how many.
  // `out` must hold capacity() indices. Material after material in the order of materials(). Cost: that of
  // copying the indices that are written, in pieces of some hundred elements.
  std::size_t extract(std::uint32_t steps, std::span<std::uint32_t> out) const;
  // The same for the elements of one material: indices of them alone.
  std::size_t extract(std::uint32_t steps, std::uint32_t material, std::span<std::uint32_t> out) const;

  std::size_t capacity() const { return capacity_; }
  const std::vector<std::uint32_t>& materials() const { return materials_; }  // ascending

 private:
  // Neighbours by descending death, sorted by birth among themselves: while none of them is dead, what is
  // alive is a prefix.
  struct Window {
    std::uint32_t first = 0, end = 0;  // elements
    std::uint32_t first_to_die = 0, last_to_die = 0;
  };
  struct Run {                                       // of one material
    std::uint32_t material = 0, first = 0, end = 0;  // windows
  };
  std::size_t extract_run(const Run& run, std::uint32_t steps, std::uint32_t* out) const;

  const Spectrum* spectrum_;
  std::vector<Run> runs_;
  std::vector<Window> windows_;
  std::vector<std::uint32_t> births_, deaths_;  // in the order of the windows
  std::vector<std::uint32_t> first_index_;      // elements + 1
  std::vector<std::uint32_t> indices_;
  std::vector<std::uint32_t> materials_;
  std::size_t capacity_ = 0;
};

// No steps taken: all triangles, no error.
LodLevel full_detail(const LodSpectra& spectra);

// Where a file has no schedule, the three below choose between full detail and the discrete levels.
//
// The level of the schedule with at most so many triangles (the coarsest when none has), in between its
// knots.
LodLevel level_of_triangles(const LodSpectra& spectra, std::uint64_t triangles);
// The coarsest level of the schedule whose error is at most `error` metres, in between its knots. An error is
// that of the worst point: one of a pixel asks for far more than looks alike, which distances tell better.
LodLevel level_of_error(const LodSpectra& spectra, double error);
// Continuous detail by distance: full up to `near`; then the triangles fall with the square of the distance,
// as the size on screen does (hazard H-11), down to what is left at `far`, which stays (003, section 8.1).
// With near = 0 that is the coarsest at any distance. Not a number: full detail.
LodLevel level_of_distance(const LodSpectra& spectra, double distance);
// The distance to ask level_of_distance for, so that a camera that sways changes nothing: the one that was
// held before while `distance` is within the hysteresis of it (from (1 - h) to (1 + h) times), otherwise the
// nearest that has `distance` within. `held`: not a number when there is none yet.
double held_distance(const LodSpectra& spectra, double distance, double held);

// The discrete level to draw at a distance: 0 is full detail, i + 1 is spectra.discrete[i]. `current` is what
// was drawn before: going coarser needs a distance beyond (1 + h) times the border, going finer one below (1
// - h) times it (digest 003, section 3.3). A `current` that does not exist counts as none: the level is that
// of the borders.
std::uint32_t choose_discrete(const LodSpectra& spectra, double distance, std::uint32_t current);

// Whether the impostor that takes over at `border` metres is drawn, with the hysteresis of the spectra;
// `drawn`: whether it was before.
bool choose_impostor(const LodSpectra& spectra, double border, double distance, bool drawn);

}  // namespace copse
