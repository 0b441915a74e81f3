#include "lib/analysis/rings/hull_frames.h"

#include "lib/analysis/surface/components.h"
#include "lib/analysis/surface/surface.h"
#include "lib/analysis/surface/welded_tolerances.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include <Eigen/SparseCholesky>

namespace copse {
namespace {

constexpr std::size_t k_ring_unknowns = 7, k_fork_unknowns = 3;

// A square: corners at centre + u, + v, - u, - v, with u across v and as long.
struct Square {
  Double3 centre, u{1, 0, 0}, v{0, 1, 0};  // unit directions
  double reach = 0;
  Double3 normal() const { return cross(u, v); }
  Double3 corner(std::size_t i) const {
    const Double3 to = (i % 2 == 0 ? u : v) * reach;
    return i < 2 ? centre + to : centre - to;
  }
};

// `x`, turned the shortest way that takes the unit vector `from` to the unit vector `to`.
Double3 turned(const Double3& x, const Double3& from, const Double3& to) {
  const Double3 axis = cross(from, to);
  const double cosine = dot(from, to);
  return x * cosine + cross(axis, x) + axis * (dot(axis, x) / std::max(1 + cosine, 1e-9));
}

// Something that is foretold, as three numbers of metres that ought to be zero.
struct Claim {
  enum class Kind : std::uint8_t { corner, bend, twist } kind;
  std::array<std::uint32_t, 3> nodes{k_none, k_none, k_none};
  std::array<std::uint8_t, 2> place{};  // of a corner: which it is of each node
  std::uint32_t vertex = k_none;
};

// The graph while it is looked into: without rings that are faces, and doubled corners as one.
struct Skin {
  std::span<const Double3> positions;
  std::vector<FrameGraph::Corners> corners;
  std::vector<std::uint8_t> is_regular, is_face;
  std::vector<std::uint32_t> uses;  // one a vertex: rings that have it
  std::vector<std::vector<std::uint32_t>> neighbours;

  std::uint32_t nodes() const { return static_cast<std::uint32_t>(corners.size()); }
  bool is_fork(std::uint32_t n) const { return corners[n][0] == k_none; }
  bool is_exact(std::uint32_t n) const {
    return is_regular[n] && std::ranges::all_of(corners[n], [&](std::uint32_t v) { return uses[v] == 1; });
  }
  bool is_unknown(std::uint32_t n) const {
    return n != k_none && !is_face[n] && (is_fork(n) || !is_exact(n));
  }
};

// Solves for the unknown ones among some nodes; the others stand fast.
class Solver {
 public:
  Solver(const Skin& skin, const std::vector<std::uint32_t>& members, std::vector<Square>& squares)
      : g_(skin), members_(members), squares_(squares) {
    for (const std::uint32_t n : members_) guess(n);
    for (const std::uint32_t n : members_) {
      if (!g_.is_fork(n)) continue;
      for (const std::uint32_t m : g_.neighbours[n])
        squares_[n].centre += squares_[m].centre / static_cast<double>(g_.neighbours[n].size());
    }
    make_claims();
  }

  // How far what is foretold round each member is off at most, over what is allowed; one a member.
  std::vector<double> run(const std::function<double(double)>& noise) {
    iterate();
    std::vector<double> off(members_.size(), 0);
    for (const Claim& c : claims_) {
      const double wrong = length(value(c)) / noise(size_near(c));
      for (const std::uint32_t n : c.nodes) {
        const auto at = std::ranges::lower_bound(members_, n);
        if (at != members_.end() && *at == n) {
          double& most = off[static_cast<std::size_t>(at - members_.begin())];
          most = std::max(most, wrong);
        }
      }
    }
    return off;
  }

 private:
  bool is_free(std::uint32_t n) const { return g_.is_unknown(n) && std::ranges::binary_search(members_, n); }

