#include "lib/analysis/surface/reverse_subdivision.h"

#include "lib/analysis/surface/components.h"
#include "lib/analysis/surface/quads.h"
#include "lib/analysis/surface/welded_tolerances.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace copse {
namespace {

using Quad = std::array<std::uint32_t, 4>;

enum class Kind : std::uint8_t { vertex, edge, face };

// Colours vertices so that the pairs that are named differ.
class TwoColours {
 public:
  explicit TwoColours(std::size_t vertices) : sets_(2 * vertices) {}
  void differ(std::uint32_t a, std::uint32_t b) {
    sets_.unite(2 * a, 2 * b + 1);
    sets_.unite(2 * a + 1, 2 * b);
  }
  // 0 or 1, 0 for `first`; k_none where the pairs do not say, or say both.
  std::uint32_t operator()(std::uint32_t first, std::uint32_t v) {
    const std::uint32_t zero = sets_.find(2 * first), one = sets_.find(2 * first + 1),
                        mine = sets_.find(2 * v);
    if (zero == one) return k_none;
    return mine == zero ? 0 : mine == one ? 1 : k_none;
  }

 private:
  UnionFind sets_;
};

// What each vertex was made from, by connectivity. `swapped` picks the second of the two answers that are
// possible where all vertices are regular. Empty where there is none.
std::vector<Kind> kinds_of(const std::vector<Quad>& quads, std::size_t vertices, bool edges_first,
                           bool swapped) {
  TwoColours sides(vertices), corners(vertices);
  for (const Quad& q : quads) {
    for (std::size_t i = 0; i < 4; ++i) sides.differ(q[i], q[(i + 1) % 4]);
  }
  const std::uint32_t first = quads[0][0], edge_colour = edges_first ? 0 : 1;
  std::vector<Kind> kinds(vertices, Kind::edge);
  const std::size_t at = edges_first ? 1 : 0;
  const std::uint32_t first_corner = quads[0][at];
  for (const Quad& q : quads) {
    std::array<std::uint32_t, 4> colour{};
    for (std::size_t i = 0; i < 4; ++i) colour[i] = sides(first, q[i]);
    if (colour[0] == k_none || colour[1] == k_none) return {};
    const std::size_t corner = colour[0] == edge_colour ? 1 : 0;
    corners.differ(q[corner], q[corner + 2]);
  }
  for (const Quad& q : quads) {
    for (const std::uint32_t v : q) {
      if (sides(first, v) == edge_colour) continue;
      const std::uint32_t colour = corners(first_corner, v);
      if (colour == k_none) return {};
      kinds[v] = (colour == 0) == swapped ? Kind::face : Kind::vertex;
    }
  }
  return kinds;
}

// One step of a subdivision, taken apart. All ids are those of the subdivided surface's vertices.
struct Step {
  std::vector<std::uint32_t> vertices, edges, faces;  // by what they were made from
  Lists corners, sides;                               // one a face: side i lies between corners i and i + 1
  std::vector<std::array<std::uint32_t, 2>> ends;     // one a vertex of the surface; of edge points
  std::vector<std::uint32_t> faces_at;        // one a vertex of the surface: of vertices and edge points
  std::vector<std::uint32_t> edges_at;        // of vertices
  std::vector<std::uint32_t> sharp_edges_at;  // of vertices
  std::vector<std::uint8_t> is_corner;        // of vertices: whether they stay where they are
  std::vector<std::uint8_t> is_straight;      // of edge points: whether they do, between such vertices

  bool is_sharp(std::uint32_t edge) const { return faces_at[edge] != 2 || is_straight[edge]; }
};

// A quad as seen from its face point: the edge points beside it, the vertex opposite.
struct Wedge {
  std::uint32_t from, vertex, to;
};

// The wedges round a face point, turned and ordered so that each begins where the one before ends. False
// where they do not go round once.
bool go_round(std::vector<Wedge>& wedges) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> at;  // (edge point, wedge)
  for (std::uint32_t w = 0; w < wedges.size(); ++w)
    at.emplace_back(wedges[w].from, w), at.emplace_back(wedges[w].to, w);
  std::ranges::sort(at);
  for (std::size_t i = 0; i < at.size(); i += 2) {
    if (at[i].first != at[i + 1].first || (i + 2 < at.size() && at[i].first == at[i + 2].first)) return false;
  }
  std::vector<Wedge> round{wedges[0]};
  for (std::uint32_t w = 0; round.size() < wedges.size();) {
    const auto here = std::ranges::lower_bound(at, std::pair(round.back().to, 0u));
    w = here->second == w ? (here + 1)->second : here->second;
    if (w == 0) return false;
    const Wedge& next = wedges[w];
    const bool forward = next.from == round.back().to;
    round.push_back(forward ? next : Wedge{next.to, next.vertex, next.from});
  }
  wedges = std::move(round);
  return wedges.size() >= 3 && wedges.back().to == wedges.front().from;
}

