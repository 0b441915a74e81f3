#include "lib/analysis/hull/quickhull.h"

#include "lib/analysis/hull/exact_sign.h"
#include "lib/analysis/hull/farthest.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <utility>

namespace copse {
namespace {

constexpr auto k_none = static_cast<std::uint32_t>(-1);

using Points = std::span<const Double3>;

// On which side of the plane through three points another lies: by doubles with a bound of their error, and
// where that leaves it open without rounding.
class Plane {
 public:
  Plane() = default;
  Plane(const Double3& a, const Double3& b, const Double3& c) : a_(a), b_(b), c_(c) {
    const Double3 u = b - a, v = c - a;
    normal_ = cross(u, v);
    sizes_ = {std::abs(u.y * v.z) + std::abs(u.z * v.y), std::abs(u.z * v.x) + std::abs(u.x * v.z),
              std::abs(u.x * v.y) + std::abs(u.y * v.x)};
  }
  // How far p lies above it, about, up to a factor of the plane's own.
  double height(const Double3& p) const { return dot(normal_, p - a_); }
  double length() const { return std::sqrt(dot(normal_, normal_)); }
  bool is_seen_from(const Double3& p) const { return side(p) > 0; }
  int side(const Double3& p) const {
    // Differences, products and sums are off by some eight roundings of the sizes of their terms.
    constexpr double k_roundings = 12 * 0x1p-53, k_underflow = 1e-300;
    const Double3 d = p - a_, size{std::abs(d.x), std::abs(d.y), std::abs(d.z)};
    const double height = dot(normal_, d), error = k_roundings * dot(sizes_, size) + k_underflow;
    if (std::abs(height) > error) return height > 0 ? 1 : -1;
    return exact_side(a_, b_, c_, p);
  }

 private:
  Double3 a_, b_, c_, normal_, sizes_;
};

struct Face {
  std::array<std::uint32_t, 3> corners{}, neighbours{};
  Plane plane;
  // Of the points that see it and no face that was asked before: a list through Quickhull::next_.
  std::uint32_t above = k_none, farthest = k_none;
  double height = -1;      // of the farthest
  std::uint32_t seen = 0;  // the last round in which the new point saw it
  std::uint32_t made = 0;  // the round in which it was made; k_none when it has gone
};

constexpr std::size_t k_look = 64;  // corners between looks at the clock

class Quickhull {
 public:
  explicit Quickhull(Points points) : points_(points), next_(points.size(), k_none) {}

  HullTriangles run(const QuickhullLimits& limits) {
    std::array<std::uint32_t, 4> first{};
    if (!find_tetrahedron(first)) return {};
    make_tetrahedron(first);
    for (std::size_t corners = 4; !open_.empty() && corners < limits.most; ++corners) {
      if (corners >= limits.least && (corners - limits.least) % k_look == 0 && limits.deadline.has_passed())
        break;
      const Open next = open_.top();
      open_.pop();
      if (faces_[next.face].made == next.made)
        add(next.face);
      else
        --corners;  // the face has gone
    }
    return triangles();
  }

 private:
  // A face with points above it.
  struct Open {
    double height;  // of the farthest, above the face's plane
    std::uint32_t face, made;
    bool operator<(const Open& other) const {
      return height != other.height ? height < other.height : face > other.face;
    }
  };

  template <class Measure>
  std::uint32_t farthest_by(Measure&& measure) const {
    return static_cast<std::uint32_t>(farthest(points_, measure));
  }

  // Four points that are far from one another and not in one plane.
  bool find_tetrahedron(std::array<std::uint32_t, 4>& t) const {
    if (points_.size() < 4) return false;
    t[0] = farthest_by([&](const Double3& p) { return length(p - points_[0]); });
    const Double3 a = points_[t[0]];
    t[1] = farthest_by([&](const Double3& p) { return length(p - a); });
    const Double3 b = points_[t[1]], along = normalized(b - a);
    t[2] = farthest_by([&](const Double3& p) { return length(cross(p - a, along)); });
    if (exactly_collinear(a, b, points_[t[2]])) {
      const auto off = [&](const Double3& p) { return !exactly_collinear(a, b, p); };
      t[2] = static_cast<std::uint32_t>(std::ranges::find_if(points_, off) - points_.begin());
      if (t[2] == points_.size()) return false;
    }
    const Plane plane(a, b, points_[t[2]]);
    t[3] = farthest_by([&](const Double3& p) { return std::abs(plane.height(p)); });
    if (plane.side(points_[t[3]]) == 0) {
      const auto off = [&](const Double3& p) { return plane.side(p) != 0; };
      t[3] = static_cast<std::uint32_t>(std::ranges::find_if(points_, off) - points_.begin());
      if (t[3] == points_.size()) return false;
    }
    if (plane.side(points_[t[3]]) > 0) std::swap(t[1], t[2]);
    return true;
  }

