#include "lib/analysis/swept/swept_barrier.h"

#include <algorithm>
#include <limits>

namespace copse {
namespace {

constexpr double k_infinity = std::numeric_limits<double>::infinity();

// The unknowns of which points know: the turn (rotation vector, twice the Cayley vector) and the rectangle.
enum Unknown { turn_x, turn_y, turn_z, at_a0, at_a1, at_b0, at_b1, at_h, at_r, k_unknowns };
constexpr int k_most_free = 9;

constexpr double k_gap_factor = 0.1;         // from one centre to the next
constexpr int k_steps_a_centre = 12;         // more mean that rounding rules
constexpr double k_centred = 1e-2;           // half the square of the Newton decrement
constexpr double k_least_slope = 1e-4;       // Armijo
constexpr double k_largest_turn = 0.5;       // radians a step
constexpr double k_line_end = 1e3;           // beyond every point
constexpr double k_least_diagonal = 1e-300;  // an unknown that nothing depends on stays where it is
// Pivots of a unit diagonal below these count as 0. A descent into a needle needs all the digits there are; a
// separation whose forces are noise is worse than one that has stopped early.
constexpr double k_singular_descent = 1e-16, k_singular_separation = 1e-13;

using Vector = std::array<double, k_most_free>;
using Matrix = std::array<Vector, k_most_free>;

// --- ties: unknowns = constant + linear in the free variables ---------------------------------------------

struct Tie {
  double constant = 0;
  int terms = 0;
  std::array<int, 2> free{};
  std::array<double, 2> factor{};
  void add(int variable, double f) {
    free[terms] = variable;
    factor[terms++] = f;
  }
};

struct Ties {
  std::array<Tie, k_unknowns> of;
  int free = 0;
  int variable(int unknown) {
    of[unknown].add(free, 1);
    return free++;
  }
};

// --- derivatives in the unknowns
// ----------------------------------------------------------------------------

struct Derivatives {
  std::array<double, k_unknowns> gradient{};
  std::array<std::array<double, k_unknowns>, k_unknowns> hessian{};  // upper triangle

  void add(int i, int j, double v) { hessian[std::min(i, j)][std::max(i, j)] += v; }
};

// Adds -log(r^2 - |e|^2) of one point; `p` is the arm that turns. Returns w = 2 / (r^2 - |e|^2).
//
// With J the derivatives of e (a coordinate that is 0 has none: the point is beside the rectangle there) the
// gradient is g = w J^T e, for r -w r, and the second derivatives are g g^T + w J^T J, for r less w.
double add_point(const Double3& p, const Double3& e, const SweptRectangle& s, Derivatives& d) {
  const double slack = s.r * s.r - dot(e, e), w = 2 / slack;
  const double a = e.x != 0 ? w : 0, b = e.y != 0 ? w : 0;
  const int at_a = e.x < 0 ? at_a0 : at_a1, at_b = e.y < 0 ? at_b0 : at_b1;
  const Double3 t = cross(p, e) * w;
  const double ga = -w * e.x, gb = -w * e.y, gh = -w * e.z, gr = -w * s.r;
  auto& g = d.gradient;
  g[turn_x] += t.x, g[turn_y] += t.y, g[turn_z] += t.z;
  g[at_a] += ga, g[at_b] += gb, g[at_h] += gh, g[at_r] += gr;
  auto& x = d.hessian[turn_x];
  x[turn_x] += t.x * t.x + b * p.z * p.z + w * p.y * p.y;
  x[turn_y] += t.x * t.y - w * p.x * p.y;
  x[turn_z] += t.x * t.z - b * p.x * p.z;
  x[at_a] += t.x * ga;
  x[at_b] += t.x * gb + b * p.z;
  x[at_h] += t.x * gh - w * p.y;
  x[at_r] += t.x * gr;
  auto& y = d.hessian[turn_y];
  y[turn_y] += t.y * t.y + a * p.z * p.z + w * p.x * p.x;
  y[turn_z] += t.y * t.z - a * p.y * p.z;
  y[at_a] += t.y * ga - a * p.z;
  y[at_b] += t.y * gb;
  y[at_h] += t.y * gh + w * p.x;
  y[at_r] += t.y * gr;
  auto& z = d.hessian[turn_z];
  z[turn_z] += t.z * t.z + a * p.y * p.y + b * p.x * p.x;
  z[at_a] += t.z * ga + a * p.y;
  z[at_b] += t.z * gb - b * p.x;
  z[at_h] += t.z * gh;
  z[at_r] += t.z * gr;
  auto& ha = d.hessian[at_a];
  ha[at_a] += ga * ga + a, ha[at_b] += ga * gb, ha[at_h] += ga * gh, ha[at_r] += ga * gr;
  auto& hb = d.hessian[at_b];
  hb[at_b] += gb * gb + b, hb[at_h] += gb * gh, hb[at_r] += gb * gr;
  d.hessian[at_h][at_h] += gh * gh + w, d.hessian[at_h][at_r] += gh * gr;
  d.hessian[at_r][at_r] += gr * gr - w;
  return w;
}

// What the second-order part of a rotation, w x (w x p) / 2, adds for a force f on p.
void add_curvature(const Double3& p, const Double3& f, Derivatives& d) {
  const double inner = dot(p, f);
  for (int i = 0; i < 3; ++i) {
    for (int j = i; j < 3; ++j) {
      d.hessian[i][j] += 0.5 * (p[i] * f[j] + p[j] * f[i]) - (i == j ? inner : 0);
    }
  }
}

struct VolumeSlopes {
  double value;
  std::array<double, 3> first;  // by a, b, r
  std::array<std::array<double, 3>, 3> second;
};

VolumeSlopes slopes_of_log_volume(const SweptLengths& l) {
  constexpr double pi = std::numbers::pi;
  const double v = swept_volume(l);
  VolumeSlopes s{std::log(v),
                 {(2 * l.r * l.b + pi * l.r * l.r) / v, (2 * l.r * l.a + pi * l.r * l.r) / v,
                  (2 * l.a * l.b + 2 * pi * l.r * (l.a + l.b) + 4 * pi * l.r * l.r) / v},
                 {}};
  const double ab = 2 * l.r, ar = 2 * l.b + 2 * pi * l.r, br = 2 * l.a + 2 * pi * l.r;
  const double rr = 2 * pi * (l.a + l.b) + 8 * pi * l.r;
  s.second = {{{0, ab, ar}, {ab, 0, br}, {ar, br, rr}}};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) s.second[i][j] = s.second[i][j] / v - s.first[i] * s.first[j];
  }
  return s;
}