  void guess(std::uint32_t n) {
    Square& s = squares_[n] = {};
    if (g_.is_fork(n)) return;
    const auto at = [&](std::size_t i) { return g_.positions[g_.corners[n][i]]; };
    s.centre = (at(0) + at(1) + at(2) + at(3)) / 4.0;
    const Double3 a = at(0) - at(2), b = at(1) - at(3);
    const Double3 normal = normalized(cross(a, b), {0, 0, 1});
    const Double3 half = normalized(normalized(a, {}) + normalized(cross(b, normal), {}), {1, 0, 0});
    s.u = normalized(half - normal * dot(half, normal), {1, 0, 0});
    s.v = cross(normal, s.u);
    s.reach = (length(a) + length(b)) / 4;
  }

  void make_claims() {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> uses;  // (vertex, node and place)
    for (const std::uint32_t n : members_) {
      if (g_.is_fork(n)) continue;
      for (std::uint32_t i = 0; i < 4; ++i) uses.emplace_back(g_.corners[n][i], 4 * n + i);
    }
    std::ranges::sort(uses);
    for (std::size_t i = 0, end = 0; i < uses.size(); i = end) {
      while (end < uses.size() && uses[end].first == uses[i].first) ++end;
      if (end - i > 2) continue;
      Claim c{.kind = Claim::Kind::corner, .vertex = uses[i].first};
      for (std::size_t k = i; k < end; ++k) {
        c.nodes[k - i] = uses[k].second / 4;
        c.place[k - i] = static_cast<std::uint8_t>(uses[k].second % 4);
      }
      add(c);
    }
    for (const std::uint32_t n : members_) {
      if (g_.is_fork(n)) continue;
      const auto& around = g_.neighbours[n];
      if (around.size() == 1) add({.kind = Claim::Kind::bend, .nodes = {around[0], n, k_none}});
      if (around.size() == 2) add({.kind = Claim::Kind::bend, .nodes = {around[0], n, around[1]}});
      for (const std::uint32_t m : around) {
        if (n < m && !g_.is_fork(m)) add({.kind = Claim::Kind::twist, .nodes = {n, m, k_none}});
      }
    }
  }

  void add(const Claim& c) {
    const auto is_out = [&](std::uint32_t n) { return g_.is_unknown(n) && !is_free(n); };
    if (std::ranges::any_of(c.nodes, [&](std::uint32_t n) { return is_free(n); }) &&
        std::ranges::none_of(c.nodes, is_out))
      claims_.push_back(c);
  }

  Double3 value(const Claim& c) const {
    switch (c.kind) {
      case Claim::Kind::corner:
        return corner(c);
      case Claim::Kind::bend:
        return bend(c);
      case Claim::Kind::twist:
        return {twist(c), 0, 0};
    }
    return {};
  }

  Double3 corner(const Claim& c) const {
    Double3 at = squares_[c.nodes[0]].corner(c.place[0]);
    if (c.nodes[1] != k_none) at = (at + squares_[c.nodes[1]].corner(c.place[1])) / 2.0;
    return at - g_.positions[c.vertex];
  }

  Double3 bend(const Claim& c) const {
    const Square& s = squares_[c.nodes[1]];
    Double3 along = normalized(s.centre - squares_[c.nodes[0]].centre, {});
    if (c.nodes[2] != k_none)
      along = normalized(along + normalized(squares_[c.nodes[2]].centre - s.centre, {}), {});
    return cross(along, s.normal()) * s.reach;
  }

  // By a quarter turn a square is the same.
  double twist(const Claim& c) const {
    const Square &a = squares_[c.nodes[0]], &b = squares_[c.nodes[1]];
    const Double3 along = normalized(b.centre - a.centre, {0, 0, 1});
    const auto straight = [&](const Square& s) {
      const Double3 n = s.normal();
      return turned(s.u, dot(n, along) < 0 ? -n : n, along);
    };
    const Double3 x = straight(a), y = straight(b);
    return std::sin(4 * std::atan2(dot(cross(x, y), along), dot(x, y))) / 4 * std::min(a.reach, b.reach);
  }

