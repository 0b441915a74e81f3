#include "lib/formats/export/html_chart.h"

#include "lib/formats/export/html_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <fmt/format.h>

namespace copse {
namespace {

constexpr double k_width = 940, k_height = 390;
constexpr double k_left = 70, k_right = 16, k_top = 34, k_bottom = 50;
constexpr double k_log_span = 50;  // values that span more than this factor get a logarithmic axis
constexpr double k_glyph = 6.6;    // mean width of a character of the labels
constexpr std::size_t k_colours = 8;

struct Tick {
  double value;
  bool labelled;
};

struct Axis {
  double low = 0, high = 1;  // of the values, or of their logarithms
  bool log = false;
  double from = 0, to = 1;  // in the chart
  int digits = 3;           // significant ones that tell the ticks apart
  std::vector<Tick> ticks;

  double at(double value) const {
    const double v = log ? std::log10(value) : value;
    return from + (v - low) / (high - low) * (to - from);
  }
};

// 1, 2 or 5 times a power of ten, so that about `count` steps cover `span`.
double nice_step(double span, int count) {
  const double raw = span / count;
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  const double lead = raw / power;
  return power * (lead <= 1 ? 1 : lead <= 2 ? 2 : lead <= 5 ? 5 : 10);
}

void make_linear(Axis& axis, double low, double high) {
  // Zero belongs to a scale that comes near it.
  if (low > 0 && low < 0.3 * high) low = 0;
  if (high < 0 && high > 0.3 * low) high = 0;
  const double size = std::max({std::fabs(low), std::fabs(high), std::numeric_limits<double>::min() * 1e3});
  if (!(high - low > 1e-9 * size)) {
    const double middle = (low + high) / 2;
    low = middle - 0.5 * (middle == 0 ? 1 : size);
    high = middle + 0.5 * (middle == 0 ? 1 : size);
  }
  const double step = nice_step(high - low, 5);
  axis.low = std::floor(low / step + 1e-9) * step;
  axis.high = std::ceil(high / step - 1e-9) * step;
  const double largest = std::max(std::fabs(axis.low), std::fabs(axis.high));
  axis.digits = std::clamp(static_cast<int>(std::floor(std::log10(largest / step))) + 2, 3, 16);
  const int steps = static_cast<int>(std::lround((axis.high - axis.low) / step));
  for (int i = 0; i <= steps && i < 50; ++i) axis.ticks.push_back({axis.low + i * step, true});
}

void make_log(Axis& axis, double low, double high) {
  axis.log = true;
  const double margin = 0.04 * std::log10(high / low);
  axis.low = std::log10(low) - margin;
  axis.high = std::log10(high) + margin;
  const int first = static_cast<int>(std::floor(axis.low));
  const int last = static_cast<int>(std::ceil(axis.high));
  const double decades = axis.high - axis.low;
  const int every = std::max(1, static_cast<int>(std::ceil(decades / 7)));
  for (int e = first; e <= last; ++e) {
    for (int m = 1; m < 10; ++m) {
      const double value = m * std::pow(10.0, e);
      const double v = std::log10(value);
      if (v < axis.low || v > axis.high || (m > 1 && every > 1)) continue;
      const bool major = m == 1 && e % every == 0;
      axis.ticks.push_back({value, major || (decades < 2.5 && (m == 2 || m == 5))});
    }
  }
}

Axis make_axis(const std::vector<double>& values, double from, double to) {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  // Far from the ends of double, so that no difference and no power of ten overflows.
  const double low = std::clamp(*least, -1e300, 1e300), high = std::clamp(*most, -1e300, 1e300);
  Axis axis;
  axis.from = from;
  axis.to = to;
  if (low > 1e-300 && high / low > k_log_span) {
    make_log(axis, low, high);
  } else {
    make_linear(axis, low, high);
  }
  return axis;
}

struct Box {
  double x0, y0, x1, y1;
  bool meets(const Box& b) const { return x0 < b.x1 && b.x0 < x1 && y0 < b.y1 && b.y0 < y1; }
};

std::string marker(std::size_t series, double x, double y) {
  switch (series % 4) {
    case 1:
      return fmt::format("<path d='M{:.1f} {:.1f}h8v8h-8z'/>", x - 4, y - 4);
    case 2:
      return fmt::format("<path d='M{:.1f} {:.1f}l5 9h-10z'/>", x, y - 5.5);
    case 3:
      return fmt::format("<path d='M{:.1f} {:.1f}l5.5 5.5l-5.5 5.5l-5.5-5.5z'/>", x, y - 5.5);
    default:
      return fmt::format("<circle cx='{:.1f}' cy='{:.1f}' r='4.5'/>", x, y);
  }
}

struct Placed {
  const CurvePoint* point;
  double x, y;
};

// The finite points of a curve, where they fall in the chart.
std::vector<Placed> place(const Curve& curve, const Axis& x, const Axis& y) {
  std::vector<Placed> placed;
  for (const CurvePoint& p : curve.points) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) continue;
    placed.push_back({&p, x.at(std::clamp(p.x, -1e300, 1e300)), y.at(std::clamp(p.y, -1e300, 1e300))});
  }
  return placed;
}