// --- linear algebra
// -------------------------------------------------------------------------------------------

// Solves H x = -g by Cholesky's method with a unit diagonal; false when H is not positive.
bool solve(const Matrix& h, const Vector& g, int n, double singular, Vector& x) {
  Matrix l;
  Vector scale, inverse;  // of the diagonal
  for (int i = 0; i < n; ++i) {
    if (!(h[i][i] > 0) || !std::isfinite(h[i][i])) return false;
    scale[i] = 1 / std::sqrt(h[i][i]);
  }
  for (int j = 0; j < n; ++j) {
    for (int i = j; i < n; ++i) {
      double sum = h[j][i] * scale[i] * scale[j];
      for (int k = 0; k < j; ++k) sum -= l[i][k] * l[j][k];
      if (i == j) {
        if (!(sum > singular)) return false;
        inverse[j] = 1 / std::sqrt(sum);
      } else {
        l[i][j] = sum * inverse[j];
      }
    }
  }
  for (int i = 0; i < n; ++i) {
    double sum = -g[i] * scale[i];
    for (int k = 0; k < i; ++k) sum -= l[i][k] * x[k];
    x[i] = sum * inverse[i];
  }
  for (int i = n - 1; i >= 0; --i) {
    double sum = x[i];
    for (int k = i + 1; k < n; ++k) sum -= l[k][i] * x[k];
    x[i] = sum * inverse[i];
  }
  for (int i = 0; i < n; ++i) x[i] *= scale[i];
  return true;
}

// --- the sum of logs
// ------------------------------------------------------------------------------------------

class LogSum {  // of -log, multiplied together a few at a time
 public:
  bool add(double slack) {
    if (!(slack > 0)) return false;
    product_ *= slack;
    if (product_ < 1e-200 || product_ > 1e200) flush();
    return true;
  }
  double value() {
    flush();
    return sum_;
  }

 private:
  void flush() { sum_ -= std::log(product_), product_ = 1; }
  double product_ = 1, sum_ = 0;
};

bool add_points(std::span<const Double3> q, const SweptRectangle& s, LogSum& sum) {
  if (!(s.r > 0)) return false;
  const double square = s.r * s.r;
  for (const Double3& p : q) {
    const Double3 e = offset_from(s, p);
    if (!sum.add(square - dot(e, e))) return false;
  }
  return true;
}

// --- Newton's method, for both problems
// -------------------------------------------------------------------------

