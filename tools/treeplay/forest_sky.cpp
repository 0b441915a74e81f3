#include "tools/treeplay/forest_sky.h"

#include "lib/formats/hash.h"
#include "lib/formats/random.h"
#include "lib/runtime/block_stream.h"

#include <algorithm>
#include <cmath>

namespace copse::treeplay {
namespace {

constexpr std::size_t k_points_of_type = 64;
constexpr std::size_t k_few_trees = 4000;    // that all take part themselves
constexpr double k_points_of_many = 100000;  // of the others together
constexpr std::size_t k_resolution = 64;

// Points of a type's tree, each for as much of its projected area.
struct TypeCloud {
  std::vector<Float3> points;
  double area = 0;  // of each, at scale 1
};

// Adds the triangles' projected areas, or finds those at which `step` and its multiples are reached.
class AreaWalk {
 public:
  AreaWalk(const Scene& scene, const std::vector<DrawRange>& ranges) : scene_(scene), ranges_(ranges) {}

  template <class Visit>
  double walk(Visit visit) const {
    const TreeGeometry& g = scene_.geometry;
    double sum = 0;
    for (const DrawRange& range : ranges_) {
      const Material m = material_of(scene_, range);
      const double opacity = double{m.alpha} * (m.alpha_cutoff > 0 ? double{m.alpha_coverage} : 1);
      // The mean projection of a card is half its area, of a closed surface a quarter (Cauchy).
      const double weight = opacity * (range.part == DrawPart::leaves ? 0.5 : 0.25);
      for (std::size_t i = range.first_index; i + 2 < std::size_t{range.first_index} + range.index_count;
           i += 3) {
        const auto at = [&](std::size_t k) { return to_double(g.vertices[g.indices[i + k]].position); };
        const Double3 a = at(0), b = at(1), c = at(2);
        const double area = weight * length(cross(b - a, c - a)) / 2;
        if (!(area > 0) || !std::isfinite(area)) continue;
        sum += area;
        visit(sum, (a + b + c) / 3.0);
      }
    }
    return sum;
  }

 private:
  const Scene& scene_;
  const std::vector<DrawRange>& ranges_;
};

TypeCloud cloud_of(const Scene& scene, const ForestType& type) {
  const AreaWalk walk(scene, type.levels[0]);
  const double all = walk.walk([](double, const Double3&) {});
  TypeCloud cloud;
  if (!(all > 0)) return cloud;
  cloud.area = all / k_points_of_type;
  walk.walk([&](double sum, const Double3& centre) {
    while (cloud.points.size() < k_points_of_type &&
           (static_cast<double>(cloud.points.size()) + 0.5) * cloud.area <= sum)
      cloud.points.push_back(to_float(centre));
  });
  return cloud;
}

class ForestCloud {
 public:
  explicit ForestCloud(const Scene& scene) : eco_(*scene.eco) {
    for (const ForestType& type : scene.forest.types) types_.push_back(cloud_of(scene, type));
  }

  std::vector<SkyOccluder> occluders() {
    if (eco_.instance_count() <= k_few_trees)
      add_trees();
    else
      for (std::uint32_t b = 0; b < eco_.blocks.size(); ++b) add_block(b);
    return std::move(occluders_);
  }

 private:
  void add_trees() {
    BlockStream stream(eco_, 0);
    for (std::uint32_t b = 0; b < eco_.blocks.size(); ++b) {
      const TypeCloud& cloud = types_[eco_.blocks[b].type];
      for (const StreamedInstance& i : stream.block(b))
        for (const Float3& p : cloud.points)
          occluders_.push_back({moved({i.rows, i.tint}, p),
                                static_cast<float>(cloud.area * double{i.scale} * double{i.scale})});
    }
  }

  void add_block(std::uint32_t number) {
    const InstanceBlock& block = eco_.blocks[number];
    const TypeCloud& cloud = types_[block.type];
    if (block.bounds.empty() || cloud.points.empty()) return;
    const TreeType& type = eco_.types[block.type];
    const double low = double{type.scale_min}, high = double{type.scale_max};
    const double square = (low * low + low * high + high * high) / 3;  // the mean of the scale's
    const double wanted = block.count * k_points_of_many / static_cast<double>(eco_.instance_count());
    const auto points = static_cast<std::size_t>(std::max(1.0, std::round(wanted)));
    const double area = cloud.area * k_points_of_type * square * block.count / static_cast<double>(points);
    Random random = Random(xxh3(type.name)).fork(number);
    const Float3 from = block.bounds.min, to = block.bounds.max;
    for (std::size_t k = 0; k < points; ++k) {
      const double x = random.uniform(double{from.x}, double{to.x}),
                   z = random.uniform(double{from.z}, double{to.z});
      const auto ground = ground_height(eco_.terrain, x + eco_.origin.x, z + eco_.origin.z);
      const double up = (low + high) / 2 * double{cloud.points[random.below(cloud.points.size())].y};
      const double y = (ground ? *ground - eco_.origin.y : double{from.y}) + up;
      occluders_.push_back({to_float(Double3{x, y, z}), static_cast<float>(area)});
    }
  }

  const Ecosystem& eco_;
  std::vector<TypeCloud> types_;
  std::vector<SkyOccluder> occluders_;
};

}  // namespace

SkyLight forest_sky(const Scene& scene) {
  return make_sky_light(ForestCloud(scene).occluders(), scene.geometry.bounds, k_resolution);
}

}  // namespace copse::treeplay
