#include "lib/analysis/surface/winding.h"

#include "lib/analysis/surface/components.h"

#include <algorithm>
#include <cmath>

namespace copse {
namespace {

// Share of the volumes over all triangles that must be left for it to be more than rounding.
constexpr double k_least_volume = 1e-9;

// An edge as a triangle of a piece uses it.
struct EdgeUse {
  std::uint32_t low, high, piece, triangle;
  std::uint32_t forward;  // 1: the triangle goes from low to high
  friend auto operator<=>(const EdgeUse&, const EdgeUse&) = default;
};

// A border edge, as its triangle goes.
struct BorderEdge {
  std::uint32_t triangle, from, to;
};

class Winding {
 public:
  Winding(std::span<const Double3> positions, std::span<const Triangle> triangles,
          std::span<const std::uint32_t> piece)
      : positions_(positions),
        triangles_(triangles),
        same_(2 * triangles.size()),
        volume_(2 * triangles.size()) {
    join(piece);
  }

  std::vector<std::uint8_t> run() {
    const auto count = static_cast<std::uint32_t>(triangles_.size());
    for (std::uint32_t t = 0; t < count; ++t) {
      sheet_.push_back(std::min(same_.find(2 * t), same_.find(2 * t + 1)));
      is_against_.push_back(same_.find(2 * t) != sheet_[t]);
    }
    std::vector<std::int64_t> kept(2 * triangles_.size(), 0);
    for (std::uint32_t t = 0; t < count; ++t) {
      const auto& [a, b, c] = triangles_[t];
      add(t, positions_[a], positions_[b], positions_[c]);
      kept[sheet_[t]] += is_against_[t] ? -1 : 1;
    }
    close_borders();
    std::vector<std::uint8_t> turned(count);
    for (std::uint32_t t = 0; t < count; ++t) {
      const Volume& v = volume_[sheet_[t]];
      const bool inward = std::abs(v.sum) > k_least_volume * v.most ? v.sum < 0 : kept[sheet_[t]] < 0;
      turned[t] = is_against_[t] != inward;
    }
    return turned;
  }

 private:
  struct Volume {
    double sum = 0, most = 0;
  };

  // Wound as its sheet is; seen from the sheet's first corner.
  void add(std::uint32_t triangle, const Double3& a, const Double3& b, const Double3& c) {
    const Double3& from = positions_[triangles_[sheet_[triangle] / 2][0]];
    const double part = dot(a - from, cross(b - from, c - from));
    Volume& v = volume_[sheet_[triangle]];
    v.sum += is_against_[triangle] ? -part : part;
    v.most += std::abs(part);
  }

  // A triangle as it is (2 t) and turned (2 t + 1): sets of those that are wound alike.
  void join(std::span<const std::uint32_t> piece) {
    std::vector<EdgeUse> uses;
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      for (std::size_t e = 0; e < 3; ++e) {
        const std::uint32_t a = triangles_[t][e], b = triangles_[t][(e + 1) % 3];
        uses.push_back({std::min(a, b), std::max(a, b), piece[t], t, a < b});
      }
    }
    std::ranges::sort(uses);
    const auto is_same = [](const EdgeUse& a, const EdgeUse& b) {
      return a.low == b.low && a.high == b.high && a.piece == b.piece;
    };
    for (std::size_t i = 0, j = 0; i < uses.size(); i = j) {
      for (j = i + 1; j < uses.size() && is_same(uses[i], uses[j]);) ++j;
      if (j - i == 1) {
        const EdgeUse& u = uses[i];
        border_.push_back({u.triangle, u.forward ? u.low : u.high, u.forward ? u.high : u.low});
      }
      if (j - i != 2) continue;
      const std::uint32_t a = uses[i].triangle, b = uses[i + 1].triangle;
      const std::uint32_t against = uses[i].forward == uses[i + 1].forward ? 1 : 0;
      if (same_.find(2 * a) == same_.find(2 * b + 1 - against)) continue;  // no way to wind these alike
      same_.unite(2 * a, 2 * b + against);
      same_.unite(2 * a + 1, 2 * b + 1 - against);
    }
  }

  // Each border, edges of one sheet that hang together, gets a fan from its middle.
  void close_borders() {
    const auto points = static_cast<std::uint32_t>(positions_.size());
    UnionFind loops(points);
    for (const BorderEdge& e : border_) loops.unite(e.from, e.to);
    std::vector<Double3> middle(points);
    std::vector<double> corners(points, 0);
    for (const BorderEdge& e : border_) {
      const std::uint32_t loop = loops.find(e.from);
      middle[loop] += positions_[e.from] + positions_[e.to];
      corners[loop] += 2;
    }
    for (const BorderEdge& e : border_) {
      const std::uint32_t loop = loops.find(e.from);
      add(e.triangle, positions_[e.to], positions_[e.from], middle[loop] / corners[loop]);
    }
  }

  std::span<const Double3> positions_;
  std::span<const Triangle> triangles_;
  UnionFind same_;
  std::vector<Volume> volume_;  // one a set
  std::vector<BorderEdge> border_;
  std::vector<std::uint32_t> sheet_;      // one a triangle: the set of it, or of it turned, that comes first
  std::vector<std::uint8_t> is_against_;  // one a triangle: whether it is in the other one
};

}  // namespace

std::vector<std::uint8_t> turned_triangles(std::span<const Double3> positions,
                                           std::span<const Triangle> triangles,
                                           std::span<const std::uint32_t> piece) {
  return Winding(positions, triangles, piece).run();
}

}  // namespace copse