class Barrier {
 public:
  virtual ~Barrier() = default;
  void follow(const BarrierGaps& gaps);

 protected:
  virtual double value(const Vector& free, double weight) = 0;  // infinite outside
  // With `convex`, without what may be negative.
  virtual void derive(double weight, bool convex, Vector& gradient, Matrix& hessian) = 0;
  virtual void accept(const Vector& free) = 0;
  virtual int constraints() const = 0;
  virtual double singular() const = 0;

  void reduce(const Derivatives& d, Vector& gradient, Matrix& hessian) const;
  double unknown(int i, const Vector& free) const {
    const Tie& tie = tied.of[i];
    double v = tie.constant;
    for (int k = 0; k < tie.terms; ++k) v += tie.factor[k] * free[tie.free[k]];
    return v;
  }
  SweptRectangle rectangle(const Vector& free) const {
    return {unknown(at_a0, free), unknown(at_a1, free), unknown(at_b0, free),
            unknown(at_b1, free), unknown(at_h, free),  unknown(at_r, free)};
  }
  Double3 turn(const Vector& free) const {
    return {unknown(turn_x, free), unknown(turn_y, free), unknown(turn_z, free)};
  }

  Ties tied;
  Vector values{};

 private:
  bool step(double weight, double& decrement);
  struct {
    double weight = 0, value = 0;
  } known_;  // at `values`
};

void Barrier::reduce(const Derivatives& d, Vector& gradient, Matrix& hessian) const {
  struct Term {
    int unknown, free;
    double factor;
  };
  std::array<Term, 2 * k_unknowns> terms;
  int n = 0;
  for (int i = 0; i < k_unknowns; ++i) {
    const Tie& tie = tied.of[i];
    for (int m = 0; m < tie.terms; ++m) terms[n++] = {i, tie.free[m], tie.factor[m]};
  }
  for (int i = 0; i < n; ++i) {
    const Term& a = terms[i];
    gradient[a.free] += a.factor * d.gradient[a.unknown];
    hessian[a.free][a.free] += a.factor * a.factor * d.hessian[a.unknown][a.unknown];
    for (int j = i + 1; j < n; ++j) {  // unknowns ascend
      const Term& b = terms[j];
      const double h = a.factor * b.factor * d.hessian[a.unknown][b.unknown];
      hessian[a.free][b.free] += h, hessian[b.free][a.free] += h;
    }
  }
}

bool Barrier::step(double weight, double& decrement) {
  const int n = tied.free;
  Vector gradient, direction;
  double slope = 0;
  bool found = false;
  for (const bool convex : {false, true}) {
    gradient = {};
    Matrix hessian{};
    derive(weight, convex, gradient, hessian);
    double largest = 0;
    for (int i = 0; i < n; ++i) largest = std::max(largest, hessian[i][i]);
    for (int i = 0; i < n; ++i) hessian[i][i] += std::max(k_least_diagonal, largest * 1e-15);
    if (!solve(hessian, gradient, n, singular(), direction)) continue;
    slope = 0;
    for (int i = 0; i < n; ++i) slope += gradient[i] * direction[i];
    found = slope < 0;
    if (found) break;
  }
  if (!found) return false;
  decrement = -slope / 2;
  const double before = known_.weight == weight ? known_.value : value(values, weight);
  if (!std::isfinite(before)) return false;  // a point has come to lie on the surface, but for rounding
  double length = 1;
  for (int halvings = 0; halvings < 40; ++halvings, length /= 2) {
    Vector next = values;
    for (int i = 0; i < n; ++i) next[i] += length * direction[i];
    const double after = value(next, weight);
    if (after <= before + k_least_slope * length * slope) {
      accept(next);
      known_ = {weight, after};
      return true;
    }
  }
  return false;
}

void Barrier::follow(const BarrierGaps& gaps) {
  const double m = constraints();
  for (double gap = gaps.first;; gap = std::max(gap * k_gap_factor, gaps.last)) {
    for (int k = 0; k < k_steps_a_centre; ++k) {
      double decrement = 0;
      if (!step(m / gap, decrement) || decrement < k_centred) break;
    }
    if (gap <= gaps.last) return;
  }
}

// --- descent
// ------------------------------------------------------------------------------------------------------