void draw_axes(std::string& out, const Axis& x, const Axis& y, const Curve& names) {
  out += "<g class='grid'>";
  for (const Tick& t : x.ticks) {
    out += fmt::format("<path class='{}' d='M{:.1f} {}V{}'/>", t.labelled ? "major" : "minor", x.at(t.value),
                       k_top, k_height - k_bottom);
  }
  for (const Tick& t : y.ticks) {
    out += fmt::format("<path class='{}' d='M{} {:.1f}H{}'/>", t.labelled ? "major" : "minor", k_left,
                       y.at(t.value), k_width - k_right);
  }
  out += "</g><g class='ticks'>";
  for (const Tick& t : x.ticks) {
    if (!t.labelled) continue;
    out += fmt::format("<text x='{:.1f}' y='{}' text-anchor='middle'>{}</text>", x.at(t.value),
                       k_height - k_bottom + 17, show_number(t.value, x.digits));
  }
  for (const Tick& t : y.ticks) {
    if (!t.labelled) continue;
    out += fmt::format("<text x='{}' y='{:.1f}' text-anchor='end'>{}</text>", k_left - 8, y.at(t.value) + 4,
                       show_number(t.value, y.digits));
  }
  out += fmt::format("<text class='axis' x='{}' y='{}' text-anchor='end'>{}{} →</text>", k_width - k_right,
                     k_height - 10, escape_html(names.x), x.log ? " (log)" : "");
  out += fmt::format("<text class='axis' x='8' y='16'>↑ {}{}</text></g>", escape_html(names.y),
                     y.log ? " (log)" : "");
}

// Labels go right of their points, else left, above, below; where nothing is free the tooltip must do.
void draw_labels(std::string& out, const std::vector<std::vector<Placed>>& series,
                 const std::vector<std::vector<Placed>>& labelled) {
  std::vector<Box> taken;
  for (const auto& points : series) {
    for (const Placed& p : points) taken.push_back({p.x - 5, p.y - 5, p.x + 5, p.y + 5});
  }
  constexpr std::array<std::array<double, 3>, 4> k_places{
      {{9, 4, 0}, {-9, 4, 1}, {0, -9, 0.5}, {0, 17, 0.5}}};
  constexpr std::array<const char*, 3> k_anchors{"start", "middle", "end"};
  out += "<g class='labels'>";
  for (const auto& points : labelled) {
    for (const Placed& p : points) {
      if (p.point->label.empty()) continue;
      const double length = k_glyph * static_cast<double>(p.point->label.size());
      for (const auto& [dx, dy, share] : k_places) {
        const double x0 = p.x + dx - share * length, y0 = p.y + dy;
        const Box box{x0, y0 - 11, x0 + length, y0 + 3};
        const bool inside =
            box.x0 > k_left && box.x1 < k_width - 4 && box.y0 > k_top - 8 && box.y1 < k_height - k_bottom;
        if (!inside || std::any_of(taken.begin(), taken.end(), [&](const Box& b) { return b.meets(box); }))
          continue;
        taken.push_back(box);
        out += fmt::format("<text x='{:.1f}' y='{:.1f}' text-anchor='{}'>{}</text>", p.x + dx, y0,
                           k_anchors[static_cast<std::size_t>(share * 2)], escape_html(p.point->label));
        break;
      }
    }
  }
  out += "</g>";
}

