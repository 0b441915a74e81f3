#include "tests/trunk/box_trees.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <numbers>
#include <random>

namespace copse {

namespace {

using Ids = std::vector<std::uint32_t>;

// A face that a limb grows out of, and what its first ring may hang on.
struct Foot {
  Ids corners;
  std::vector<std::uint32_t> parents;
  int depth;
};

class Modeller {
 public:
  explicit Modeller(const BoxTree& shape) : shape_(shape), random_(shape.seed) {}

  BoxTreeMesh run() {
    grow_trunk();
    while (!feet_.empty()) {
      const Foot foot = std::move(feet_.front());
      feet_.pop_front();
      grow_limb(foot);
    }
    for (std::uint32_t t = 0; t < out_.mesh.triangles.size(); ++t) out_.mesh.source.push_back(t);
    out_.mesh.piece.assign(out_.mesh.triangles.size(), 0);
    DoubleBox box;
    for (const Double3& p : out_.mesh.positions) box.grow(p);
    out_.truth.height = box.extent().y;
    return std::move(out_);
  }

 private:
  double draw(double low, double high) { return std::uniform_real_distribution(low, high)(random_); }
  std::uint32_t pick(std::uint32_t n) { return static_cast<std::uint32_t>(random_() % n); }

  std::uint32_t add(const Double3& p) {
    out_.mesh.positions.push_back(p);
    return static_cast<std::uint32_t>(out_.mesh.positions.size() - 1);
  }
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    out_.mesh.triangles.push_back({a, b, c});
  }
  void face(Ids corners) {
    while (corners.size() > 3) {
      const std::uint32_t i = pick(static_cast<std::uint32_t>(corners.size()));
      const std::size_t n = corners.size();
      triangle(corners[(i + n - 1) % n], corners[i], corners[(i + 1) % n]);
      corners.erase(corners.begin() + i);
    }
    triangle(corners[0], corners[1], corners[2]);
  }

  Double3 centre_of(const Ids& ids) const {
    Double3 sum;
    for (const std::uint32_t v : ids) sum += out_.mesh.positions[v];
    return sum / static_cast<double>(ids.size());
  }

  std::uint32_t add_ring(const Ids& ids, std::vector<std::uint32_t> parents) {
    TrueRadius ring;
    ring.centre = centre_of(ids);
    for (const std::uint32_t v : ids)
      ring.diameter += 2 * distance(out_.mesh.positions[v], ring.centre) / static_cast<double>(ids.size());
    ring.parents = std::move(parents);
    out_.truth.radii.push_back(std::move(ring));
    return static_cast<std::uint32_t>(out_.truth.radii.size() - 1);
  }

  // Between two rings; some of the faces will be pulled out.
  void band(const Ids& low, const Ids& high, const std::vector<std::uint32_t>& parents, int depth) {
    for (std::size_t i = 0; i < low.size(); ++i) {
      const std::size_t j = (i + 1) % low.size();
      Ids corners{low[i], low[j], high[j], high[i]};
      if (depth > 0 && draw(0, 1) < shape_.share) {
        feet_.push_back({std::move(corners), parents, depth});
      } else {
        face(std::move(corners));
      }
    }
  }

  void grow_trunk() {
    Ids below;
    std::uint32_t last = k_none;
    for (std::uint32_t r = 0; r < shape_.rings; ++r) {
      const double up = static_cast<double>(r), radius = 1 - 0.8 * up / shape_.rings;
      Ids ring;
      for (std::uint32_t i = 0; i < shape_.sides; ++i) {
        const double a = 2 * std::numbers::pi * i / shape_.sides;
        ring.push_back(add({radius * std::cos(a) + 0.1 * std::sin(up), 1.3 * up + radius * draw(-0.02, 0.02),
                            -radius * std::sin(a) + 0.1 * std::cos(2 * up)}));
      }
      const std::uint32_t number =
          add_ring(ring, last == k_none ? std::vector<std::uint32_t>{} : std::vector{last});
      if (r > 0) band(below, ring, {last, number}, r == 1 ? 0 : shape_.depth);
      if (r == 0 && !shape_.open) face(Ids(ring.rbegin(), ring.rend()));
      below = std::move(ring);
      last = number;
    }
    if (!shape_.open) face(below);
  }

  void grow_limb(const Foot& foot) {
    Ids below = foot.corners;
    std::vector<std::uint32_t> parents = foot.parents;
    if (shape_.inset) {
      Ids ring;
      const Double3 c = centre_of(below);
      for (const std::uint32_t v : below) ring.push_back(add(c + (out_.mesh.positions[v] - c) * 0.7));
      band(below, ring, {}, 0);
      parents = {add_ring(ring, parents)};
      below = std::move(ring);
    }
    const Double3 seat = centre_of(below);
    std::vector<Double3> offsets;
    for (const std::uint32_t v : below) offsets.push_back(out_.mesh.positions[v] - seat);
    const Double3 out = normalized(cross(offsets[1] - offsets[0], offsets[2] - offsets[0]));
    const Double3 d = normalized(out + Double3{0, shape_.slant, 0});
    const double wide = length(offsets[0]), step = wide * draw(1.2, 2.5);
    const std::uint32_t rings = 2 + pick(4);
    for (std::uint32_t r = 0; r < rings; ++r) {
      const double size = (shape_.inset ? 1 : 0.8) * (1 - 0.6 * r / rings);
      const Double3 centre = seat + d * (step * (r + 1));
      Ids ring;
      for (const Double3& o : offsets) ring.push_back(add(centre + (o - d * dot(o, d)) * size));
      const std::uint32_t number = add_ring(ring, parents);
      std::vector<std::uint32_t> between = parents;
      between.push_back(number);
      band(below, ring, between, foot.depth - 1);
      parents = {number};
      below = std::move(ring);
    }
    if (!shape_.open) face(below);
  }

  BoxTree shape_;
  std::mt19937 random_;
  std::deque<Foot> feet_;
  BoxTreeMesh out_;
};

}  // namespace

BoxTreeMesh box_tree(const BoxTree& shape) {
  return Modeller(shape).run();
}

}  // namespace copse