class Descent final : public Barrier {
 public:
  Descent(Swept kind, std::span<const Double3> points, const SweptFit& fit)
      : kind_(kind), points_(points), fit_(fit), q_(points.size()), trial_(points.size()) {
    const SweptRectangle& s = fit.rectangle;
    if (kind == Swept::lozenge) tied.variable(turn_x);
    tied.variable(turn_y), tied.variable(turn_z);
    if (kind == Swept::line) {  // no point is beyond an end
      tied.of[at_a0].constant = -k_line_end, tied.of[at_a1].constant = k_line_end;
    } else {
      place(at_a0, s.a0), place(at_a1, s.a1);
    }
    place(at_b0, s.b0);
    if (kind == Swept::lozenge) {
      place(at_b1, s.b1);
    } else {
      tied.of[at_b1] = tied.of[at_b0];
    }
    place(at_h, s.h), place(at_r, s.r);
    fit_.rectangle = rectangle(values);
    for (std::size_t i = 0; i < points.size(); ++i) q_[i] = into(fit.frame, points[i]);
  }
  const SweptFit& fit() const { return fit_; }

 protected:
  double value(const Vector& free, double weight) override {
    const SweptRectangle s = rectangle(free);
    const Double3 w = turn(free);
    if (dot(w, w) > k_largest_turn * k_largest_turn) return k_infinity;
    std::span<const Double3> q = q_;
    if (w != Double3{}) {
      const Axes frame = turned(fit_.frame, w * 0.5);
      for (std::size_t i = 0; i < points_.size(); ++i) trial_[i] = into(frame, points_[i]);
      q = trial_;
    }
    LogSum sum;
    if (kind_ != Swept::line && !sum.add(s.a1 - s.a0)) return k_infinity;
    if (kind_ == Swept::lozenge && !sum.add(s.b1 - s.b0)) return k_infinity;
    if (!add_points(q, s, sum)) return k_infinity;
    return weight * std::log(kind_ == Swept::line ? s.r : swept_volume(s.lengths())) + sum.value();
  }

  void derive(double weight, bool convex, Vector& gradient, Matrix& hessian) override {
    Derivatives d;
    const SweptRectangle& s = fit_.rectangle;
    for (const Double3& q : q_) {
      const Double3 e = offset_from(s, q);
      const double w = add_point(q, e, s, d);
      if (!convex) add_curvature(q, e * w, d);
    }
    if (kind_ == Swept::line) {
      d.gradient[at_r] += weight / s.r;
      if (!convex) d.add(at_r, at_r, -weight / (s.r * s.r));
    } else {
      add_length(at_a0, at_a1, d);
      if (kind_ == Swept::lozenge) add_length(at_b0, at_b1, d);
      add_volume(weight, convex, d);
    }
    reduce(d, gradient, hessian);
  }

  void accept(const Vector& free) override {
    const Double3 w = turn(free);
    fit_.rectangle = rectangle(free);
    values = free;
    if (w == Double3{}) return;
    fit_.frame = orthonormal(turned(fit_.frame, w * 0.5));
    for (int k = 0; k < (kind_ == Swept::lozenge ? 3 : 2); ++k) values[k] = 0;
    for (std::size_t i = 0; i < points_.size(); ++i) q_[i] = into(fit_.frame, points_[i]);
  }

  int constraints() const override { return static_cast<int>(points_.size()) + 2; }
  double singular() const override { return k_singular_descent; }

 private:
  void place(int unknown, double v) { values[tied.variable(unknown)] = v; }

  void add_length(int low, int high, Derivatives& d) const {
    const double g = 1 / (unknown(high, values) - unknown(low, values));
    d.gradient[high] -= g, d.gradient[low] += g;
    d.add(high, high, g * g), d.add(low, low, g * g), d.add(low, high, -g * g);
  }

  void add_volume(double weight, bool convex, Derivatives& d) const {
    static constexpr std::array<std::array<std::pair<int, double>, 2>, 3> k_places{
        {{{{at_a1, 1}, {at_a0, -1}}}, {{{at_b1, 1}, {at_b0, -1}}}, {{{at_r, 1}, {at_r, 0}}}}};
    const VolumeSlopes v = slopes_of_log_volume(fit_.rectangle.lengths());
    for (int i = 0; i < 3; ++i) {
      for (const auto& [p, f] : k_places[i]) {
        d.gradient[p] += weight * f * v.first[i];
        if (convex) continue;
        for (int j = 0; j < 3; ++j) {
          for (const auto& [q, g] : k_places[j]) {
            if (p <= q) d.hessian[p][q] += weight * f * g * v.second[i][j];
          }
        }
      }
    }
  }

  Swept kind_;
  std::span<const Double3> points_;
  SweptFit fit_;
  std::vector<Double3> q_, trial_;
};

// --- separation
// ---------------------------------------------------------------------------------------------------

