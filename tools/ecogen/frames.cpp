#include "tools/ecogen/frames.h"

#include "lib/analysis/ecosystem/degrees.h"
#include "lib/formats/ecosystem/instance_bounds.h"
#include "lib/runtime/block_culling.h"
#include "lib/runtime/block_stream.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

namespace copse::ecogen {
namespace {

constexpr std::size_t k_cells = 64, k_frames = 1000;
constexpr double k_near = 0.01, k_far = 1e7;

std::size_t cell(double at, double low, double high) {
  return static_cast<std::size_t>(std::clamp((at - low) / (high - low) * k_cells, 0.0, k_cells - 1.0));
}

// The path as frames, and how far anything at distance d may lie from where a frame shows it, at any moment
// between two: any moment is within half a step of one of them.
class Frames {
 public:
  Frames(const CameraPath& path, double aspect) {
    for (std::size_t f = 0; f < k_frames; ++f) {
      views_.push_back(make_view(path.at(static_cast<double>(f) / (k_frames - 1)), aspect, k_near, k_far));
      frusta_.push_back(frustum_of(views_.back()));
      if (f > 0) take_step(views_[f - 1], views_[f]);
    }
  }

  // How far from the eye some frame shows what is in the box, its farthest corner taken, no farther than
  // `range` (0: any distance); 0 when no frame does. `sphere`: how far from
  // its foot that of a tree reaches by which the player tells what is in range.
  double farthest(const DoubleBox& box, double range, double sphere) const {
    double farthest = 0;
    for (std::size_t f = 0; f < views_.size(); ++f) {
      const Double3& eye = views_[f].eye;
      const Double3 far{std::max(std::abs(box.min.x - eye.x), std::abs(box.max.x - eye.x)),
                        std::max(std::abs(box.min.y - eye.y), std::abs(box.max.y - eye.y)),
                        std::max(std::abs(box.min.z - eye.z), std::abs(box.max.z - eye.z))};
      const double reach = std::sqrt(dot(far, far));
      const double margin = step_ + reach * turn_;
      if (reach + margin <= farthest) continue;
      if (range > 0 && distance_to(eye, box) > range + sphere + step_) continue;
      const Double3 m{margin, margin, margin};
      if (classify(frusta_[f], eye, {box.min - m, box.max + m}) != Visibility::outside)
        farthest = reach + margin;
    }
    return range > 0 ? std::min(farthest, range) : farthest;
  }

 private:
  void take_step(const View& a, const View& b) {
    step_ = std::max(step_, distance(a.eye, b.eye) / 2);
    const double back = distance(a.frame.back, b.frame.back), up = distance(a.frame.up, b.frame.up);
    const double wider =
        std::max(std::abs(a.tan_half_x - b.tan_half_x), std::abs(a.tan_half_y - b.tan_half_y));
    turn_ = std::max(turn_, (back + up + wider) / 2);
  }

  std::vector<View> views_;
  std::vector<Frustum> frusta_;
  double step_ = 0, turn_ = 0;
};

}  // namespace

Seen drop_unseen(std::vector<Instance>& instances, const std::vector<TreeType>& types,
                 const PlantedArea& area, const CameraPath& path, double aspect, double lowest_sun) {
  const auto part_of = [&](const Instance& i) {
    const std::size_t at =
        cell(i.position.z, area.z0, area.z1) * k_cells + cell(i.position.x, area.x0, area.x1);
    return at * types.size() + i.type;
  };
  std::vector<DoubleBox> boxes(k_cells * k_cells * types.size());
  const SinCos sun = sin_cos_degrees(lowest_sun);
  const double shadow = sun.cos / sun.sin;  // of a height of 1
  std::vector<double> sphere(boxes.size()), reach_of_type;
  for (const TreeType& t : types) reach_of_type.push_back(reach_from_foot(t));
  for (const Instance& i : instances) {
    DoubleBox box = instance_bounds(types[i.type], i);
    const double reach = shadow * box.extent().y;
    box.min -= Double3{reach, 0, reach}, box.max += Double3{reach, 0, reach};
    const std::size_t part = part_of(i);
    boxes[part].grow(box);
    sphere[part] = std::max(sphere[part], i.scale * reach_of_type[i.type]);
  }
  const Frames frames(path, aspect);
  std::vector<double> farthest(boxes.size());
  tbb::parallel_for(std::size_t{0}, boxes.size(), [&](std::size_t b) {
    if (!boxes[b].empty())
      farthest[b] = frames.farthest(boxes[b], types[b % types.size()].view_range, sphere[b]);
  });
  Seen seen{.dropped = instances.size(), .farthest = std::vector<double>(types.size())};
  for (std::size_t b = 0; b < boxes.size(); ++b)
    seen.farthest[b % types.size()] = std::max(seen.farthest[b % types.size()], farthest[b]);
  // What has no box shows nothing, and is no one's to drop.
  std::erase_if(instances, [&](const Instance& i) {
    const std::size_t part = part_of(i);
    return !boxes[part].empty() && farthest[part] == 0;
  });
  seen.dropped -= instances.size();
  return seen;
}

}  // namespace copse::ecogen