bool read_faces(const std::vector<Quad>& quads, const std::vector<Kind>& kinds, Step& step) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;  // (face point, quad)
  for (std::uint32_t q = 0; q < quads.size(); ++q) {
    for (const std::uint32_t v : quads[q]) {
      if (kinds[v] == Kind::face) pairs.emplace_back(v, q);
    }
  }
  if (pairs.size() != quads.size()) return false;
  const Lists quads_of = make_lists(pairs, kinds.size());
  std::vector<Wedge> wedges;
  for (std::uint32_t f = 0; f < kinds.size(); ++f) {
    if (quads_of[f].empty()) continue;
    wedges.clear();
    for (const std::uint32_t q : quads_of[f]) {
      const auto at = static_cast<std::size_t>(std::ranges::find(quads[q], f) - quads[q].begin());
      wedges.push_back({quads[q][(at + 1) % 4], quads[q][(at + 2) % 4], quads[q][(at + 3) % 4]});
    }
    if (!go_round(wedges)) return false;
    step.faces.push_back(f);
    for (const Wedge& w : wedges) step.corners.items.push_back(w.vertex), step.sides.items.push_back(w.to);
    step.corners.first.push_back(static_cast<std::uint32_t>(step.corners.items.size()));
    step.sides.first.push_back(static_cast<std::uint32_t>(step.sides.items.size()));
  }
  return true;
}

// Whether each edge point has two ends, the same in every face.
bool read_edges(const std::vector<Kind>& kinds, Step& step) {
  step.ends.assign(kinds.size(), {k_none, k_none});
  step.faces_at.assign(kinds.size(), 0);
  step.edges_at.assign(kinds.size(), 0);
  step.sharp_edges_at.assign(kinds.size(), 0);
  step.is_corner.assign(kinds.size(), 0);
  step.is_straight.assign(kinds.size(), 0);
  for (std::size_t f = 0; f < step.faces.size(); ++f) {
    const auto corners = step.corners[f], sides = step.sides[f];
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const std::uint32_t a = corners[i], b = corners[(i + 1) % corners.size()], e = sides[i];
      const std::array<std::uint32_t, 2> ends{std::min(a, b), std::max(a, b)};
      if (a == b || (step.ends[e][0] != k_none && step.ends[e] != ends)) return false;
      step.ends[e] = ends;
      ++step.faces_at[e];
      ++step.faces_at[a];
    }
  }
  for (std::uint32_t v = 0; v < kinds.size(); ++v) {
    if (step.faces_at[v] == 0) continue;
    if (kinds[v] == Kind::vertex) step.vertices.push_back(v);
    if (kinds[v] != Kind::edge) continue;
    step.edges.push_back(v);
    for (const std::uint32_t end : step.ends[v]) {
      ++step.edges_at[end];
      step.sharp_edges_at[end] += step.is_sharp(v);
    }
  }
  return true;
}

std::optional<Step> read_step(const std::vector<Quad>& quads, std::size_t vertices, bool edges_first,
                              bool swapped) {
  const std::vector<Kind> kinds = kinds_of(quads, vertices, edges_first, swapped);
  Step step;
  if (kinds.empty() || !read_faces(quads, kinds, step) || !read_edges(kinds, step)) return std::nullopt;
  return step;
}

// Subdivides positions of the cage's vertices; optionally pushes them to the limit surface.
class Forward {
 public:
  Forward(const Step& step, std::size_t vertices) : step_(step), faces_(vertices), edges_(vertices) {}

