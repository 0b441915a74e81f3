#include "lib/formats/tree/check_parts.h"
#include "lib/formats/tree/check_tolerance.h"
#include "lib/formats/volumes/sphere_contains.h"

#include <cmath>

#include <fmt/format.h>

namespace copse {
namespace {

constexpr std::uint32_t k_known_flags = Radius::terminal | Radius::joint;

// Links only: enough to follow children and groups without a further test.
class Links {
 public:
  explicit Links(const Check& check) : check_(check), next_(check.head.header.roots) {}

  bool radius(std::size_t i, const Radius& r) {
    if (r.flags & ~k_known_flags) {
      return bad(i, "unknown flags", [&] { return fmt::format("{:#x}", r.flags); });
    }
    if (r.flags & Radius::terminal) return terminal(i, r);
    if (r.child_count == 0) return bad(i, "neither children nor terminal");
    // Breadth first: the children of one radius follow those of the one before.
    if (r.first_child != next_) {
      return bad(i, "children out of breadth-first order",
                 [&] { return fmt::format("{}, expected {}", r.first_child, next_); });
    }
    if (r.first_child <= i) {
      return bad(i, "children before their parent", [&] { return fmt::format("{}", r.first_child); });
    }
    if (r.child_count > check_.counts().radii - next_) {
      return bad(i, "children out of range", [&] {
        return fmt::format("{} from {} of {}", r.child_count, r.first_child, check_.counts().radii);
      });
    }
    next_ += r.child_count;
    return true;
  }

  bool finish() {
    if (next_ == check_.counts().radii) return true;
    return bad(next_, "a radius that hangs on nothing",
               [&] { return fmt::format("{} of {} are reached", next_, check_.counts().radii); });
  }

 private:
  template <class... Detail>
  bool bad(std::size_t i, std::string_view kind, Detail&&... detail) {
    check_.add("RADI", i, kind, std::forward<Detail>(detail)...);
    return false;
  }
  bool terminal(std::size_t i, const Radius& r) {
    if (r.child_count > 1) {
      return bad(i, "a terminal radius with several groups",
                 [&] { return fmt::format("{}", r.child_count); });
    }
    if (r.child_count == 0 && r.first_child != k_none) {
      return bad(i, "a terminal radius names a group that it does not have");
    }
    if (r.child_count == 1 && r.first_child >= check_.counts().groups) {
      return bad(i, "leaf group out of range",
                 [&] { return fmt::format("{} of {}", r.first_child, check_.counts().groups); });
    }
    return true;
  }

  const Check& check_;
  std::uint32_t next_;  // the radius that the next child must be
};

bool check_links(const Check& check) {
  const std::uint32_t roots = check.head.header.roots, radii = check.counts().radii;
  if (roots > radii || (roots == 0 && radii > 0)) {
    check.add("HEAD", Finding::k_no_element, "roots out of range",
              [&] { return fmt::format("{} of {} radii", roots, radii); });
    return false;
  }
  Links links(check);
  for (std::size_t i = 0; i < radii; ++i) {
    // After one bad link every later one is off: the first is what to report.
    if (!links.radius(i, check.tree.hierarchy.radii[i])) return false;
  }
  return radii == 0 || links.finish();
}

bool check_numbers(const Check& check) {
  bool sound = true;
  const auto& radii = check.tree.hierarchy.radii;
  for (std::size_t i = 0; i < radii.size(); ++i) {
    const Radius& r = radii[i];
    const bool finite = is_finite(r.centre) && std::isfinite(r.diameter) && std::isfinite(r.outer_radius) &&
                        std::isfinite(r.distance);
    if (!finite || r.diameter < 0 || r.outer_radius < 0 || r.distance < 0) {
      check.add("RADI", i, "not finite or negative");
      sound = false;
    }
  }
  return sound;
}

void check_distances(const Check& check) {
  const auto& radii = check.tree.hierarchy.radii;
  const double reach = largest_coordinate(check.head.header.bounds);
  for (std::size_t i = 0; i < radii.size(); ++i) {
    const double wanted = i < check.head.header.roots ? 0 : length(to_double(radii[i].centre));
    const double tolerance = i < check.head.header.roots ? 0 : length_tolerance(wanted, reach);
    if (std::abs(radii[i].distance - wanted) <= tolerance) continue;
    check.add("RADI", i, "the distance is not the length of the vector from the parent",
              [&] { return fmt::format("{}, expected {}", radii[i].distance, wanted); });
  }
}

void check_monotone(const Check& check) {
  const auto& radii = check.tree.hierarchy.radii;
  bool monotone = !radii.empty();
  for (const Radius& r : radii) {
    if (r.flags & Radius::terminal) continue;
    for (std::uint32_t c = 0; c < r.child_count; ++c) {
      monotone &= radii[r.first_child + c].diameter <= r.diameter;
    }
  }
  if (monotone == check.head.header.monotone) return;
  check.add("HEAD", Finding::k_no_element, "the flag monotone is wrong",
            monotone ? "no child is thicker than its parent"
                     : "a child is thicker than its parent, or there are no radii");
}

void check_outer_radii(const Check& check) {
  const Tree& tree = check.tree;
  for (std::size_t r = 0; r < tree.radius_count(); ++r) {
    const std::size_t end = tree.first_vector_of(r + 1);
    for (std::size_t v = tree.first_vector_of(r); v < end; ++v) {
      if (sphere_contains({}, tree.hierarchy.radii[r].outer_radius, tree.hierarchy.vectors[v])) continue;
      check.add("RADI", r, "a vertex is farther away than the outer radius",
                [&] { return fmt::format("vector {}", v); });
      break;
    }
  }
}

}  // namespace

bool check_hierarchy(const Check& check) {
  if (!check.sensitive()) return true;
  const Tree& tree = check.tree;
  const RadiusHierarchy& h = tree.hierarchy;
  const bool vectors = check.finite("RVEC", h.vectors);
  const bool offsets = check.offsets("RFIR", h.first_vector, check.counts().trunk_vertices);
  if (h.radii.empty()) {  // none, or not loaded
    if (check.counts().radii == 0) check_monotone(check);
    return check.counts().radii == 0 && vectors && offsets;
  }
  const bool links = check_links(check);
  const bool numbers = check_numbers(check);
  if (links && numbers) check_distances(check), check_monotone(check);
  const bool loaded = h.vectors.size() == check.counts().trunk_vertices &&
                      (check.head.header.ring_size != 0 || !h.first_vector.empty() || h.vectors.empty());
  if (numbers && vectors && offsets && loaded) check_outer_radii(check);
  return links && numbers && vectors && offsets;
}

}  // namespace copse