  void move(std::uint32_t n, std::size_t unknown, double by) {
    Square& s = squares_[n];
    if (unknown < 3) {
      s.centre[static_cast<int>(unknown)] += by;
    } else if (unknown < 6) {
      Double3 axis;
      axis[static_cast<int>(unknown - 3)] = 1;
      turn(s, axis * (by / s.reach));
    } else {
      s.reach = std::max(s.reach + by, s.reach / 2);
    }
  }

  static void turn(Square& s, const Double3& by) {
    const double angle = length(by);
    if (!(angle > 0)) return;
    const Double3 axis = by / angle;
    const auto turn_one = [&](const Double3& x) {
      return x * std::cos(angle) + cross(axis, x) * std::sin(angle) +
             axis * (dot(axis, x) * (1 - std::cos(angle)));
    };
    s.u = normalized(turn_one(s.u));
    s.v = turn_one(s.v);
    s.v = normalized(s.v - s.u * dot(s.u, s.v));
  }

  std::size_t unknowns(std::uint32_t n) const {
    return !is_free(n) ? 0 : g_.is_fork(n) ? k_fork_unknowns : k_ring_unknowns;
  }

  double cost() const {
    double sum = 0;
    for (const Claim& c : claims_) {
      const Double3 x = value(c);
      sum += dot(x, x);
    }
    return sum;
  }

  void iterate() {
    std::vector<std::size_t> first{0};
    for (const std::uint32_t n : members_) first.push_back(first.back() + unknowns(n));
    const auto size = static_cast<Eigen::Index>(first.back());
    if (size == 0) return;
    double damping = k_frame_damping, best = cost();
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver;
    Eigen::SparseMatrix<double> jacobian(static_cast<Eigen::Index>(3 * claims_.size()), size),
        one(size, size);
    one.setIdentity();
    Eigen::VectorXd values(static_cast<Eigen::Index>(3 * claims_.size()));
    for (int round = 0; round < k_frame_rounds; ++round) {
      linearize(first, jacobian, values);
      const Eigen::SparseMatrix<double> square = jacobian.transpose() * jacobian;
      const Eigen::VectorXd down = -(jacobian.transpose() * values);
      const std::vector<Square> before = kept();
      bool better = false;
      while (!better && damping < 1 / k_frame_damping) {
        const Eigen::SparseMatrix<double> damped = square + one * damping;
        if (round == 0) solver.analyzePattern(damped);
        solver.factorize(damped);
        if (solver.info() != Eigen::Success) break;
        const Eigen::VectorXd step = solver.solve(down);
        for (std::size_t m = 0; m < members_.size(); ++m) {
          for (std::size_t i = 0; i < unknowns(members_[m]); ++i)
            move(members_[m], i, step[static_cast<Eigen::Index>(first[m] + i)]);
        }
        const double now = cost();
        better = now < best;
        if (better) {
          const bool done = best - now < k_frame_done * best;
          best = now;
          damping = std::max(damping / 4, k_frame_done * k_frame_damping);
          if (done) return;
        } else {
          for (std::size_t m = 0; m < members_.size(); ++m) squares_[members_[m]] = before[m];
          damping *= 4;
        }
      }
      if (!better) return;
    }
  }

  std::vector<Square> kept() const {
    std::vector<Square> out;
    for (const std::uint32_t n : members_) out.push_back(squares_[n]);
    return out;
  }