  // One step: `cage` holds positions at the step's vertices, `out` gets them everywhere.
  void subdivide(const std::vector<Double3>& cage, std::vector<Double3>& out) {
    clear();
    for (std::size_t f = 0; f < step_.faces.size(); ++f) {
      const auto corners = step_.corners[f], sides = step_.sides[f];
      Double3 sum;
      for (const std::uint32_t v : corners) sum += cage[v];
      const Double3 point = sum / static_cast<double>(corners.size());
      out[step_.faces[f]] = point;
      for (const std::uint32_t v : corners) faces_[v] += point;
      for (const std::uint32_t e : sides) faces_[e] += point;
    }
    for (const std::uint32_t e : step_.edges) {
      const auto [a, b] = step_.ends[e];
      const Double3 ends = cage[a] + cage[b];
      out[e] = step_.is_sharp(e) ? ends / 2.0 : (ends + faces_[e]) / 4.0;
      for (const std::uint32_t v : {a, b}) {
        if (counts_at(v, e)) edges_[v] += ends / 2.0;
      }
    }
    for (const std::uint32_t v : step_.vertices) {
      const double n = step_.edges_at[v];
      if (is_smooth(v)) {
        out[v] =
            (faces_[v] / static_cast<double>(step_.faces_at[v]) + edges_[v] * (2 / n) + cage[v] * (n - 3)) /
            n;
      } else {
        out[v] = is_on_crease(v) ? cage[v] / 2.0 + edges_[v] / 4.0 : cage[v];
      }
    }
  }

  // The limit of the vertices that `from` has after one step; at edge points and face points too if asked.
  void push(const std::vector<Double3>& from, std::vector<Double3>& out, bool everywhere) {
    clear();
    for (std::size_t f = 0; f < step_.faces.size(); ++f) {
      for (const std::uint32_t v : step_.corners[f]) faces_[v] += from[step_.faces[f]];
    }
    for (const std::uint32_t e : step_.edges) {
      for (const std::uint32_t v : step_.ends[e]) {
        if (counts_at(v, e)) edges_[v] += from[e];
      }
    }
    for (const std::uint32_t v : step_.vertices) {
      const double n = step_.edges_at[v];
      if (is_smooth(v)) {
        out[v] = (from[v] * n + edges_[v] * (4 / n) + faces_[v] / static_cast<double>(step_.faces_at[v])) /
                 (n + 5);
      } else {
        out[v] = is_on_crease(v) ? from[v] * (4.0 / 6) + edges_[v] / 6.0 : from[v];
      }
    }
    if (everywhere) push_points(from, out);
  }

 private:
  void clear() {
    std::ranges::fill(faces_, Double3{});
    std::ranges::fill(edges_, Double3{});
  }
  bool is_smooth(std::uint32_t v) const { return !step_.is_corner[v] && step_.sharp_edges_at[v] < 2; }
  bool is_on_crease(std::uint32_t v) const { return !step_.is_corner[v] && step_.sharp_edges_at[v] == 2; }
  // Along a crease the edges beside it do not matter.
  bool counts_at(std::uint32_t v, std::uint32_t edge) const { return is_smooth(v) || step_.is_sharp(edge); }

  void push_points(const std::vector<Double3>& from, std::vector<Double3>& out) {
    for (const std::uint32_t e : step_.edges) edges_[e] = {}, faces_[e] = {};
    for (std::size_t f = 0; f < step_.faces.size(); ++f) {
      const auto corners = step_.corners[f], sides = step_.sides[f];
      const std::size_t n = corners.size();
      Double3 corner_sum, side_sum;
      for (std::size_t i = 0; i < n; ++i) {
        corner_sum += from[corners[i]], side_sum += from[sides[i]];
        faces_[sides[i]] += from[step_.faces[f]];
        edges_[sides[i]] += from[sides[(i + 1) % n]] + from[sides[(i + n - 1) % n]];
      }
      const auto count = static_cast<double>(n);
      out[step_.faces[f]] =
          (from[step_.faces[f]] * count + side_sum * (4 / count) + corner_sum / count) / (count + 5);
    }
    for (const std::uint32_t e : step_.edges) {
      const Double3 ends = from[step_.ends[e][0]] + from[step_.ends[e][1]];
      out[e] = step_.is_sharp(e) ? (from[e] * 4.0 + ends) / 6.0
                                 : (from[e] * 16.0 + (ends + faces_[e]) * 4.0 + edges_[e]) / 36.0;
    }
  }

  const Step& step_;
  std::vector<Double3> faces_, edges_;  // sums
};

double diagonal(const std::vector<Double3>& positions) {
  DoubleBox box;
  for (const Double3& p : positions) box.grow(p);
  return length(box.extent());
}

// How far off a share of the edge points and face points is at most, and that over the length of an edge.
struct Misfit {
  double off = 0, share = 0;
};