class Separating final : public Barrier {
 public:
  Separating(Swept kind, std::span<const Double3> points, const Separation& problem, double s)
      : kind_(kind), points_(points), problem_(problem), q_(points.size()) {
    if (kind == Swept::lozenge) tied.variable(turn_x);
    tied.variable(turn_y), tied.variable(turn_z);
    DoubleBox box;
    for (const Double3& p : points) box.grow(p);
    const Double3 middle = box.centre();
    length_ = tied.free++;
    values[length_] = s;
    side(at_a0, at_a1, problem.from.a, problem.along.a, middle.x);
    side(at_b0, at_b1, problem.from.b, problem.along.b, middle.y);
    values[tied.variable(at_h)] = middle.z;
    tied.of[at_r].constant = problem.from.r;
    tied.of[at_r].add(length_, problem.along.r);
  }

  void read(SeparationState& state, double gap) const {
    state.s = values[length_];
    state.turn = turn(values) * 0.5;
    state.rectangle = rectangle(values);
    state.forces.clear();
    const SweptRectangle& s = state.rectangle;
    const double unit = gap / constraints();
    for (const Double3& p : points_) {
      const Double3 e = offset_from(s, linearly_turned(p, state.turn));
      state.forces.push_back(e * (2 * unit / (s.r * s.r - dot(e, e))));
    }
  }

 protected:
  double value(const Vector& free, double weight) override {
    LogSum sum;
    if (!sum.add(free[length_])) return k_infinity;
    const Double3 g = turn(free) * 0.5;
    for (int k = first(); k < 3; ++k) {
      const double v = dot(problem_.rows[k], g);
      if (!sum.add(problem_.half[k] - v) || !sum.add(problem_.half[k] + v)) return k_infinity;
    }
    for (std::size_t i = 0; i < points_.size(); ++i) q_[i] = linearly_turned(points_[i], g);
    if (!add_points(q_, rectangle(free), sum)) return k_infinity;
    return weight * free[length_] + sum.value();
  }

  void derive(double weight, bool, Vector& gradient, Matrix& hessian) override {
    Derivatives d;
    const SweptRectangle s = rectangle(values);
    const Double3 g = turn(values) * 0.5;
    for (const Double3& p : points_) add_point(p, offset_from(s, linearly_turned(p, g)), s, d);
    for (int k = first(); k < 3; ++k) {
      const Double3 row = problem_.rows[k] * 0.5;
      const double v = dot(row, g) * 2;
      const double up = 1 / (problem_.half[k] - v), down = 1 / (problem_.half[k] + v);
      for (int i = 0; i < 3; ++i) {
        d.gradient[i] += row[i] * (up - down);
        for (int j = i; j < 3; ++j) d.hessian[i][j] += row[i] * row[j] * (up * up + down * down);
      }
    }
    reduce(d, gradient, hessian);
    const double inverse = 1 / values[length_];
    gradient[length_] += weight - inverse;
    hessian[length_][length_] += inverse * inverse;
  }

  void accept(const Vector& free) override { values = free; }
  int constraints() const override { return static_cast<int>(points_.size()) + 7; }
  double singular() const override { return k_singular_separation; }

 private:
  int first() const { return kind_ == Swept::lozenge ? 0 : 1; }

  void side(int low, int high, double from, double along, double middle) {
    const int place = tied.variable(low);
    values[place] = middle - (from + along * values[length_]) / 2;
    tied.of[high].constant = from;
    tied.of[high].add(place, 1);
    if (along != 0) tied.of[high].add(length_, along);
  }

  Swept kind_;
  std::span<const Double3> points_;
  const Separation& problem_;
  std::vector<Double3> q_;
  int length_ = 0;
};

}  // namespace

void descend(Swept kind, std::span<const Double3> points, SweptFit& fit, const BarrierGaps& gaps) {
  Descent descent(kind, points, fit);
  descent.follow(gaps);
  SweptFit found = descent.fit();
  if (kind == Swept::line) {
    DoubleBox box;
    for (const Double3& p : points) box.grow(into(found.frame, p));
    found.rectangle.a0 = box.min.x, found.rectangle.a1 = box.max.x;
    if (found.rectangle.r <= fit.rectangle.r) fit = found;
  } else if (found.volume() <= fit.volume()) {
    fit = found;
  }
}

void separate(Swept kind, std::span<const Double3> points, const Separation& problem, const BarrierGaps& gaps,
              SeparationState& state) {
  Separating separating(kind, points, problem, state.s);
  separating.follow(gaps);
  separating.read(state, gaps.last);
}

}  // namespace copse
