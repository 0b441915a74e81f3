#include "lib/analysis/lod/floating_leaves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include <tbb/parallel_for.h>

namespace copse {
namespace {

using Corners = std::array<Double3, 3>;

constexpr double k_visible_gap = 0.01;  // of the tree's height
// What was a metre away does not look otherwise a hand farther off: the shell of a crown that is one leaf.
constexpr double k_wider = 1.25;
constexpr double k_anywhere = std::numeric_limits<double>::infinity();

// Between the segments p q and a b, squared.
double segment_square(const Double3& p, const Double3& q, const Double3& a, const Double3& b) {
  const Double3 u = q - p, v = b - a, w = p - a;
  const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), uw = dot(u, w), vw = dot(v, w),
               d = uu * vv - uv * uv;
  double s = d > 1e-12 * uu * vv ? std::clamp((uv * vw - vv * uw) / d, 0.0, 1.0) : 0;
  const double t = vv > 0 ? std::clamp((s * uv + vw) / vv, 0.0, 1.0) : 0;
  s = uu > 0 ? std::clamp((t * uv - uw) / uu, 0.0, 1.0) : 0;
  const Double3 apart = p + u * s - (a + v * t);
  return dot(apart, apart);
}

template <class A, class B>
double box_square(const Box<A>& a, const Box<B>& b) {
  const auto apart = [](double a_min, double a_max, double b_min, double b_max) {
    return std::max(std::max(a_min - b_max, b_min - a_max), 0.0);
  };
  const Double3 d{apart(a.min.x, a.max.x, b.min.x, b.max.x), apart(a.min.y, a.max.y, b.min.y, b.max.y),
                  apart(a.min.z, a.max.z, b.min.z, b.max.z)};
  return dot(d, d);
}

struct Facet {
  explicit Facet(const Corners& corners)
      : at(corners),
        normal(cross(corners[1] - corners[0], corners[2] - corners[0])),
        size(dot(normal, normal)) {
    for (const Double3& p : corners) box.grow(p);
  }
  // Whether it is on the outer side of an edge, seen along the normal.
  bool beside(const Double3& p) const {
    for (std::size_t c = 0; c < 3; ++c)
      if (dot(normal, cross(at[(c + 1) % 3] - at[c], p - at[c])) < 0) return true;
    return false;
  }
  Corners at;
  Double3 normal;
  double size;  // of the normal, squared
  DoubleBox box;
};

// Whether the segment a b goes through the triangle.
bool pierces(const Facet& t, const Double3& a, const Double3& b) {
  const Double3 d = b - a;
  const double along = dot(t.normal, d), from = dot(t.normal, t.at[0] - a);
  return along != 0 && from / along >= 0 && from / along <= 1 && !t.beside(a + d * (from / along));
}

// Whether the triangle's plane alone keeps the other one farther away than the root of `reach`.
bool separates(const Facet& t, const Facet& other, double reach) {
  const double a = dot(t.normal, other.at[0] - t.at[0]), b = dot(t.normal, other.at[1] - t.at[0]),
               c = dot(t.normal, other.at[2] - t.at[0]);
  const double near = a > 0 ? std::min({a, b, c}) : -std::max({a, b, c});
  return near > 0 && near * near > reach * t.size;
}

// Between two triangles, squared; or anything above `reach` when it is; or something from there to `enough`,
// when that is less work.
double triangle_square(const Facet& t, const Facet& s, double reach, double enough) {
  if (separates(t, s, reach) || separates(s, t, reach)) return std::numeric_limits<double>::infinity();
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Double3 apart = t.at[c] - s.at[k];
      least = std::min(least, dot(apart, apart));
    }
  }
  if (least <= enough) return least;
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t k = 0; k < 3; ++k)
      least = std::min(least, segment_square(t.at[c], t.at[(c + 1) % 3], s.at[k], s.at[(k + 1) % 3]));
    if (least <= enough) return least;
  }
  const bool touching = box_square(t.box, s.box) == 0;
  // A corner over the other triangle's inside, if that is any nearer.
  const auto over = [&](const Facet& f, const Double3& p) {
    const double along = dot(f.normal, p - f.at[0]);
    if (along * along < least * f.size && !f.beside(p)) least = along * along / f.size;
  };
  for (std::size_t c = 0; c < 3; ++c) {
    const std::size_t next = (c + 1) % 3;
    if (touching && (pierces(t, s.at[c], s.at[next]) || pierces(s, t.at[c], t.at[next]))) return 0;
    over(t, s.at[c]), over(s, t.at[c]);
  }
  return least;
}

using StoredCorners = std::array<Float3, 3>;

StoredCorners corners_of(const Spectrum& s, std::uint32_t triangle) {
  StoredCorners out;
  for (std::size_t c = 0; c < 3; ++c) out[c] = s.vertices[s.triangles[triangle][c]].position;
  return out;
}

Corners exact(const StoredCorners& corners) {
  return {to_double(corners[0]), to_double(corners[1]), to_double(corners[2])};
}

