#include "lib/analysis/swept/length_polytope.h"

#include <algorithm>
#include <bit>
#include <limits>

namespace copse {

LengthPolytope::LengthPolytope(Swept kind, const SweptLengths& most)
    : dimension_(kind == Swept::lozenge ? 3 : 2), size_(std::max({most.a, most.b, most.r})) {
  for (unsigned corner = 0; corner < 8; ++corner) {
    const bool b_high = corner >> 1 & 1;
    if (dimension_ == 2 && b_high) continue;
    Vertex v;
    v.at = {corner & 1 ? most.a : 0, b_high ? most.b : 0, corner >> 2 ? most.r : 0};
    for (int k = 0; k < 3; ++k) {
      // Where there is no b its planes are no planes, or two vertices would share one too many.
      if (k != 1 || dimension_ == 3) v.on |= std::uint64_t{1} << (2 * k + (corner >> k & 1));
    }
    vertices_.push_back(v);
  }
}

bool LengthPolytope::cut(double alpha, double beta, double gamma, double least) {
  if (planes_ == k_most_cuts + 6) return false;
  const std::uint64_t bit = std::uint64_t{1} << planes_++;
  // So that no vertex is dropped that only rounding has put below.
  least -= 8 * 0x1p-53 * (alpha + beta + gamma) * size_;
  std::vector<double> above;
  bool below = false;
  for (const Vertex& v : vertices_) {
    above.push_back(alpha * v.at.a + beta * v.at.b + gamma * v.at.r - least);
    below |= above.back() < 0;
  }
  if (!below) return true;
  std::vector<Vertex> kept;
  for (std::size_t i = 0; i < vertices_.size(); ++i) {
    if (above[i] < 0) continue;
    kept.push_back(vertices_[i]);
    if (above[i] == 0) kept.back().on |= bit;
  }
  for (std::size_t i = 0; i < vertices_.size(); ++i) {
    for (std::size_t j = 0; above[i] > 0 && j < vertices_.size(); ++j) {
      const std::uint64_t shared = vertices_[i].on & vertices_[j].on;
      if (above[j] >= 0 || std::popcount(shared) < dimension_ - 1) continue;
      const double t = above[i] / (above[i] - above[j]);
      const SweptLengths &p = vertices_[i].at, &q = vertices_[j].at;
      kept.push_back({{p.a + (q.a - p.a) * t, p.b + (q.b - p.b) * t, p.r + (q.r - p.r) * t}, shared | bit});
    }
  }
  vertices_ = std::move(kept);
  return true;
}

const LengthPolytope::Vertex& LengthPolytope::least_vertex() const {
  const Vertex* best = &vertices_.front();
  for (const Vertex& v : vertices_) {
    if (swept_volume(v.at) < swept_volume(best->at)) best = &v;
  }
  return *best;
}

SweptLengths LengthPolytope::least() const {
  return least_vertex().at;
}

double LengthPolytope::least_volume() const {
  if (empty()) return std::numeric_limits<double>::infinity();
  // A new vertex is off by at most four roundings of the size, and so is what later cuts make of it: within
  // `off` of every true vertex there is a found one. All coefficients of the volume are positive.
  const double off = 4 * planes_ * 0x1p-53 * size_;
  double least = std::numeric_limits<double>::infinity();
  for (const Vertex& v : vertices_) {
    const auto less = [&](double x) { return std::max(0.0, x - off); };
    least = std::min(least, swept_volume({less(v.at.a), less(v.at.b), less(v.at.r)}));
  }
  return least * (1 - 16 * 0x1p-53);
}

bool LengthPolytope::supports(int n) const {
  for (const Vertex& v : vertices_) {
    if (v.on >> (n + 6) & 1) return true;
  }
  return false;
}

bool LengthPolytope::supports_least(int n) const {
  return !empty() && (least_vertex().on >> (n + 6) & 1);
}

}  // namespace copse
