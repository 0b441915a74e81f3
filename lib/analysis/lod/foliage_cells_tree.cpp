#include "lib/analysis/lod/foliage_cells_tree.h"

#include "lib/analysis/lod/patch.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <queue>
#include <span>

namespace copse {
namespace {

class Cutter {
 public:
  explicit Cutter(const Tree& tree) : tree_(tree), leaves_(tree.leaf_count()) {
    std::iota(leaves_.begin(), leaves_.end(), 0u);
    for (const Float3& v : tree.leaves.vertices) box_.grow(to_double(v));
    offset_ = box_.empty() ? Double3{} : box_.centre();
    patches_.reserve(leaves_.size());
    for (const std::uint32_t l : leaves_) patches_.push_back(patch(l));
  }

  CellCut run(std::uint32_t most) {
    if (leaves_.empty()) return {};
    std::vector<Cell> done;
    std::priority_queue<Cell> open;
    open.push(fit(0, static_cast<std::uint32_t>(leaves_.size())));
    while (!open.empty()) {
      const Cell cell = open.top();
      open.pop();
      const std::uint32_t middle = done.size() + open.size() + 2 <= most ? split(cell) : cell.first;
      if (middle == cell.first) {
        done.push_back(cell);
        continue;
      }
      open.push(fit(cell.first, middle)), open.push(fit(middle, cell.last));
    }
    std::sort(done.begin(), done.end(), [](const Cell& a, const Cell& b) { return a.first < b.first; });
    CellCut out;
    for (const Cell& c : done) {
      std::sort(leaves_.begin() + c.first, leaves_.begin() + c.last);
      out.cells.push_back({c.box, c.first, c.last - c.first});
    }
    out.leaves = std::move(leaves_);
    return out;
  }

 private:
  struct Cell {
    std::uint32_t first = 0, last = 0;
    OrientedBox<float> box;
    float longest() const { return std::max({box.half_extents.x, box.half_extents.y, box.half_extents.z}); }
    // The largest is cut first; of equals the one that comes first.
    bool operator<(const Cell& b) const {
      return longest() != b.longest() ? longest() < b.longest() : first > b.first;
    }
  };

  Patch patch(std::uint32_t leaf) const {
    Patch sum;
    for_each_triangle(leaf, [&](const CornerTriangle& t) {
      std::array<Double3, 3> corners;
      for (int c = 0; c < 3; ++c) corners[c] = to_double(tree_.leaves.vertices[t.vertex[c]]) - offset_;
      sum += patch_of(corners, 1, 1);
    });
    return sum;
  }

  template <class F>
  void for_each_triangle(std::uint32_t leaf, F&& f) const {
    const std::size_t end = std::min(tree_.first_triangle_of_leaf(leaf + 1), tree_.leaves.triangles.size());
    for (std::size_t t = tree_.first_triangle_of_leaf(leaf); t < end; ++t) f(tree_.leaves.triangles[t]);
  }

  Double3 centre(std::uint32_t leaf) const { return to_double(tree_.leaves.centres[leaf]) - offset_; }

  // Leaves without area are fitted by their centres (hazard N3).
  Symmetric3 spread(std::uint32_t first, std::uint32_t last) const {
    Patch sum;
    for (std::uint32_t i = first; i < last; ++i) sum += patches_[leaves_[i]];
    if (sum.area > 0) return sum.covariance();
    Double3 mean{};
    for (std::uint32_t i = first; i < last; ++i) mean += centre(leaves_[i]) / double(last - first);
    Symmetric3 out;
    for (std::uint32_t i = first; i < last; ++i) out.add(centre(leaves_[i]) - mean, 1);
    return out;
  }

  Cell fit(std::uint32_t first, std::uint32_t last) const {
    const Eigen3 axes = eigen(spread(first, last));
    Cell cell{first, last, {}};
    OrientedBox<float>& box = cell.box;
    for (int a = 0; a < 3; ++a) box.axes[a] = to_float(axes.vectors[a]);
    Double3 low{}, high{};
    bool any = false;
    for_each_vertex(first, last, [&](const Double3& p) {
      for (int a = 0; a < 3; ++a) {
        const double along = dot(p - offset_, to_double(box.axes[a]));
        low[a] = any ? std::min(low[a], along) : along, high[a] = any ? std::max(high[a], along) : along;
      }
      any = true;
    });
    Double3 middle = offset_;
    for (int a = 0; a < 3; ++a) middle += axes.vectors[a] * ((low[a] + high[a]) / 2);
    box.centre = to_float(middle);
    // As stored: the axes and the centre have been rounded, so the extents are measured from them.
    Double3 half{};
    for_each_vertex(first, last, [&](const Double3& p) {
      for (int a = 0; a < 3; ++a)
        half[a] = std::max(half[a], std::abs(dot(to_double(box.axes[a]), p - to_double(box.centre))));
    });
    for (int a = 0; a < 3; ++a) box.half_extents[a] = round_up(half[a] * (1 + 0x1p-40));
    return cell;
  }

  template <class F>
  void for_each_vertex(std::uint32_t first, std::uint32_t last, F&& f) const {
    for (std::uint32_t i = first; i < last; ++i)
      for_each_triangle(leaves_[i], [&](const CornerTriangle& t) {
        for (const std::uint32_t v : t.vertex) f(to_double(tree_.leaves.vertices[v]));
      });
  }

  // Where the second half begins, cell.first when nothing separates the leaves: across the longest axis at
  // the mean, then across the next axes.
  std::uint32_t split(const Cell& cell) {
    std::array<int, 3> order{0, 1, 2};
    std::stable_sort(order.begin(), order.end(),
                     [&](int a, int b) { return cell.box.half_extents[a] > cell.box.half_extents[b]; });
    const auto begin = leaves_.begin() + cell.first, end = leaves_.begin() + cell.last;
    for (const int axis : order) {
      const Double3 n = to_double(cell.box.axes[axis]);
      double mean = 0;
      for (auto l = begin; l != end; ++l) mean += dot(centre(*l), n) / double(end - begin);
      const auto middle =
          std::stable_partition(begin, end, [&](std::uint32_t l) { return dot(centre(l), n) < mean; });
      if (middle != begin && middle != end) return cell.first + static_cast<std::uint32_t>(middle - begin);
    }
    return cell.first;
  }

  const Tree& tree_;
  std::vector<std::uint32_t> leaves_;
  std::vector<Patch> patches_;
  DoubleBox box_;
  Double3 offset_;
};

}  // namespace

CellCut cut_cells(const Tree& tree, std::uint32_t most) {
  return Cutter(tree).run(std::max(most, 1u));
}

}  // namespace copse
