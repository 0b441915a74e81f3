// The levels of detail of a tree that is drawn: which one is shown, and its triangles.
#pragma once

#include "lib/formats/levels/impostors.h"
#include "lib/formats/levels/spectrum.h"
#include "lib/formats/result.h"
#include "lib/formats/tree_file/tree_file.h"
#include "lib/runtime/levels.h"
#include "lib/runtime/tree_geometry.h"

#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace copse::treeplay {

enum class Lod { off, lines_points, foliage, spectrum, automatic };

// What the command line asks for: a level, or a way to choose one by distance.
struct DetailWish {
  std::optional<std::uint64_t> level;      // 0 is full detail
  std::optional<double> ratio, max_error;  // of full detail's triangles; metres
  Lod lod = Lod::off;
  bool names_one() const { return level || ratio || max_error; }
  bool needs_levels() const { return names_one() || lod == Lod::spectrum || lod == Lod::automatic; }
};

struct ShownLevel {
  // 0: full detail, n: the n-th discrete level, k_none: one in between; behind the last one the impostor
  std::uint32_t number = 0;
  LodLevel level;
  bool impostor = false;
  friend bool operator==(const ShownLevel&, const ShownLevel&) = default;
};

// The pictures that stand for a tree behind its last level, as they are stored.
struct TreeImpostor {
  ImpostorAtlas atlas;
  std::string file;  // that holds them
};

class TreeLevels {
 public:
  // None when the file holds no levels.
  static Result<std::shared_ptr<const TreeLevels>> load(const TreeFile& file, const Tree& tree);

  const LodSpectra& spectra() const { return spectra_; }
  const std::optional<TreeImpostor>& impostor() const { return impostor_; }
  // The number of the last one: the impostor's when there is one.
  std::uint32_t last() const {
    return static_cast<std::uint32_t>(spectra_.discrete.size()) + (impostor_ ? 1 : 0);
  }
  // The vertices of every level and the indices of full detail, with a range for each material of each part.
  // A part without a spectrum is the tree's own.
  TreeGeometry geometry() const;
  // Puts the indices of a level into what geometry() gave.
  void take(const LodLevel& level, TreeGeometry& geometry) const;
  std::uint64_t triangles(const LodLevel& level) const { return own_triangles_ + level.triangles; }

 private:
  TreeLevels(LodSpectra spectra, const Tree& tree);
  void add_vertices(const Spectrum& spectrum);
  void append(const LevelExtractor& extractor, DrawPart part, std::uint32_t steps, TreeGeometry& out) const;

  LodSpectra spectra_;
  std::optional<TreeImpostor> impostor_;
  LevelExtractor trunk_, leaves_;
  TreeGeometry base_;  // vertices of all, ranges and indices of parts without a spectrum
  std::uint32_t first_leaf_vertex_ = 0, first_trunk_vertex_ = 0;
  std::uint64_t own_triangles_ = 0;
};

// Decides on the level, frame by frame.
class LevelChoice {
 public:
  // Refused when the file cannot do what is wished. `levels` may be null when the wish needs none.
  static Result<LevelChoice> make(std::shared_ptr<const TreeLevels> levels, const DetailWish& wish,
                                  const std::filesystem::path& file);

  // For an eye so far from the tree, metres. Discrete levels go by the borders and the hysteresis of the
  // file.
  const ShownLevel& at(double distance);
  // By hand from now on: one coarser or finer; and back to choosing by distance.
  void step(int coarser);
  void choose_by_distance();
  bool is_by_distance() const { return way_ == Way::discrete || way_ == Way::continuous; }

 private:
  enum class Way { fixed, discrete, continuous };
  ShownLevel numbered(std::uint32_t number) const;

  std::shared_ptr<const TreeLevels> levels_;
  Way way_ = Way::fixed;
  ShownLevel shown_;
  double held_ = std::numeric_limits<double>::quiet_NaN();  // of Way::continuous: held_distance
};

}  // namespace copse::treeplay
