#include "lib/analysis/leaves/stem_contacts.h"

#include "lib/analysis/bvh/hilbert_rtree.h"
#include "lib/analysis/measure/triangle_distance.h"
#include "lib/analysis/surface/components.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

namespace copse {
namespace {

constexpr std::uint32_t k_run = 8, k_fan = 8;  // triangles a box, boxes a node
constexpr double k_reach_of_size = 0.1;

using Corners = std::array<Double3, 3>;

// Whether the side from p to q passes through the triangle.
bool crosses(const Double3& p, const Double3& q, const Corners& t) {
  const Double3 n = cross(t[1] - t[0], t[2] - t[0]), way = q - p;
  const double above = dot(p - t[0], n), below = dot(q - t[0], n);
  if ((above > 0) == (below > 0)) return false;
  const Double3 at = p + way * (above / (above - below));
  for (int e = 0; e < 3; ++e) {
    if (dot(cross(t[(e + 1) % 3] - t[e], at - t[e]), n) < 0) return false;
  }
  return true;
}

bool touch(const Corners& a, const Corners& b, double reach) {
  for (int i = 0; i < 3; ++i) {
    if (square_distance(a[i], b[0], b[1], b[2]) <= reach * reach) return true;
    if (square_distance(b[i], a[0], a[1], a[2]) <= reach * reach) return true;
    if (crosses(a[i], a[(i + 1) % 3], b) || crosses(b[i], b[(i + 1) % 3], a)) return true;
  }
  return false;
}

bool overlap(const DoubleBox& a, const DoubleBox& b) {
  for (int axis = 0; axis < 3; ++axis) {
    if (a.min[axis] > b.max[axis] || b.min[axis] > a.max[axis]) return false;
  }
  return true;
}

class Contacts {
 public:
  Contacts(const Mesh& mesh, const PieceScan& scan, std::span<const std::uint32_t> stems)
      : mesh_(mesh), sets_(stems.size() + 1) {
    for (std::uint32_t i = 0; i < stems.size(); ++i) {
      const PlacedPiece& placed = scan.placed()[stems[i]];
      const double size = placed.shape.size;
      const double reach =
          std::min(k_reach_of_size * size, placed.shape.area / (2 * std::numbers::pi * size));
      reach_.push_back(std::isfinite(reach) ? reach : 0);
      for (const std::uint32_t t : scan.triangles().of(placed.piece)) {
        stem_.push_back(i), triangle_.push_back(t);
      }
    }
    sort_by_place();
    make_boxes();
  }

  void stand(std::uint32_t stem) { sets_.unite(stem, wood()); }
  bool is_wood(std::uint32_t stem) { return sets_.find(stem) == sets_.find(wood()); }

  // Unites a stem with what it touches, until it is known to be wood.
  void look_round(std::uint32_t stem, std::span<const std::uint32_t> triangles) {
    for (const std::uint32_t t : triangles) {
      if (is_wood(stem)) return;
      const Corners corners = corners_of(t);
      DoubleBox box = box_of(t, reach_[stem]);
      for (std::size_t n = 0; n < tree_.nodes.size();) {
        const bool inside = overlap(box, node_boxes_[n]);
        if (inside && tree_.nodes[n].item != k_none) look_at(stem, corners, box, tree_.nodes[n].item);
        n = inside ? n + 1 : tree_.nodes[n].skip;
      }
    }
  }

 private:
  std::uint32_t wood() const { return static_cast<std::uint32_t>(reach_.size()); }
  Corners corners_of(std::uint32_t t) const {
    const Triangle& v = mesh_.triangles[t];
    return {mesh_.positions[v[0]], mesh_.positions[v[1]], mesh_.positions[v[2]]};
  }
  DoubleBox box_of(std::uint32_t t, double reach) const {
    DoubleBox box;
    for (const Double3& c : corners_of(t)) box.grow(c);
    return widened(box, reach);
  }
  static DoubleBox widened(DoubleBox box, double reach) {
    const Double3 r{reach, reach, reach};
    box.min = box.min - r, box.max = box.max + r;
    return box;
  }

  void sort_by_place() {
    std::vector<Double3> middles;
    for (const std::uint32_t t : triangle_) {
      const Corners c = corners_of(t);
      middles.push_back((c[0] + c[1] + c[2]) / 3.0);
    }
    std::vector<std::uint32_t> stem, triangle;
    for (const std::uint32_t i : hilbert_order(middles)) {
      stem.push_back(stem_[i]), triangle.push_back(triangle_[i]);
    }
    stem_ = std::move(stem), triangle_ = std::move(triangle);
  }
  void make_boxes() {
    std::vector<DoubleBox> boxes((triangle_.size() + k_run - 1) / k_run);
    for (std::size_t i = 0; i < triangle_.size(); ++i) {
      boxes[i / k_run].grow(box_of(triangle_[i], reach_[stem_[i]]));
    }
    tree_ = hilbert_rtree(boxes, k_fan);
    node_boxes_ = node_boxes(tree_, boxes);
  }

  void look_at(std::uint32_t stem, const Corners& corners, const DoubleBox& box, std::uint32_t run) {
    const std::size_t end = std::min<std::size_t>(triangle_.size(), (run + 1ull) * k_run);
    for (std::size_t i = std::size_t{run} * k_run; i < end; ++i) {
      if (sets_.find(stem_[i]) == sets_.find(stem)) continue;
      if (!overlap(box, box_of(triangle_[i], reach_[stem_[i]]))) continue;
      if (touch(corners, corners_of(triangle_[i]), std::max(reach_[stem], reach_[stem_[i]])))
        sets_.unite(stem, stem_[i]);
    }
  }

  const Mesh& mesh_;
  std::vector<std::uint32_t> stem_, triangle_;  // along Hilbert's curve
  std::vector<double> reach_;                   // one a stem
  BoxTree tree_;
  std::vector<DoubleBox> node_boxes_;
  UnionFind sets_;  // of stems, and one more: of wood
};

}  // namespace

std::vector<std::uint8_t> stem_contacts(const Mesh& mesh, const PieceScan& scan,
                                        std::span<const std::uint32_t> stems,
                                        std::span<const std::uint32_t> standing) {
  std::vector<std::uint8_t> is_wood(stems.size(), 0);
  if (standing.empty()) return is_wood;
  Contacts contacts(mesh, scan, stems);
  for (const std::uint32_t s : standing) {
    contacts.stand(static_cast<std::uint32_t>(std::ranges::lower_bound(stems, s) - stems.begin()));
  }
  // The largest first: then what most others hang on is known to be wood when they are asked.
  std::vector<std::uint32_t> order(stems.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::stable_sort(order, std::greater{},
                           [&](std::uint32_t i) { return scan.placed()[stems[i]].shape.area; });
  for (const std::uint32_t i : order) {
    contacts.look_round(i, scan.triangles().of(scan.placed()[stems[i]].piece));
  }
  for (std::uint32_t i = 0; i < order.size(); ++i) is_wood[i] = contacts.is_wood(i);
  return is_wood;
}

}  // namespace copse
