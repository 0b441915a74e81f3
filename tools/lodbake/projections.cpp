#include "tools/lodbake/projections.h"

#include "lib/analysis/lod/lines_points.h"
#include "lib/analysis/measure/view_sphere.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace copse::lodbake {
namespace {

struct Way {
  const char* name;
  EstimateOptions options;
};

constexpr std::array<Way, 3> k_ways{{{"as printed", {Orientation::seed, 1.8}},
                                     {"spread evenly", {Orientation::isotropic, 2}},
                                     {"second moments", {Orientation::tensor, 2}}}};
constexpr std::array<std::pair<const char*, double>, 3> k_coverages{
    {{"all", 1}, {"half", 0.5}, {"a tenth", 0.1}}};

struct Quantity {
  const char* name;
  double Projection::*value;
};
constexpr std::array<Quantity, 3> k_quantities{{{"leaf area", &Projection::leaf_area},
                                                {"trunk area", &Projection::trunk_area},
                                                {"length", &Projection::length}}};

}  // namespace

void report_projections(const Tree& tree, int views, Context& context) {
  Stage stage = context.stage("lines and points");
  const std::vector<Double3> directions = view_sphere(subdivisions_for(views)).directions;
  Table table{.name = "lines and points",
              .columns = {"Estimate", "Of the picture", "Leaf area, mean", "Leaf area, largest",
                          "Trunk area, mean", "Trunk area, largest", "Length, mean", "Length, largest"},
              .rows = {}};
  Projection worst;
  for (const Way& way : k_ways) {
    for (const auto& [share, coverage] : k_coverages) {
      const ProjectionErrors e = projection_errors(tree, coverage, directions, way.options);
      std::vector<std::string> row{way.name, share};
      for (const Quantity& q : k_quantities) {
        row.push_back(fmt::format("{:.1f} %", 100 * e.mean.*q.value));
        row.push_back(fmt::format("{:.1f} %", 100 * e.largest.*q.value));
        if (way.options.orientation == Orientation::tensor)
          worst.*q.value = std::max(worst.*q.value, e.largest.*q.value);
      }
      table.rows.push_back(std::move(row));
    }
  }
  stage.items(k_ways.size() * k_coverages.size() * directions.size(), "projections");
  for (const Quantity& q : k_quantities)
    context.report().errors.push_back({fmt::format("projected {}, largest", q.name),
                                       worst.*q.value,
                                       "ratio",
                                       worst.*q.value,
                                       {},
                                       {},
                                       "sum over all triangles and segments"});
  context.report().tables.push_back(std::move(table));
}

}  // namespace copse::lodbake