// The triangles of one leaf.
struct Leaf {
  Leaf(const Spectrum& s, std::size_t element) {
    for (std::uint32_t t = s.first_triangle[element]; t < s.first_triangle[element + 1]; ++t) {
      facets.emplace_back(exact(corners_of(s, t)));
      box.grow(facets.back().box);
    }
  }
  // To the facet, squared; or anything above `reach`, or something up to `enough`.
  double square_to(const Facet& facet, double reach, double enough) const {
    double least = std::numeric_limits<double>::infinity();
    for (const Facet& own : facets) {
      const double within = std::min(reach, least);
      if (least > enough && box_square(own.box, facet.box) <= within)
        least = std::min(least, triangle_square(own, facet, within, enough));
    }
    return least;
  }
  std::vector<Facet> facets;
  DoubleBox box;
};

}  // namespace

// Triangles that a trunk has at some step, in a binary tree of boxes that also know when: node i's children
// are 2i + 1 and 2i + 2.
class FloatingLeaves::DrawnTrunk {
 public:
  // Those that are born by step `last`.
  DrawnTrunk(const Spectrum& trunk, std::uint32_t last) {
    for (std::size_t e = 0; e < trunk.elements.size(); ++e) {
      if (trunk.elements[e].birth > last) continue;
      for (std::uint32_t t = trunk.first_triangle[e]; t < trunk.first_triangle[e + 1]; ++t)
        pieces_.push_back({corners_of(trunk, t), trunk.elements[e].birth, trunk.elements[e].death});
    }
    std::size_t bottoms = 1;
    while (bottoms * k_bottom < pieces_.size()) bottoms *= 2;
    nodes_.resize(2 * bottoms - 1);
    nodes_[0].last = static_cast<std::uint32_t>(pieces_.size());
    for (std::size_t i = 0; i < nodes_.size(); ++i) build(i, i + 1 < bottoms);
  }

  // How far the leaf is from the nearest of all; of what is not nearer than `most` that.
  double gap(const Leaf& leaf, double most) const {
    double least = most * most;
    visit<false>(
        leaf, 0, [](const auto&) { return true; }, [&] { return least; },
        [&](const Piece&, double square) { return (least = square) > 0; });
    return std::sqrt(least);
  }

  // The step that takes away the last of what is within `allowed` and drawn after `steps` steps, or anything
  // of it that is drawn after `enough` steps too; nothing when nothing is within.
  std::optional<std::uint32_t> reached_until(const Leaf& leaf, double allowed, std::uint32_t steps,
                                             std::uint32_t enough) const {
    std::optional<std::uint32_t> until;
    visit<true>(
        leaf, allowed * allowed,
        [&](const auto& part) {
          return part.birth <= steps && part.death > steps && (!until || part.death > *until);
        },
        [&] { return allowed * allowed; },
        [&](const Piece& piece, double) { return (until = piece.death) <= enough; });
    return until;
  }

  bool reached(const Leaf& leaf, double allowed, std::uint32_t steps) const {
    bool found = false;
    visit<false>(
        leaf, allowed * allowed, [&](const auto& part) { return part.birth <= steps && part.death > steps; },
        [&] { return allowed * allowed; },
        [&](const Piece&, double) {
          found = true;
          return false;
        });
    return found;
  }

 private:
  static constexpr std::size_t k_bottom = 4;
  // Few bytes each, as a large trunk has millions: what a distance needs besides is found from the corners.
  struct Piece {
    FloatBox box() const {
      FloatBox out;
      for (const Float3& p : at) out.grow(p);
      return out;
    }
    StoredCorners at;
    std::uint32_t birth = 0, death = k_none;
  };
  struct Node {
    FloatBox box;
    std::uint32_t first = 0, last = 0;
    std::uint32_t birth = k_none, death = 0;  // the first and the last of what is in it
  };

  void build(std::size_t i, bool inner) {
    Node& node = nodes_[i];
    DoubleBox middles;
    for (std::uint32_t p = node.first; p < node.last; ++p) {
      const FloatBox box = pieces_[p].box();
      node.box.grow(box);
      middles.grow((to_double(box.min) + to_double(box.max)) * 0.5);
      node.birth = std::min(node.birth, pieces_[p].birth);
      node.death = std::max(node.death, pieces_[p].death);
    }
    if (!inner) return;
    const std::uint32_t half = node.first + (node.last - node.first) / 2;
    const Double3 extent = middles.empty() ? Double3{} : middles.extent();
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    const auto at = [&](std::uint32_t p) { return pieces_.begin() + static_cast<std::ptrdiff_t>(p); };
    const auto middle = [axis](const Piece& piece) {
      const float a = piece.at[0][axis], b = piece.at[1][axis], c = piece.at[2][axis];
      return double{std::min(std::min(a, b), c)} + double{std::max(std::max(a, b), c)};
    };
    std::nth_element(at(node.first), at(half), at(node.last),
                     [&](const Piece& a, const Piece& b) { return middle(a) < middle(b); });
    nodes_[2 * i + 1].first = node.first, nodes_[2 * i + 1].last = half;
    nodes_[2 * i + 2].first = half, nodes_[2 * i + 2].last = node.last;
  }