  void linearize(const std::vector<std::size_t>& first, Eigen::SparseMatrix<double>& jacobian,
                 Eigen::VectorXd& values) {
    std::vector<Eigen::Triplet<double>> entries;
    for (std::size_t k = 0; k < claims_.size(); ++k) {
      const Claim& c = claims_[k];
      const Double3 here = value(c);
      for (int i = 0; i < 3; ++i) values[static_cast<Eigen::Index>(3 * k) + i] = here[i];
      for (const std::uint32_t n : c.nodes) {
        if (!is_free(n)) continue;
        const Square kept = squares_[n];
        const double step = k_frame_difference * size_near(c);
        const auto at = static_cast<std::size_t>(std::ranges::lower_bound(members_, n) - members_.begin());
        for (std::size_t u = 0; u < unknowns(n); ++u) {
          move(n, u, step);
          const Double3 more = value(c);
          squares_[n] = kept;
          move(n, u, -step);
          const Double3 slope = (more - value(c)) / (2 * step);
          squares_[n] = kept;
          for (int i = 0; i < 3; ++i) {
            entries.emplace_back(static_cast<Eigen::Index>(3 * k) + i,
                                 static_cast<Eigen::Index>(first[at] + u), slope[i]);
          }
        }
      }
    }
    jacobian.setFromTriplets(entries.begin(), entries.end());
  }

  double size_near(const Claim& c) const {
    double size = std::numeric_limits<double>::infinity();
    for (const std::uint32_t n : c.nodes) {
      if (n != k_none && !g_.is_fork(n)) size = std::min(size, squares_[n].reach);
    }
    return size;
  }

  const Skin& g_;
  const std::vector<std::uint32_t>& members_;  // ascending
  std::vector<Square>& squares_;               // one a node
  std::vector<Claim> claims_;
};

class HullFrames {
 public:
  HullFrames(std::span<const Double3> positions, const FrameGraph& graph,
             const std::function<double(double)>& noise)
      : noise_(noise), squares_(graph.corners.size()), off_(graph.corners.size(), 0) {
    skin_.positions = positions;
    skin_.corners = graph.corners;
    skin_.is_regular = graph.is_regular;
    skin_.is_face.assign(skin_.nodes(), 0);
    for (std::uint32_t n = 0; n < skin_.nodes(); ++n)
      skin_.neighbours.emplace_back(graph.neighbours[n].begin(), graph.neighbours[n].end());
  }

  std::vector<Frame> run() {
    const auto rings = std::ranges::count_if(skin_.corners, [](const auto& c) { return c[0] != k_none; });
    if (2 * std::ranges::count(skin_.is_regular, 1) < rings) return std::vector<Frame>(skin_.nodes());
    UnionFind same(skin_.positions.size());
    for (std::uint32_t n = 0; n < skin_.nodes(); ++n) {
      if (skin_.is_fork(n)) join_doubled_corners(n, same);
    }
    for (std::uint32_t n = 0; n < skin_.nodes(); ++n) {
      if (skin_.is_fork(n)) continue;
      for (std::uint32_t& v : skin_.corners[n]) v = same.find(v);
    }
    count_uses();
    for (const std::vector<std::uint32_t>& cluster : clusters()) solve(cluster);
    for (std::uint32_t n = 0; n < skin_.nodes(); ++n) {
      if (skin_.is_fork(n) && !is_solved(n)) look_for_faces(n);
    }
    return result();
  }

 private:
  // The ring beyond a ring next to a fork; k_none where there is none.
  std::uint32_t beyond(std::uint32_t fork, std::uint32_t ring) const {
    const auto& around = skin_.neighbours[ring];
    if (skin_.is_fork(ring) || around.size() != 2) return k_none;
    const std::uint32_t next = around[0] == fork ? around[1] : around[0];
    return skin_.is_fork(next) ? k_none : next;
  }

  // A corner of a ring next to a fork, or of the one beyond.
  struct Point {
    std::uint32_t vertex, ring, first;  // `first`: the ring next to the fork; the same as `ring` or before it
  };

