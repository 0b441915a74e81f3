#include "lib/analysis/ecosystem/nurbs_surface.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace copse {
namespace {

// The basis functions that are not 0 at one parameter: of control points first .. first + degree.
struct Basis {
  std::size_t first = 0;
  std::array<double, k_max_degree + 1> values{};
};

double parameter(std::span<const double> knots, int degree, double at) {
  const double low = knots[static_cast<std::size_t>(degree)],
               high = knots[knots.size() - 1 - static_cast<std::size_t>(degree)];
  return std::clamp(at, low, high);
}

Basis basis_at(std::span<const double> knots, int degree, double at) {
  const auto p = static_cast<std::size_t>(degree);
  const std::size_t count = knots.size() - p - 1;
  const double t = parameter(knots, degree, at);
  // The last span [k, k + 1) that begins at or before t and is not empty.
  auto above = static_cast<std::size_t>(std::upper_bound(knots.begin(), knots.end(), t) - knots.begin());
  std::size_t span = std::min(above, count) - 1;
  while (span > p && knots[span] == knots[span + 1]) --span;
  Basis b{.first = span - p};
  std::array<double, k_max_degree + 1> left{}, right{};
  b.values[0] = 1;
  for (std::size_t j = 1; j <= p; ++j) {
    left[j] = t - knots[span + 1 - j];
    right[j] = knots[span + j] - t;
    double saved = 0;
    for (std::size_t r = 0; r < j; ++r) {
      const double width = right[r + 1] + left[j - r];
      const double part = width > 0 ? b.values[r] / width : 0;  // 0/0 := 0
      b.values[r] = saved + right[r + 1] * part;
      saved = left[j - r] * part;
    }
    b.values[j] = saved;
  }
  return b;
}

Double3 combine(const NurbsSurface& s, const Basis& bu, const Basis& bv) {
  Double3 sum;
  double weight = 0;
  for (std::size_t j = 0; j <= static_cast<std::size_t>(s.degree_v); ++j) {
    for (std::size_t i = 0; i <= static_cast<std::size_t>(s.degree_u); ++i) {
      const std::size_t at = (bv.first + j) * s.count_u + bu.first + i;
      const double w = bu.values[i] * bv.values[j] * (s.weights.empty() ? 1.0 : s.weights[at]);
      sum += s.points[at] * w;
      weight += w;
    }
  }
  return sum / weight;
}

std::string fault_of_knots(const char* name, const std::vector<double>& knots, std::size_t count,
                           int degree) {
  if (degree < 1 || degree > k_max_degree)
    return fmt::format("degree {} is not 1 to {}", degree, k_max_degree);
  const auto p = static_cast<std::size_t>(degree);
  if (count < p + 1)
    return fmt::format("{} control points are too few for degree {}, which needs {}", count, degree, p + 1);
  if (knots.size() != count + p + 1)
    return fmt::format("{} has {} knots, {} control points of degree {} need {}", name, knots.size(), count,
                       degree, count + p + 1);
  for (std::size_t i = 0; i < knots.size(); ++i) {
    if (!std::isfinite(knots[i])) return fmt::format("{}[{}] is not finite", name, i);
    if (i > 0 && knots[i] < knots[i - 1]) return fmt::format("{}[{}] is below the knot before it", name, i);
  }
  for (std::size_t i = 0; i + p + 1 < knots.size(); ++i)
    if (knots[i] == knots[i + p + 1])
      return fmt::format("{}[{}] is repeated {} times, degree {} allows {}", name, i, p + 2, degree, p + 1);
  if (!(knots[p] < knots[count])) return fmt::format("{} spans nothing", name);
  return {};
}

// The parameter of sample `i` of `n`: the ends exactly.
double step(double low, double high, std::size_t i, std::size_t n) {
  if (i + 1 == n) return high;
  return low + (high - low) * (static_cast<double>(i) / static_cast<double>(n - 1));
}

}  // namespace

std::string fault_of(const NurbsSurface& s) {
  if (auto wrong = fault_of_knots("knots_u", s.knots_u, s.count_u, s.degree_u); !wrong.empty()) return wrong;
  if (auto wrong = fault_of_knots("knots_v", s.knots_v, s.count_v, s.degree_v); !wrong.empty()) return wrong;
  const std::size_t count = s.count_u * s.count_v;
  if (s.points.size() != count) return fmt::format("{} control points, expected {}", s.points.size(), count);
  for (std::size_t i = 0; i < count; ++i)
    if (!is_finite(s.points[i])) return fmt::format("control point {} is not finite", i);
  if (s.weights.empty()) return {};
  if (s.weights.size() != count) return fmt::format("{} weights, expected {}", s.weights.size(), count);
  for (std::size_t i = 0; i < count; ++i)
    if (!(s.weights[i] > 0 && std::isfinite(s.weights[i])))
      return fmt::format("weight {} is {}, not above 0", i, s.weights[i]);
  return {};
}

std::vector<double> clamped_knots(std::size_t count, int degree) {
  const auto p = static_cast<std::size_t>(degree);
  std::vector<double> knots(count + p + 1);
  const std::size_t spans = count - p;
  for (std::size_t i = 0; i < knots.size(); ++i) {
    const std::size_t inner = i <= p ? 0 : std::min(i - p, spans);
    knots[i] = static_cast<double>(inner) / static_cast<double>(spans);
  }
  return knots;
}

std::vector<double> greville(std::span<const double> knots, int degree) {
  const auto p = static_cast<std::size_t>(degree);
  std::vector<double> out(knots.size() - p - 1);
  for (std::size_t i = 0; i < out.size(); ++i) {
    double sum = 0;
    for (std::size_t k = 1; k <= p; ++k) sum += knots[i + k];
    out[i] = sum / static_cast<double>(p);
  }
  return out;
}

Double3 evaluate(const NurbsSurface& s, double u, double v) {
  return combine(s, basis_at(s.knots_u, s.degree_u, u), basis_at(s.knots_v, s.degree_v, v));
}

std::vector<Double3> sample(const NurbsSurface& s, std::size_t columns, std::size_t rows) {
  const auto domain = [](const std::vector<double>& knots, int degree) {
    const auto p = static_cast<std::size_t>(degree);
    return std::pair(knots[p], knots[knots.size() - 1 - p]);
  };
  const auto [u0, u1] = domain(s.knots_u, s.degree_u);
  const auto [v0, v1] = domain(s.knots_v, s.degree_v);
  std::vector<Basis> along(columns);
  for (std::size_t i = 0; i < columns; ++i)
    along[i] = basis_at(s.knots_u, s.degree_u, step(u0, u1, i, columns));
  std::vector<Double3> out(columns * rows);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, rows), [&](const auto& range) {
    for (std::size_t j = range.begin(); j < range.end(); ++j) {
      const Basis across = basis_at(s.knots_v, s.degree_v, step(v0, v1, j, rows));
      for (std::size_t i = 0; i < columns; ++i) out[j * columns + i] = combine(s, along[i], across);
    }
  });
  return out;
}

}  // namespace copse