Misfit misfit_of(const Step& step, const std::vector<Double3>& target, const std::vector<Double3>& made,
                 double of_points) {
  std::vector<double> off, share;
  for (std::size_t f = 0; f < step.faces.size(); ++f) {
    const std::uint32_t p = step.faces[f];
    double edge = 0;
    for (const std::uint32_t e : step.sides[f]) edge += distance(target[e], target[p]);
    edge /= static_cast<double>(step.sides[f].size());
    for (const std::uint32_t v : {p, step.sides[f][0]}) {
      off.push_back(distance(target[v], made[v]));
      share.push_back(edge > 0 ? off.back() / edge : 1);
    }
  }
  const auto most = static_cast<std::ptrdiff_t>(of_points * static_cast<double>(off.size() - 1));
  std::ranges::nth_element(off, off.begin() + most);
  std::ranges::nth_element(share, share.begin() + most);
  return {off[static_cast<std::size_t>(most)], share[static_cast<std::size_t>(most)]};
}

// The cage's positions whose subdivision has its vertices where `target` has them, and what that subdivision
// is everywhere. Chebyshev iteration on the eigenvalues from `least` to 1.
class Solver {
 public:
  Solver(const Step& step, const std::vector<Double3>& target, bool on_limit)
      : step_(step),
        target_(target),
        on_limit_(on_limit),
        forward_(step, target.size()),
        cage_(target),
        stepped_(target.size()),
        made_(target.size()) {}

  bool run() {
    const double least = on_limit_ ? k_least_limit_eigenvalue : k_least_step_eigenvalue;
    const double centre = (1 + least) / 2, half = (1 - least) / 2;
    const double small = k_solved_share * diagonal(target_);
    std::vector<Double3> change(target_.size());
    double rho = half / centre;
    for (int round = 0; round < k_solver_rounds; ++round) {
      make(false);
      const double next = round == 0 ? rho : 1 / (2 * centre / half - rho);
      double worst = 0;
      for (const std::uint32_t v : step_.vertices) {
        const Double3 off = target_[v] - made_[v];
        worst = std::max(worst, std::max({std::abs(off.x), std::abs(off.y), std::abs(off.z)}));
        change[v] = round == 0 ? off / centre : change[v] * (next * rho) + off * (2 * next / half);
        cage_[v] += change[v];
      }
      rho = next;
      if (!std::isfinite(worst)) return false;
      if (worst <= small) {
        make(true);
        return true;
      }
      if (round == k_judged_round && !looks_foretold()) return false;
    }
    return false;
  }

  std::vector<Double3>& cage() { return cage_; }
  void take(Solver& other) {
    cage_.swap(other.cage_), stepped_.swap(other.stepped_), made_.swap(other.made_);
  }
  // How far an edge point or face point is from where it should be.
  double off(std::uint32_t point) const { return distance(target_[point], made()[point]); }
  // How far off this share of the rest is, once run() has succeeded; nothing where that is too far for
  // rounding.
  std::optional<double> precision(double of_points) const {
    const Misfit misfit = misfit_of(step_, target_, made(), of_points);
    const bool fits =
        misfit.off <= k_foretold_of_diagonal * diagonal(target_) && misfit.share <= k_foretold_of_edge;
    return fits ? std::optional(misfit.off) : std::nullopt;
  }

 private:
  const std::vector<Double3>& made() const { return on_limit_ ? made_ : stepped_; }

  // Whether the rest may turn out to be where it should, by a cage that is not yet exact.
  bool looks_foretold() {
    make(true);
    return misfit_of(step_, target_, made(), k_first_share).share <= k_judged_slack * k_foretold_of_edge;
  }

  void make(bool everywhere) {
    forward_.subdivide(cage_, stepped_);
    if (on_limit_) {
      forward_.push(stepped_, made_, everywhere);
    } else if (!everywhere) {
      for (const std::uint32_t v : step_.vertices) made_[v] = stepped_[v];
    }
  }

  const Step& step_;
  const std::vector<Double3>& target_;
  bool on_limit_;
  Forward forward_;
  std::vector<Double3> cage_, stepped_, made_;
};

// A surface of quads and what it has come from so far.
struct Level {
  std::vector<Quad> quads;
  std::vector<Double3> positions;
};

struct Undone {
  Step step;
  std::vector<Double3> cage;
  double precision = 0;
};