  // Corners of different rings that stand in one place are one. Where that is so of a limb's second ring, the
  // first is a face.
  void join_doubled_corners(std::uint32_t fork, UnionFind& same) {
    std::vector<Point> points;
    for (const std::uint32_t a : skin_.neighbours[fork]) {
      if (skin_.is_fork(a)) continue;
      for (const std::uint32_t v : skin_.corners[a]) points.push_back({v, a, a});
      const std::uint32_t b = beyond(fork, a);
      if (b == k_none) continue;
      for (const std::uint32_t v : skin_.corners[b]) points.push_back({v, b, a});
    }
    const auto at = [&](const Point& p) -> const Double3& { return skin_.positions[p.vertex]; };
    // Along a direction in which few things of a file line up.
    const auto along = [&](const Point& p) { return dot(at(p), normalized({0.62, 0.55, 0.56})); };
    std::ranges::sort(points, [&](const Point& p, const Point& q) {
      return std::tuple(along(p), p.vertex, p.ring) < std::tuple(along(q), q.vertex, q.ring);
    });
    std::vector<std::uint32_t> faces;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Point& p = points[i];
      for (std::size_t k = i + 1; k < points.size(); ++k) {
        const Point& q = points[k];
        const double allowed = noise_(std::min(size_of(p.ring), size_of(q.ring)));
        if (along(q) - along(p) > noise_(size_of(p.ring))) break;
        if (p.ring == q.ring || p.vertex == q.vertex || distance(at(p), at(q)) > allowed) continue;
        same.unite(p.vertex, q.vertex);
        for (const Point& r : {p, q}) {
          if (r.ring != r.first) faces.push_back(r.first);
        }
      }
    }
    std::ranges::sort(faces);
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    for (const std::uint32_t a : faces) leave_out(fork, a);
  }

  double size_of(std::uint32_t ring) const {
    const FrameGraph::Corners& c = skin_.corners[ring];
    return distance(skin_.positions[c[0]], skin_.positions[c[2]]) / 2;
  }

  void leave_out(std::uint32_t fork, std::uint32_t face) {
    const std::uint32_t next = beyond(fork, face);
    std::ranges::replace(skin_.neighbours[fork], face, next);
    std::ranges::replace(skin_.neighbours[next], face, fork);
    skin_.is_face[face] = 1;
    for (const std::uint32_t v : skin_.corners[face]) {
      if (!skin_.uses.empty()) --skin_.uses[v];
    }
  }
  void put_back(std::uint32_t fork, std::uint32_t face) {
    const auto& around = skin_.neighbours[face];
    const std::uint32_t next = around[0] == fork ? around[1] : around[0];
    std::ranges::replace(skin_.neighbours[fork], next, face);
    std::ranges::replace(skin_.neighbours[next], fork, face);
    skin_.is_face[face] = 0;
    for (const std::uint32_t v : skin_.corners[face]) ++skin_.uses[v];
  }

  void count_uses() {
    skin_.uses.assign(skin_.positions.size(), 0);
    for (std::uint32_t n = 0; n < skin_.nodes(); ++n) {
      if (skin_.is_fork(n) || skin_.is_face[n]) continue;
      for (const std::uint32_t v : skin_.corners[n]) ++skin_.uses[v];
    }
  }

  // The unknown nodes that hang together.
  std::vector<std::vector<std::uint32_t>> clusters() const {
    UnionFind sets(skin_.nodes());
    for (std::uint32_t n = 0; n < skin_.nodes(); ++n) {
      if (skin_.is_face[n]) continue;
      std::uint32_t first = skin_.is_unknown(n) ? n : k_none;
      for (const std::uint32_t m : skin_.neighbours[n]) {
        if (!skin_.is_unknown(m)) continue;
        if (first != k_none) sets.unite(first, m);
        first = m;
      }
    }
    std::vector<std::uint32_t> cluster_of(skin_.nodes(), k_none);
    std::vector<std::vector<std::uint32_t>> out;
    for (std::uint32_t n = 0; n < skin_.nodes(); ++n) {
      if (!skin_.is_unknown(n)) continue;
      std::uint32_t& c = cluster_of[sets.find(n)];
      if (c == k_none) c = static_cast<std::uint32_t>(out.size()), out.emplace_back();
      out[c].push_back(n);
    }
    return out;
  }

