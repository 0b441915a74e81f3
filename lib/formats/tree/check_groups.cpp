#include "lib/formats/tree/check_parts.h"
#include "lib/formats/tree/check_tolerance.h"
#include "lib/formats/tree/scan.h"
#include "lib/formats/volumes/sphere_contains.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace copse {
namespace {

// Runs one after the other over all leaves, so that with a permutation every leaf is in exactly one group.
bool check_partition(const Check& check) {
  const auto& groups = check.tree.leaves.groups;
  std::uint64_t next = 0;
  bool sound = true;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    if (groups[g].first != next) {
      check.add("LGRP", g, "does not begin where the group before ends",
                [&] { return fmt::format("{}, expected {}", groups[g].first, next); });
      sound = false;
    }
    if (groups[g].count == 0) {
      check.add("LGRP", g, "a group without leaves");
      sound = false;
    }
    next += groups[g].count;
  }
  // A tree without leaf geometry may still say how many leaves a program should invent.
  if (sound && !groups.empty() && check.counts().leaves > 0 && next != check.counts().leaves) {
    check.add("LGRP", Finding::k_no_element, "the groups do not hold every leaf once",
              [&] { return fmt::format("{} of {}", next, check.counts().leaves); });
    sound = false;
  }
  return sound;
}

bool check_permutation(const Check& check) {
  const auto& order = check.tree.leaves.order;
  if (!check.below("LORD", order, check.counts().leaves, "leaves", false)) return false;
  std::vector<bool> seen(check.counts().leaves);
  bool sound = true;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (seen[order[i]]) {
      check.add("LORD", i, "a leaf that is there twice", [&] { return fmt::format("{}", order[i]); });
      sound = false;
    }
    seen[order[i]] = true;
  }
  return sound;
}

bool check_spheres(const Check& check) {
  bool sound = true;
  const auto& groups = check.tree.leaves.groups;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const LeafGroup& group = groups[g];
    if (!is_finite(group.centre) || !std::isfinite(group.radius) || group.radius < 0) {
      check.add("LGRP", g, "the sphere is not finite or its radius negative");
      sound = false;
    }
    if (!std::isfinite(group.mean_area) || group.mean_area < 0) {
      check.add("LGRP", g, "the mean area is not finite or negative",
                [&] { return fmt::format("{}", group.mean_area); });
    }
  }
  return sound;
}

// What the triangles of a leaf say: whether a sphere holds them, and their area.
struct LeafScan {
  const Tree& tree;
  double reach = largest_coordinate(box_of(tree.leaves.vertices));

  bool inside(const LeafGroup& group, std::size_t leaf) const {
    const std::size_t end = tree.first_triangle_of_leaf(leaf + 1);
    for (std::size_t t = tree.first_triangle_of_leaf(leaf); t < end; ++t) {
      for (const std::uint32_t v : tree.leaves.triangles[t].vertex) {
        if (!sphere_contains(group.centre, group.radius, tree.leaves.vertices[v])) return false;
      }
    }
    return true;
  }

  // Alpha coverage counted (erratum E11). Of a leaf whose material is not there it may be anything up to 1.
  Area area(std::size_t leaf) const {
    const Leaves& l = tree.leaves;
    Area sum;
    const std::size_t end = tree.first_triangle_of_leaf(leaf + 1);
    for (std::size_t t = tree.first_triangle_of_leaf(leaf); t < end; ++t) {
      const auto& v = l.triangles[t].vertex;
      sum += triangle_area(to_double(l.vertices[v[0]]), to_double(l.vertices[v[1]]),
                           to_double(l.vertices[v[2]]), reach);
    }
    const std::uint32_t material = l.materials.empty() ? l.material : l.materials[leaf];
    if (material < tree.materials.size()) return double{tree.materials[material].alpha_coverage} * sum;
    sum.less = sum.value;
    return sum;
  }
};

// Leaf after leaf as they are stored, not as the groups name them: memory is read in order. Answers the area
// of all leaves together.
Area check_group_leaves(const Check& check) {
  const LeafScan scan{check.tree};
  const auto& order = check.tree.leaves.order;
  const auto& groups = check.tree.leaves.groups;
  std::vector<std::uint32_t> group_of(order.size());
  for (std::uint32_t g = 0; g < groups.size(); ++g) {
    for (std::uint32_t i = 0; i < groups[g].count; ++i) group_of[order[groups[g].first + i]] = g;
  }
  std::vector<Area> sums(groups.size());
  for (std::size_t leaf = 0; leaf < group_of.size(); ++leaf) {
    const std::uint32_t g = group_of[leaf];
    sums[g] += scan.area(leaf);
    if (scan.inside(groups[g], leaf)) continue;
    check.add("LGRP", g, "a leaf sticks out of its group's sphere",
              [&] { return fmt::format("leaf {}", leaf); });
  }
  Area total;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    total += sums[g];
    if (mean_matches(groups[g].mean_area, 1.0 / groups[g].count * sums[g])) continue;
    check.add("LGRP", g, "the mean area is wrong", [&] {
      return fmt::format("{}, expected {}", groups[g].mean_area, sums[g].value / groups[g].count);
    });
  }
  return total;
}

Area area_of_all(const Check& check) {
  const LeafScan scan{check.tree};
  Area sum;
  for (std::size_t leaf = 0; leaf < check.counts().leaves; ++leaf) sum += scan.area(leaf);
  return sum;
}

void check_mean_leaf_area(const Check& check, const Area& sum) {
  const double n = check.counts().leaves;
  const float mean = check.head.header.mean_leaf_area;
  if (mean_matches(mean, 1 / n * sum)) return;
  check.add("HEAD", Finding::k_no_element, "the mean leaf area is wrong",
            [&] { return fmt::format("{}, expected {}", mean, sum.value / n); });
}

// Nearest to the group's centre first (erratum E10), as far as rounding lets one tell.
void check_group_order(const Check& check) {
  const Leaves& l = check.tree.leaves;
  for (const LeafGroup& group : l.groups) {
    double before = 0;
    for (std::uint32_t i = group.first; i < group.first + group.count; ++i) {
      const Float3& centre = l.centres[l.order[i]];
      const double d = distance(to_double(centre), to_double(group.centre));
      FloatBox ends;
      ends.grow(centre), ends.grow(group.centre);
      if (d < before - length_tolerance(before, largest_coordinate(ends))) {
        check.add("LORD", i, "a leaf nearer to its group's centre than the one before",
                  [&] { return fmt::format("{} after {}", d, before); });
      }
      before = std::max(before, d);
    }
  }
}

}  // namespace

void check_groups(const Check& check, bool leaves_are_sound) {
  const Leaves& l = check.tree.leaves;
  const bool partition = check_partition(check);
  const bool permutation = check_permutation(check);
  const bool spheres = check_spheres(check);
  const bool members = partition && permutation && spheres && !l.groups.empty() && !l.order.empty();
  if (leaves_are_sound) check_mean_leaf_area(check, members ? check_group_leaves(check) : area_of_all(check));
  if (members && !l.centres.empty() && check.head.header.leaf_order == LeafOrder::group) {
    check_group_order(check);
  }
}

}  // namespace copse
