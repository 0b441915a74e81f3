// How likely a type of tree stands where: a map of density, times every rule, on a grid of cells.
//
// Source: digest 000, section 8, item 4 (maps as probabilities, populated and empty areas); slope, altitude,
// distance and clusters are rules of terrain tools. A rule is sharp: it lets a point be or not.
#pragma once

#include "lib/analysis/ecosystem/ground.h"
#include "lib/analysis/ecosystem/pixel_distance.h"
#include "lib/analysis/ecosystem/value_map.h"
#include "lib/analysis/leaves/nearest_points.h"
#include "lib/formats/random.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

namespace copse {

struct ValueRange {
  double min = -std::numeric_limits<double>::infinity(), max = std::numeric_limits<double>::infinity();
  bool holds(double v) const { return v >= min && v <= max; }
};

struct Clusters {
  std::uint32_t count = 0;  // 0: none
  double radius = 1;        // m; nothing stands farther from every centre (by more than a cell of the field)
};

// What limits one type. Maps may be null; they outlive the rules.
struct PlacementRules {
  const ValueMap* density = nullptr;    // >= 0, any scale
  const ValueMap* forbidden = nullptr;  // nothing stands where it is at least 1/2
  const ValueMap* share_of = nullptr;   // of a species mix: density is multiplied by share_of / share_total
  std::vector<const ValueMap*> share_total{};  // summed up: every point asks each (means_by_size: few)
  const ValueMap* distance_to =
      nullptr;  // `distance` is that to its pixels of at least 1/2 (pixel_distance.h)
  ValueRange distance{}, slope{}, altitude{};  // m, degrees, m
  Clusters clusters{};
  bool limits_anything() const;
};

struct GroundPlace {
  double x = 0, z = 0;
};

// Weights of cells, row after row over an area.
struct DensityField {
  PlantedArea area;
  std::uint32_t columns = 0, rows = 0;
  std::vector<double> weights;  // >= 0; means over the cells
  std::vector<float> peaks{};   // the largest weight of a point of the cell, its clusters left out
  std::uint32_t samples = 1;    // a side of a cell
  GroundPlace point(std::uint32_t cell, double u, double v) const;  // 0 to 1 across the cell
  double total() const;                                             // summed row by row
};

inline constexpr std::uint32_t k_most_field_cells = 2048;  // a side

// Cells a side for these maps, so many instances and these clusters: at least 2 cells a pixel each way, 4 a
// radius and as many cells as instances, where that fits; at most k_most_field_cells. A whole multiple of the
// map's side, or a whole part of it, where there is one: then no pixel is cut by a cell's border.
std::uint32_t field_side(std::uint32_t largest_map, std::uint64_t instances, const Clusters& clusters,
                         const PlantedArea& area);

// Samples a side of a cell: as many as the pixels of every map and the rules of the ground need.
std::uint32_t field_samples(const PlacementRules& rules, const TerrainGround& ground, std::uint32_t columns,
                            std::uint32_t rows);

// Where in its cell sample (i, j) of `samples` a side lies: in the square of its own that it stands for, each
// in a row and a column of its own, so that thin stripes along the axes are met too.
GroundPlace sample_in_cell(std::uint32_t i, std::uint32_t j, std::uint32_t samples);

// A place that rules are asked about; the ground below it is looked up once, when the first asks for it.
class AskedPlace {
 public:
  AskedPlace(const TerrainGround& ground, double at_x, double at_z) : x(at_x), z(at_z), ground_(ground) {}
  const std::optional<GroundPoint>& ground() {
    if (!asked_) under_ = ground_.at(x, z), asked_ = true;
    return under_;
  }
  const double x, z;

 private:
  const TerrainGround& ground_;
  std::optional<GroundPoint> under_;
  bool asked_ = false;
};

// Whether the sharp rules let something stand here (all but density, shares and clusters, which weigh).
class PlacementTest {
 public:
  // What is given must outlive it. `distance`: that of `rules.distance_to` over the area, where it is made
  // already.
  PlacementTest(const PlacementRules& rules, const PlantedArea& area, const TerrainGround& ground,
                std::shared_ptr<const PixelDistance> distance = {});
  bool allows(AskedPlace& place) const;
  // Density and share, 0 where not allowed; clusters left out. It is unshared() * share() where it is
  // allowed.
  double weight(double x, double z) const;
  // Density over the sum of all shares: the same for all types of a mix. 0 where either is 0.
  double unshared(double x, double z) const;
  double share(double x, double z) const;  // 1 of what is in no mix

  const PlacementRules& rules() const { return rules_; }
  const PlantedArea& area() const { return area_; }
  const TerrainGround& ground() const { return ground_; }

 private:
  const PlacementRules& rules_;
  PlantedArea area_;
  const TerrainGround& ground_;
  bool by_slope_ = false, by_ground_ = false;
  double least_up_ = 0, most_up_ = 1;  // the slope as the normal's y
  std::shared_ptr<const PixelDistance> distance_;
};

// How much the clusters leave of a cell of a field: 1 at a centre, smoothly 0 at the radius; where clusters
// meet the nearer one counts. A cluster smaller than a cell still has the cell that it is in. 1 everywhere
// when there are none.
class ClusterKernel {
 public:
  ClusterKernel(const Clusters& clusters, const PlantedArea& area, std::uint32_t columns, std::uint32_t rows,
                const Random& random);
  double at(const GroundPlace& middle) const;  // of the cell

 private:
  std::vector<Double3> centres_;
  std::optional<NearestPoints> nearest_;
  double most_ = 0;  // the squared radius
};

// Means over the cells; 0 where there is no ground. Every pixel counts, and so does a rule that holds in a
// part of a cell only: a cell is sampled at as many points as its pixels and rules need. Rows in parallel.
DensityField make_field(const PlacementTest& test, std::uint32_t columns, std::uint32_t rows,
                        const Random& random);

}  // namespace copse
