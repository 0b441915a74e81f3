#include "tools/ecogen/frames.h"

#include "lib/formats/instance_codec.h"
#include "lib/runtime/block_culling.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

namespace copse::ecogen {
namespace {

constexpr std::size_t k_cells = 64, k_frames = 1000;
constexpr double k_aspect = 2.4, k_near = 0.01, k_far = 1e7;

std::size_t cell(double at, double low, double high) {
  return static_cast<std::size_t>(std::clamp((at - low) / (high - low) * k_cells, 0.0, k_cells - 1.0));
}

}  // namespace

std::uint64_t drop_unseen(std::vector<Instance>& instances, const std::vector<TreeType>& types,
                          const PlantedArea& area, const CameraPath& path, double range) {
  const auto cell_of = [&](const Instance& i) {
    return cell(i.position.z, area.z0, area.z1) * k_cells + cell(i.position.x, area.x0, area.x1);
  };
  std::vector<DoubleBox> boxes(k_cells * k_cells);
  for (const Instance& i : instances) boxes[cell_of(i)].grow(transformed(types[i.type].bounds, i));
  std::vector<Camera> cameras;
  double step = 0;
  for (std::size_t f = 0; f < k_frames; ++f) {
    cameras.push_back(path.at(static_cast<double>(f) / (k_frames - 1)));
    if (f > 0) step = std::max(step, distance(cameras[f].eye, cameras[f - 1].eye));
  }
  std::vector<Frustum> frusta;
  for (const Camera& c : cameras) frusta.push_back(frustum_of(make_view(c, k_aspect, k_near, k_far)));
  std::vector<std::uint8_t> seen(boxes.size());
  tbb::parallel_for(std::size_t{0}, boxes.size(), [&](std::size_t b) {
    if (boxes[b].empty()) return;
    const Double3 margin{step, step, step};
    const DoubleBox box{boxes[b].min - margin, boxes[b].max + margin};
    for (std::size_t f = 0; f < k_frames && !seen[b]; ++f)
      seen[b] = (range <= 0 || distance_to(cameras[f].eye, box) <= range) &&
                classify(frusta[f], cameras[f].eye, box) != Visibility::outside;
  });
  const std::size_t before = instances.size();
  std::erase_if(instances,
                [&](const Instance& i) { return !boxes[cell_of(i)].empty() && !seen[cell_of(i)]; });
  return before - instances.size();
}

}  // namespace copse::ecogen