// The vertices of the cage that were kept where they are, and the edges between them that were kept straight,
// as modelling programs do beside faces within the surface, which they then leave out: the mesh does not tell
// which, but where one of them is taken for smooth, all points beside it are off, and what is true of it
// makes them exact.
class Corners {
 public:
  Corners(Step& step, const std::vector<Double3>& target, bool on_limit, double precision)
      : step_(step),
        target_(target),
        on_limit_(on_limit),
        allowed_(k_corner_off * std::max(precision, k_solved_share * diagonal(target))) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> points, faces;
    for (std::uint32_t f = 0; f < step.faces.size(); ++f) {
      for (const std::uint32_t v : step.corners[f])
        points.emplace_back(v, step.faces[f]), faces.emplace_back(v, f);
    }
    for (const std::uint32_t e : step.edges) {
      for (const std::uint32_t v : step.ends[e]) points.emplace_back(v, e);
    }
    points_at_ = make_lists(points, target.size());
    faces_at_ = make_lists(faces, target.size());
  }

  // Marks corners in the step for as long as that helps; the cage is then the solver's.
  void find(Solver& solver) {
    measure(solver);
    for (int round = 0; round < k_corner_rounds; ++round) {
      const std::vector<std::uint32_t> doubtful = doubtful_vertices();
      if (doubtful.empty()) return;
      mark(doubtful, 1);
      const std::vector<double> before = off_;
      if (!solve_again(solver)) return mark(doubtful, 0);
      std::vector<std::uint32_t> wrong = doubtful;
      std::erase_if(wrong, [&](std::uint32_t v) { return off_[v] < before[v] / 2; });
      if (wrong.empty()) continue;
      mark(wrong, 0);
      if (!solve_again(solver) || wrong.size() == doubtful.size()) return;
    }
  }

 private:
  // Between two corners an edge is straight where its point is in their middle.
  void mark(std::span<const std::uint32_t> vertices, std::uint8_t corner) {
    for (const std::uint32_t v : vertices) step_.is_corner[v] = corner;
    for (const std::uint32_t e : step_.edges) {
      const auto [a, b] = step_.ends[e];
      step_.is_straight[e] = step_.is_corner[a] && step_.is_corner[b] &&
                             distance(target_[e], (target_[a] + target_[b]) / 2.0) <= allowed_;
    }
  }
  bool solve_again(Solver& solver) {
    Solver again(step_, target_, on_limit_);
    if (!again.run()) return false;
    measure(again);
    solver.take(again);
    return true;
  }

  // How far the points beside each vertex are off, in the mean; nothing where one of them is not.
  void measure(const Solver& solver) {
    off_.assign(target_.size(), 0);
    for (const std::uint32_t v : step_.vertices) {
      double sum = 0, least = std::numeric_limits<double>::infinity();
      for (const std::uint32_t p : points_at_[v])
        sum += solver.off(p), least = std::min(least, solver.off(p));
      off_[v] = least > allowed_ ? sum / static_cast<double>(points_at_[v].size()) : 0;
    }
  }

  // The vertices with all points off, and not because of a neighbour.
  std::vector<std::uint32_t> doubtful_vertices() const {
    std::vector<std::uint32_t> doubtful;
    for (const std::uint32_t v : step_.vertices) {
      if (step_.is_corner[v] || off_[v] == 0) continue;
      double most = 0;
      for (const std::uint32_t f : faces_at_[v]) {
        for (const std::uint32_t n : step_.corners[f]) most = std::max(most, off_[n]);
      }
      if (off_[v] >= k_corner_share * most) doubtful.push_back(v);
    }
    return doubtful;
  }

  Step& step_;
  const std::vector<Double3>& target_;
  bool on_limit_;
  double allowed_;
  Lists points_at_, faces_at_;  // one a vertex
  std::vector<double> off_;
};

std::optional<Undone> undo(const Level& level, bool on_limit) {
  for (const bool edges_first : {true, false}) {
    for (const bool swapped : {false, true}) {
      auto step = read_step(level.quads, level.positions.size(), edges_first, swapped);
      if (!step) continue;
      Solver solver(*step, level.positions, on_limit);
      if (!solver.run()) continue;
      const std::optional<double> first = solver.precision(k_first_share);
      if (!first) continue;
      Corners(*step, level.positions, on_limit, *first).find(solver);
      if (const std::optional<double> precision = solver.precision(k_foretold_share))
        return Undone{std::move(*step), std::move(solver.cage()), *precision};
    }
  }
  return std::nullopt;
}