  // With the two rings beyond that stand fast.
  std::vector<std::uint32_t> with_rings_beside(std::vector<std::uint32_t> cluster) const {
    for (int step = 0; step < 2; ++step) {
      for (std::size_t i = 0, n = cluster.size(); i < n; ++i) {
        for (const std::uint32_t m : skin_.neighbours[cluster[i]]) cluster.push_back(m);
      }
      std::ranges::sort(cluster);
      cluster.erase(std::unique(cluster.begin(), cluster.end()), cluster.end());
    }
    std::erase_if(cluster, [&](std::uint32_t n) { return skin_.is_face[n]; });
    return cluster;
  }

  // Where not all comes out, each fork by itself, with what lies between it and the next ones.
  void solve(const std::vector<std::uint32_t>& cluster) {
    solve_together(cluster);
    if (std::ranges::count_if(cluster, [&](std::uint32_t n) { return skin_.is_fork(n); }) < 2) return;
    for (const std::uint32_t n : cluster) {
      if (skin_.is_fork(n) && !is_solved(n)) solve_together(rings_round(n));
    }
  }

  // Looks for the rings next to an unsolved fork without which it is solved.
  void look_for_faces(std::uint32_t fork) {
    const std::vector<std::uint32_t> limbs = skin_.neighbours[fork];
    if (limbs.size() > k_most_hung) return;
    for (const std::uint32_t face : limbs) {
      if (skin_.is_fork(face) || skin_.is_exact(face) || beyond(fork, face) == k_none) continue;
      leave_out(fork, face);
      solve_together(rings_round(fork));
      if (is_solved(fork)) return;
      put_back(fork, face);
    }
    solve_together(rings_round(fork));
  }

  std::vector<std::uint32_t> rings_round(std::uint32_t fork) const {
    std::vector<std::uint32_t> found{fork};
    for (const std::uint32_t first : skin_.neighbours[fork]) {
      for (std::uint32_t before = fork, n = first; skin_.is_unknown(n) && !skin_.is_fork(n);) {
        found.push_back(n);
        if (skin_.neighbours[n].size() != 2) break;
        before = std::exchange(n, skin_.neighbours[n][skin_.neighbours[n][0] == before ? 1 : 0]);
      }
    }
    return found;
  }

  bool is_solved(std::uint32_t fork) const {
    return off_[fork] <= 1 &&
           std::ranges::all_of(skin_.neighbours[fork], [&](std::uint32_t m) { return off_[m] <= 1; });
  }

  void solve_together(std::vector<std::uint32_t> unknown) {
    std::vector<std::uint32_t> members = with_rings_beside(unknown);
    std::ranges::sort(unknown);
    std::erase_if(members, [&](std::uint32_t n) {
      return skin_.is_unknown(n) && !std::ranges::binary_search(unknown, n);
    });
    const std::vector<double> off = Solver(skin_, members, squares_).run(noise_);
    for (std::size_t m = 0; m < members.size(); ++m) {
      if (skin_.is_unknown(members[m])) off_[members[m]] = off[m];
    }
  }

  std::vector<Frame> result() const {
    std::vector<Frame> frames;
    for (std::uint32_t n = 0; n < skin_.nodes(); ++n) {
      const Square& s = squares_[n];
      frames.push_back({s.centre, s.normal(), s.reach, false, skin_.is_face[n] != 0});
      if (!skin_.is_fork(n)) continue;
      frames.back().is_solved = is_solved(n);
    }
    return frames;
  }

  const std::function<double(double)>& noise_;
  Skin skin_;
  std::vector<Square> squares_;
  std::vector<double> off_;  // one a node: 0 where it is known
};

}  // namespace

std::vector<Frame> solve_hull_frames(std::span<const Double3> positions, const FrameGraph& graph,
                                     const std::function<double(double)>& noise) {
  return HullFrames(positions, graph, noise).run();
}

}  // namespace copse
