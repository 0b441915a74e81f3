#include "tests/trunk/exactness.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>
#include <zlib.h>

namespace copse {
namespace {

// Indices of points, by x, to find what is near.
class Nearby {
 public:
  explicit Nearby(std::vector<Double3> points) : points_(std::move(points)) {
    for (std::uint32_t i = 0; i < points_.size(); ++i) order_.push_back(i);
    std::ranges::sort(order_, {}, [&](std::uint32_t i) { return points_[i].x; });
  }
  std::vector<std::uint32_t> within(const Double3& p, double reach) const {
    std::vector<std::uint32_t> found;
    auto at =
        std::ranges::lower_bound(order_, p.x - reach, {}, [&](std::uint32_t i) { return points_[i].x; });
    for (; at != order_.end() && points_[*at].x <= p.x + reach; ++at) {
      if (distance(points_[*at], p) <= reach) found.push_back(*at);
    }
    return found;
  }

 private:
  std::vector<Double3> points_;
  std::vector<std::uint32_t> order_;
};

template <class T>
std::vector<Double3> centres(const std::vector<T>& radii) {
  std::vector<Double3> result;
  for (const T& r : radii) result.push_back(r.centre);
  return result;
}

bool same_diameter(double a, double b) {
  return std::abs(a - b) <= 1e-3 * std::max(a, b);
}

std::string name(const char* what, std::size_t ring, const Double3& c) {
  return std::string(what) + " " + std::to_string(ring) + " at " + std::to_string(c.x) + " " +
         std::to_string(c.y) + " " + std::to_string(c.z);
}

}  // namespace

Exactness measure(const TrueHierarchy& truth, const Hierarchy& found) {
  const double reach = 1e-4 * truth.height;
  const Nearby near(centres(found.radii));
  const Nearby true_near(centres(truth.radii));
  Exactness e;
  const auto fault = [&](const std::string& what) {
    if (e.first_fault.empty()) e.first_fault = what;
  };
  // Radii of one place that a parent may be: the ring itself and its copies.
  const auto is_at = [&](std::uint32_t r, std::uint32_t true_ring) {
    return r != k_none && distance(found.radii[r].centre, truth.radii[true_ring].centre) <= 2 * reach;
  };
  // A branch that starts on a ring of its parent, and as thick as it: nobody can tell the two rings apart.
  const auto lies_on_parent = [&](std::uint32_t t) {
    return std::ranges::any_of(truth.radii[t].parents, [&](std::uint32_t p) {
      return distance(truth.radii[t].centre, truth.radii[p].centre) <= 2e-6 * truth.height &&
             std::abs(truth.radii[t].diameter - truth.radii[p].diameter) <= 0.01 * truth.radii[p].diameter;
    });
  };
  for (std::uint32_t t = 0; t < truth.radii.size(); ++t) {
    const TrueRadius& ring = truth.radii[t];
    e.true_roots += ring.parents.empty();
    if (ring.tip || ring.same_as != k_none || lies_on_parent(t)) continue;
    ++e.rings;
    bool is_found = false, parent_right = false;
    for (const std::uint32_t r : near.within(ring.centre, reach)) {
      if (!same_diameter(found.radii[r].diameter, ring.diameter)) continue;
      is_found = true;
      const std::uint32_t parent = found.radii[r].parent;
      parent_right |= ring.parents.empty() && parent == k_none;
      for (const std::uint32_t p : ring.parents) parent_right |= is_at(parent, p);
    }
    e.found += is_found;
    e.parents_right += parent_right;
    if (!is_found) fault(name("not found: ring", t, ring.centre));
    if (is_found && !parent_right) fault(name("wrong parent: ring", t, ring.centre));
  }
  for (std::size_t r = 0; r < found.radii.size(); ++r) {
    const RadiusNode& node = found.radii[r];
    e.roots += node.parent == k_none;
    const auto at = true_near.within(node.centre, reach);
    const bool is_true = std::ranges::any_of(at, [&](std::uint32_t t) {
      return truth.radii[t].tip || same_diameter(truth.radii[t].diameter, node.diameter);
    });
    if (is_true || node.source == RadiusSource::point) continue;
    ++e.extra;
    fault(name("in no truth: radius", r, node.centre));
  }
  if (e.roots != e.true_roots) fault(std::to_string(e.roots) + " roots for " + std::to_string(e.true_roots));
  return e;
}

std::optional<TrueHierarchy> read_truth(const std::filesystem::path& file) {
  gzFile in = gzopen(file.c_str(), "rb");
  if (in == nullptr) return std::nullopt;
  std::string text;
  char block[1 << 16];
  for (int n = gzread(in, block, sizeof block); n > 0; n = gzread(in, block, sizeof block)) {
    text.append(block, static_cast<std::size_t>(n));
  }
  gzclose(in);
  const nlohmann::json json = nlohmann::json::parse(text, nullptr, false);
  if (json.is_discarded() || !json.contains("radii")) return std::nullopt;
  TrueHierarchy truth;
  truth.height = json["height"];
  for (const auto& r : json["radii"]) {
    TrueRadius& ring = truth.radii.emplace_back();
    ring.centre = {r["center"][0], r["center"][1], r["center"][2]};
    ring.diameter = r["diameter"];
    ring.tip = r.value("tip", 0) != 0;
    if (r.contains("same_as") && r["same_as"].is_number()) ring.same_as = r["same_as"];
    if (r["parent"] >= 0) ring.parents.push_back(r["parent"]);
  }
  for (const auto& b : json["branches"]) {
    if (!b["attach"].is_array()) continue;
    TrueRadius& ring = truth.radii[b["first"].get<std::size_t>()];
    ring.parents.insert(ring.parents.end(), b["attach"].begin(), b["attach"].end());
  }
  return truth;
}

}  // namespace copse