// The corner of each triangle that the other one does not have; none where they are no quad.
std::optional<std::array<std::uint32_t, 2>> tips_of(const Triangle& a, const Triangle& b) {
  const auto other = [](const Triangle& t, const Triangle& u) {
    std::uint32_t tip = k_none, tips = 0;
    for (const std::uint32_t v : t) {
      if (std::ranges::find(u, v) == u.end()) tip = v, ++tips;
    }
    return tips == 1 ? tip : k_none;
  };
  const std::uint32_t p = other(a, b), q = other(b, a);
  if (p == k_none || q == k_none) return std::nullopt;
  return std::array{p, q};
}

// The quads of the surface and the quad of each triangle; none where a triangle is in no quad.
std::vector<Quad> quads_of(const Surface& s, std::vector<std::uint32_t>& quad_of) {
  const std::vector<std::uint32_t> partner = pair_all_quads(s);
  std::vector<Quad> quads;
  quad_of.assign(partner.size(), k_none);
  for (std::uint32_t t = 0; t < partner.size(); ++t) {
    if (partner[t] < t) continue;
    const Triangle& triangle = s.triangles[t];
    const auto tips = tips_of(triangle, s.triangles[partner[t]]);
    if (!tips) return {};
    const auto at = static_cast<std::size_t>(std::ranges::find(triangle, (*tips)[0]) - triangle.begin());
    quad_of[t] = quad_of[partner[t]] = static_cast<std::uint32_t>(quads.size());
    quads.push_back({triangle[at], triangle[(at + 1) % 3], (*tips)[1], triangle[(at + 2) % 3]});
  }
  return quads;
}

// What one step was made from, with vertices of its own; `vertex_of` gets the id that each had before.
Lists renumbered(const Undone& undone, std::vector<Double3>& positions, std::vector<std::uint32_t>& vertex) {
  std::vector<std::uint32_t> id(undone.cage.size(), k_none);
  std::vector<Double3> kept;
  std::vector<std::uint32_t> kept_vertex;
  for (const std::uint32_t v : undone.step.vertices) {
    id[v] = static_cast<std::uint32_t>(kept.size());
    kept.push_back(undone.cage[v]);
    kept_vertex.push_back(vertex[v]);
  }
  Lists faces = undone.step.corners;
  for (std::uint32_t& v : faces.items) v = id[v];
  positions = std::move(kept);
  vertex = std::move(kept_vertex);
  return faces;
}

bool all_quads(const Lists& faces, std::vector<Quad>& quads) {
  quads.clear();
  for (std::size_t f = 0; f < faces.count(); ++f) {
    if (faces[f].size() != 4) return false;
    quads.push_back({faces[f][0], faces[f][1], faces[f][2], faces[f][3]});
  }
  return true;
}

}  // namespace

std::optional<Cage> reverse_subdivision(const Surface& surface) {
  if (surface.triangles.size() < k_least_subdivided) return std::nullopt;
  Cage cage;
  Level level{quads_of(surface, cage.face_of), {}};
  if (level.quads.empty()) return std::nullopt;
  level.positions = surface.positions;
  // Near the origin: the iteration's last digits would be lost to an offset.
  const Double3 origin = level.positions[0];
  for (Double3& p : level.positions) p -= origin;
  for (std::uint32_t v = 0; v < level.positions.size(); ++v) cage.vertex.push_back(v);
  do {
    auto undone = undo(level, false);
    if (!undone && cage.levels == 0) {
      undone = undo(level, true);
      cage.is_on_limit = undone.has_value();
    }
    if (!undone) break;
    ++cage.levels;
    cage.precision = std::max(cage.precision, undone->precision);
    // The quads of one face go with it.
    std::vector<std::uint32_t> face_at(level.positions.size(), k_none);
    for (std::uint32_t f = 0; f < undone->step.faces.size(); ++f) face_at[undone->step.faces[f]] = f;
    std::vector<std::uint32_t> face_of_quad;
    for (const Quad& q : level.quads) {
      std::uint32_t face = k_none;
      for (const std::uint32_t v : q) face = std::min(face, face_at[v]);
      face_of_quad.push_back(face);
    }
    for (std::uint32_t& f : cage.face_of) f = face_of_quad[f];
    cage.faces = renumbered(*undone, level.positions, cage.vertex);
  } while (all_quads(cage.faces, level.quads) && 2 * level.quads.size() >= k_least_subdivided);
  if (cage.levels == 0) return std::nullopt;
  for (Double3& p : level.positions) p += origin;
  cage.positions = std::move(level.positions);
  return cage;
}

}  // namespace copse
