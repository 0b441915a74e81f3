#include "tools/treegrow/grow.h"
#include "tools/treegrow/treegrow.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace copse::grow {
namespace {

constexpr double k_off = 0.02;    // how far from the order a plan may be
constexpr double k_near = 0.002;  // near enough to stop trying
constexpr double k_least_scale = 1e-4, k_most_scale = 1e5;

// One number says how rich a tree is: 1 is the species as it comes. Most of the wealth goes into leaves and
// twigs, the rest into finer tubes.
struct Scale {
  double value = 1;
  double twigs() const { return std::pow(value, value < 1 ? 0.5 : 0.45); }
  double branches() const { return value < 1 ? std::pow(value, 0.25) : 1; }  // poor trees miss boughs too
  Detail detail(double segments) const {
    return {std::pow(value, 0.2), std::pow(value, 0.2) * segments, value};
  }
};

class Planner {
 public:
  explicit Planner(const Order& order) : order_(order) {
    growth_.height = order.height;
    growth_.most_nodes = order.most_nodes;
    growth_.trees = order.breaks.has(Break::several_trees) ? 3 : 1;
  }

  Result<Plan> run() {
    attempt({1}, 1);
    if (order_.triangles != 0) search_scale();
    if (too_large())
      return refuse("", order_.species.name + " has too many stems or triangles",
                    "make branches, splits, leaves or segments fewer; --limits shows the limits");
    if (order_.triangles == 0) return std::move(plan_);
    // A trunk can miss the target by the step from one k to the next; its segments come in smaller change.
    const bool leafy = plan_.layout.leaves > 0;
    if (!leafy || static_cast<double>(plan_.layout.trunk_triangles) > 0.95 * wanted()) search_segments();
    if (leafy) share_rest_among_leaves();
    const double off = std::abs(total() / wanted() - 1);
    if (off > k_off)
      return fail(Fault::limit, "",
                  "--triangles " + std::to_string(order_.triangles) + " cannot be met: the nearest " +
                      order_.species.name + " has " +
                      std::to_string(total_triangles(plan_.layout, order_.breaks)),
                  "ask for another number, or for other --break");
    return std::move(plan_);
  }

 private:
  bool grass() const { return order_.species.grass.blades > 0; }
  double total() const {
    return plan_.skeleton.too_large ? 1e18
                                    : static_cast<double>(total_triangles(plan_.layout, order_.breaks));
  }
  double wanted() const { return static_cast<double>(order_.triangles); }

  bool too_large() const {
    return plan_.skeleton.too_large || total_triangles(plan_.layout, order_.breaks) > order_.most_triangles;
  }

  void attempt(Scale scale, double segments) {
    scale_ = scale;
    growth_.twigs = grass() ? scale.value : scale.twigs();
    growth_.branches = scale.branches();
    plan_.skeleton = grow(order_.species, growth_, order_.seed);
    plan_.layout = {};
    if (!plan_.skeleton.too_large)
      plan_.layout = lay_out(order_.species, plan_.skeleton, order_.breaks, scale.detail(segments), -1,
                             order_.most_triangles);
  }

  // Secant steps on log triangles over log scale, kept inside the bracket that has been seen.
  void search_scale() {
    double low = k_least_scale, high = k_most_scale, slope = 1;
    double x = 0, y = std::log(total() / wanted());
    for (int i = 0; i < 24 && std::abs(y) > k_near; ++i) {
      (y < 0 ? low : high) = std::exp(x);
      double next = x - y / slope;
      if (std::exp(next) <= low || std::exp(next) >= high) next = 0.5 * (std::log(low) + std::log(high));
      if (std::abs(next - x) < 1e-6) break;
      attempt({std::exp(next)}, 1);
      const double y_next = std::log(total() / wanted());
      slope = std::clamp((y_next - y) / (next - x), 0.3, 3.0);
      x = next;
      y = y_next;
    }
  }

  // Leaves are small change: with the trunk as it is, their number hits the target.
  void share_rest_among_leaves() {
    const double more =
        total() / static_cast<double>(plan_.layout.trunk_triangles + plan_.layout.leaf_triangles);
    const double rest = wanted() / more - static_cast<double>(plan_.layout.trunk_triangles);
    const double leaves = std::round(std::max(0.0, rest / leaf_form(order_.breaks).triangles));
    plan_.layout = lay_out(order_.species, plan_.skeleton, order_.breaks, scale_.detail(segments_),
                           static_cast<std::int64_t>(leaves));
  }

  // Without leaves, segments are: rounded stem by stem, their number grows smoothly with the factor.
  void search_segments() {
    double low = 0.25, high = 4;
    for (int i = 0; i < 16 && std::abs(total() / wanted() - 1) > k_near && !grass(); ++i) {
      segments_ = std::sqrt(low * high);
      plan_.layout = lay_out(order_.species, plan_.skeleton, order_.breaks, scale_.detail(segments_));
      (total() < wanted() ? low : high) = segments_;
    }
  }

  const Order& order_;
  Growth growth_;
  Scale scale_;
  double segments_ = 1;  // factor on top of the scale's
  Plan plan_;
};

}  // namespace

Result<Plan> make_plan(const Order& order) {
  return Planner(order).run();
}

}  // namespace copse::grow