  // The last point is below the plane of the first three.
  void make_tetrahedron(const std::array<std::uint32_t, 4>& t) {
    // Of the face i, the face across the edge from its corner j.
    constexpr std::array<std::array<std::uint32_t, 3>, 4> k_corners{
        {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}},
        k_neighbours{{{1, 2, 3}, {3, 2, 0}, {1, 3, 0}, {2, 1, 0}}};
    for (std::size_t i = 0; i < 4; ++i) {
      const auto& c = k_corners[i];
      faces_[make_face(t[c[0]], t[c[1]], t[c[2]])].neighbours = k_neighbours[i];
    }
    made_ = {0, 1, 2, 3};
    for (std::uint32_t i = 0; i < points_.size(); ++i) give(i);
    open_made();
  }

  std::uint32_t make_face(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    std::uint32_t f = static_cast<std::uint32_t>(faces_.size());
    if (free_.empty()) {
      faces_.emplace_back();
    } else {
      f = free_.back(), free_.pop_back();
    }
    faces_[f] = {{a, b, c}, {}, Plane(points_[a], points_[b], points_[c])};
    faces_[f].made = round_;
    return f;
  }

  // To the first of the new faces that the point sees; what sees none is inside.
  void give(std::uint32_t point) {
    for (const std::uint32_t f : made_) {
      Face& face = faces_[f];
      if (!face.plane.is_seen_from(points_[point])) continue;
      next_[point] = face.above, face.above = point;
      const double height = face.plane.height(points_[point]);
      if (face.farthest == k_none || height > face.height || (height == face.height && point < face.farthest))
        face.height = height, face.farthest = point;
      return;
    }
  }

  void open_made() {
    for (const std::uint32_t f : made_) {
      const Face& face = faces_[f];
      if (face.above == k_none) continue;
      const double size = face.plane.length();
      open_.push({size > 0 ? face.height / size : 0, f, face.made});
    }
  }

  // The farthest point above a face becomes a corner.
  void add(std::uint32_t start) {
    const std::uint32_t apex = faces_[start].farthest;
    find_seen(start, points_[apex]);
    made_.clear();
    for (const auto& [f, side] : rim_) {
      const std::uint32_t from = faces_[f].corners[side], to = faces_[f].corners[(side + 1) % 3];
      const std::uint32_t beyond = faces_[f].neighbours[side], made = make_face(from, to, apex);
      faces_[made].neighbours[0] = beyond;
      Face& other = faces_[beyond];
      for (std::size_t i = 0; i < 3; ++i) {
        if (other.corners[i] == to && other.neighbours[i] == f) other.neighbours[i] = made;
      }
      made_from_[from] = made, made_.push_back(made);
    }
    for (const std::uint32_t made : made_) {  // the rim is one ring
      const std::uint32_t after = made_from_[faces_[made].corners[1]];
      faces_[made].neighbours[1] = after, faces_[after].neighbours[2] = made;
    }
    for (const std::uint32_t f : seen_) {
      for (std::uint32_t p = faces_[f].above; p != k_none;) {
        const std::uint32_t next = next_[p];
        if (p != apex) give(p);
        p = next;
      }
      faces_[f].made = k_none;
    }
    free_.insert(free_.end(), seen_.begin(), seen_.end());
    open_made();
  }

  // The faces that p sees, and the edges at which they end, each as a face and its side.
  void find_seen(std::uint32_t start, const Double3& p) {
    ++round_;
    seen_ = {start}, rim_.clear();
    faces_[start].seen = round_;
    for (std::size_t i = 0; i < seen_.size(); ++i) {
      for (std::uint32_t side = 0; side < 3; ++side) {
        const std::uint32_t f = faces_[seen_[i]].neighbours[side];
        if (faces_[f].seen == round_) continue;
        if (faces_[f].plane.is_seen_from(p)) {
          faces_[f].seen = round_, seen_.push_back(f);
        } else {
          rim_.emplace_back(seen_[i], side);
        }
      }
    }
  }

  HullTriangles triangles() const {
    std::vector<std::uint32_t> place(faces_.size(), k_none);
    HullTriangles out;
    for (std::uint32_t f = 0; f < faces_.size(); ++f) {
      if (faces_[f].made == k_none) continue;
      for (std::uint32_t p = faces_[f].above; p != k_none; p = next_[p]) out.outside.push_back(p);
      place[f] = static_cast<std::uint32_t>(out.faces.size());
      out.faces.push_back(faces_[f].corners), out.neighbours.push_back(faces_[f].neighbours);
    }
    for (auto& around : out.neighbours) {
      for (std::uint32_t& f : around) f = place[f];
    }
    std::ranges::sort(out.outside);
    return out;
  }

  Points points_;
  std::vector<std::uint32_t> next_;
  std::vector<Face> faces_;
  std::priority_queue<Open> open_;
  std::vector<std::uint32_t> free_, seen_, made_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> rim_;
  std::vector<std::uint32_t> made_from_ = std::vector<std::uint32_t>(points_.size());
  std::uint32_t round_ = 0;
};

}  // namespace

HullTriangles quickhull(std::span<const Double3> points, const QuickhullLimits& limits) {
  return Quickhull(points).run(limits);
}

}  // namespace copse