  // Calls found(piece, squared distance) for pieces that are wanted and within the square of reach(), which
  // may fall, until it says false: the nearest branches first, or those that last longest.
  template <bool Lasting, class Wanted, class Reach, class Found>
  void visit(const Leaf& leaf, double enough, Wanted wanted, Reach reach, Found found) const {
    std::array<std::uint32_t, 64> stack{};
    int depth = 0;
    const auto open = [&](std::uint32_t i) {
      const Node& node = nodes_[i];
      return node.first != node.last && wanted(node) && box_square(node.box, leaf.box) <= reach();
    };
    if (!pieces_.empty() && !leaf.facets.empty() && open(0)) stack[depth++] = 0;
    const Double3 middle = leaf.box.centre();
    const auto away = [&](std::uint32_t i) {
      const Double3 d = (to_double(nodes_[i].box.min) + to_double(nodes_[i].box.max)) * 0.5 - middle;
      return dot(d, d);
    };
    while (depth > 0) {
      const std::uint32_t i = stack[--depth];
      const Node& node = nodes_[i];
      if (2 * i + 2 >= nodes_.size()) {
        for (std::uint32_t p = node.first; p < node.last; ++p) {
          const Piece& piece = pieces_[p];
          if (!wanted(piece) || box_square(piece.box(), leaf.box) > reach()) continue;
          const double square = leaf.square_to(Facet(exact(piece.at)), reach(), enough);
          if (square <= reach() && !found(piece, square)) return;
        }
        continue;
      }
      const std::uint32_t l = 2 * i + 1, r = l + 1;
      const bool to_left = open(l), to_right = open(r);
      if (to_left && to_right) {
        const bool left = Lasting && nodes_[l].death != nodes_[r].death ? nodes_[l].death > nodes_[r].death
                                                                        : away(l) <= away(r);
        stack[depth++] = left ? r : l, stack[depth++] = left ? l : r;
      } else if (to_left || to_right) {
        stack[depth++] = to_left ? l : r;
      }
    }
  }

  std::vector<Piece> pieces_;
  std::vector<Node> nodes_;
};

FloatingLeaves::FloatingLeaves(const Tree& tree, const LodSpectra& spectra, std::uint32_t from)
    : spectra_(spectra), from_(from) {
  if (spectra.trunk.elements.empty()) return;
  full_ = std::make_unique<const DrawnTrunk>(spectra.trunk, 0);
  drawn_ = std::make_unique<const DrawnTrunk>(spectra.trunk, spectra.trunk.steps());
  known_.resize(spectra.leaves.elements.size());
  tolerance_ = k_visible_gap * tree.header.bounds.extent().y;
}

FloatingLeaves::~FloatingLeaves() = default;

std::uint64_t FloatingLeaves::count(const LodLevel& level) const {
  if (!drawn_) return 0;
  const auto& elements = spectra_.leaves.elements;
  std::vector<std::uint8_t> floats(elements.size(), 0);
  tbb::parallel_for(std::size_t{0}, floats.size(), [&](std::size_t e) {
    if (level.leaf_steps < elements[e].birth || level.leaf_steps >= elements[e].death) return;
    const Leaf leaf(spectra_.leaves, e);
    floats[e] =
        !drawn_->reached(leaf, tolerance_, level.trunk_steps) &&
        !drawn_->reached(leaf, k_wider * full_->gap(leaf, k_anywhere) + tolerance_, level.trunk_steps);
  });
  return static_cast<std::uint64_t>(std::count(floats.begin(), floats.end(), 1));
}

// Most leaves touch what bears them, or are borne by something else as near: how far they were at full detail
// is asked last.
bool FloatingLeaves::floats_by(std::uint32_t element, std::uint32_t trunk_steps) {
  if (!drawn_ || (from_ > 0 && trunk_steps <= from_)) return false;
  Known& known = known_[element];
  known.until = std::max(known.until, from_);
  if (known.until > trunk_steps || known.last) return known.until <= trunk_steps;
  const Leaf leaf(spectra_.leaves, element);
  while (known.until <= trunk_steps) {
    const double allowed = std::max(known.allowed, tolerance_);
    if (const auto until = drawn_->reached_until(leaf, allowed, known.until, trunk_steps)) {
      known.until = *until;
    } else if (known.allowed < 0) {
      known.allowed =
          k_wider * full_->gap(leaf, known.until > 0 && from_ == 0 ? tolerance_ : k_anywhere) + tolerance_;
    } else if (from_ > 0 && known.until == from_) {
      known.until = k_none;
    } else {
      known.last = true;
      return true;
    }
  }
  return false;
}

}  // namespace copse