// Points without labels belong to a line; labelled ones stand for themselves.
bool is_line(const Curve& curve) {
  return curve.points.size() > 1 && std::all_of(curve.points.begin(), curve.points.end(),
                                                [](const CurvePoint& p) { return p.label.empty(); });
}

// Of trials those that nothing further left is below, from left to right.
std::vector<Placed> best_so_far(std::vector<Placed> points) {
  std::stable_sort(points.begin(), points.end(), [](const Placed& a, const Placed& b) {
    return a.point->x != b.point->x ? a.point->x < b.point->x : a.point->y < b.point->y;
  });
  std::vector<Placed> best;
  for (const Placed& p : points) {
    if (best.empty() || p.point->y < best.back().point->y) best.push_back(p);
  }
  return best;
}

// Marks on a dense line would hide it.
bool has_marks(const Curve& curve) {
  return !is_line(curve) || curve.points.size() <= 60;
}

void draw_series(std::string& out, std::size_t index, const Curve& curve, const std::vector<Placed>& points) {
  out += fmt::format("<g class='series c{}'>", index % k_colours);
  if (is_line(curve) || curve.trials) {
    std::string path;
    for (const Placed& p : curve.trials ? best_so_far(points) : points)
      path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", p.x, p.y);
    out += fmt::format("<path class='line' d='{}'/>", path);
  }
  for (const Placed& p : points) {
    if (!has_marks(curve)) break;
    const std::string label = p.point->label.empty() ? "" : fmt::format(", {}", escape_html(p.point->label));
    out += fmt::format("<g>{}<title>{}{}: {} {}, {} {}</title></g>", marker(index, p.x, p.y),
                       escape_html(curve.name), label, escape_html(curve.x), show_number(p.point->x, 4),
                       escape_html(curve.y), show_number(p.point->y, 4));
  }
  out += "</g>";
}

}  // namespace

std::string chart_svg(std::span<const Curve> curves, const std::string& id) {
  std::vector<double> xs, ys;
  for (const Curve& curve : curves) {
    for (const CurvePoint& p : curve.points) {
      if (!std::isfinite(p.x) || !std::isfinite(p.y)) continue;
      xs.push_back(p.x);
      ys.push_back(p.y);
    }
  }
  if (xs.empty()) return {};
  const Axis x = make_axis(xs, k_left, k_width - k_right);
  const Axis y = make_axis(ys, k_height - k_bottom, k_top);
  std::string names;
  for (const Curve& curve : curves) names += (names.empty() ? "" : ", ") + curve.name;
  std::string out = fmt::format(
      "<svg class='chart' viewBox='0 0 {} {}' role='img' aria-labelledby='{}-title' "
      "xmlns='http://www.w3.org/2000/svg'>"
      "<title id='{}-title'>{} against {}: {}</title>",
      k_width, k_height, id, id, escape_html(curves.front().y), escape_html(curves.front().x),
      escape_html(names));
  draw_axes(out, x, y, curves.front());
  std::vector<std::vector<Placed>> series;
  for (const Curve& curve : curves) series.push_back(place(curve, x, y));
  for (std::size_t i = 0; i < series.size(); ++i) draw_series(out, i, curves[i], series[i]);
  std::vector<std::vector<Placed>> labelled;
  for (std::size_t i = 0; i < series.size(); ++i)
    labelled.push_back(curves[i].trials ? best_so_far(series[i]) : series[i]);
  draw_labels(out, series, labelled);
  return out + "</svg>";
}

std::string legend_svg(const Curve& curve, std::size_t index) {
  return fmt::format("<svg viewBox='0 0 26 14' aria-hidden='true'><g class='series c{}'>{}{}</g></svg>",
                     index % k_colours,
                     is_line(curve) || curve.trials ? "<path class='line' d='M1 7H25'/>" : "",
                     has_marks(curve) ? marker(index, 13, 7) : "");
}

}  // namespace copse
