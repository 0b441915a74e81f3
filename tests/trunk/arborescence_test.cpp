#include "lib/analysis/trunk/arborescence.h"

#include "lib/formats/material.h"

#include <limits>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace copse {
namespace {

struct Problem {
  std::vector<std::uint32_t> first{0};
  std::vector<ParentArc> arcs;
  std::vector<double> root_cost;

  void node(double as_root, std::vector<ParentArc> parents) {
    root_cost.push_back(as_root);
    arcs.insert(arcs.end(), parents.begin(), parents.end());
    first.push_back(static_cast<std::uint32_t>(arcs.size()));
  }
  std::vector<std::uint32_t> solve() const { return cheapest_arborescence(first, arcs, root_cost); }
};

// The cost of a choice; infinite when it has a cycle.
double cost_of(const Problem& p, const std::vector<std::uint32_t>& choice) {
  double cost = 0;
  for (std::uint32_t n = 0; n < choice.size(); ++n) {
    cost += choice[n] == k_none ? p.root_cost[n] : p.arcs[choice[n]].cost;
    std::uint32_t at = n;
    for (std::size_t steps = 0; choice[at] != k_none; ++steps) {
      if (steps > choice.size()) return std::numeric_limits<double>::infinity();
      at = p.arcs[choice[at]].parent;
    }
  }
  return cost;
}

TEST(Arborescence, OfNothingIsNothing) {
  EXPECT_TRUE(Problem{}.solve().empty());
}

TEST(Arborescence, TakesTheCheapestParentWhereThereIsNoCycle) {
  Problem p;
  p.node(1, {});
  p.node(9, {{0, 5}, {2, 4}});
  p.node(9, {{0, 3}});
  EXPECT_EQ(p.solve(), (std::vector<std::uint32_t>{k_none, 1, 2}));
}

TEST(Arborescence, BreaksACycleWhereItIsCheapestInAll) {
  // A trunk whose base lies in its branches, as theirs lie in it: cutting the branches loose one by one would
  // seem cheap at every step and cost more in the end.
  Problem p;
  p.node(30, {{1, 12}, {2, 12.5}});
  p.node(30, {{0, 0}, {2, 15}});
  p.node(30, {{0, 0}, {1, 15}});
  EXPECT_EQ(p.solve(), (std::vector<std::uint32_t>{k_none, 2, 4}));
}

TEST(Arborescence, SolvesAHundredThousandNestedCyclesWithoutRecursion) {
  Problem p;
  const std::uint32_t n = 100000;
  for (std::uint32_t i = 0; i < n; ++i) {
    std::vector<ParentArc> parents;
    if (i > 0) parents.push_back({i - 1, 1});
    if (i + 1 < n) parents.push_back({i + 1, 0.5});
    p.node(10, parents);
  }
  const auto choice = p.solve();
  std::size_t roots = 0;
  for (const std::uint32_t c : choice) roots += c == k_none;
  EXPECT_EQ(roots, 1u);
  EXPECT_EQ(choice.back(), k_none);
}

RC_GTEST_PROP(Arborescence, CostsNoMoreThanAnyOtherChoice, ()) {
  const auto n = *rc::gen::inRange<std::uint32_t>(1, 6);
  Problem p;
  for (std::uint32_t i = 0; i < n; ++i) {
    std::vector<ParentArc> parents;
    for (std::uint32_t j = 0; j < n; ++j) {
      if (j != i && *rc::gen::inRange(0, 3) > 0) {
        parents.push_back({j, static_cast<double>(*rc::gen::inRange(0, 20))});
      }
    }
    p.node(*rc::gen::inRange(0, 40), parents);
  }
  std::vector<std::uint32_t> choice(n);
  double best = std::numeric_limits<double>::infinity();
  std::vector<std::uint32_t> digit(n, 0);
  for (bool more = true; more;) {
    for (std::uint32_t i = 0; i < n; ++i) {
      choice[i] = digit[i] == p.first[i + 1] - p.first[i] ? k_none : p.first[i] + digit[i];
    }
    best = std::min(best, cost_of(p, choice));
    more = false;
    for (std::uint32_t i = 0; i < n && !more; ++i) {
      more = digit[i] < p.first[i + 1] - p.first[i];
      digit[i] = more ? digit[i] + 1 : 0;
    }
  }
  RC_ASSERT(cost_of(p, p.solve()) == best);
}

}  // namespace
}  // namespace copse
