// arborescence: who grows from whom, when everyone has several possible parents that cost something.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace copse {

// A possible parent of a node.
struct ParentArc {
  std::uint32_t parent = 0;
  double cost = 0;
};

// The cheapest way to give every node one of its possible parents or make it a root, without cycles (Chu and
// Liu 1965, Edmonds 1967: cycles of cheapest parents are contracted to one node and solved again). Node n may
// take arcs[first[n] .. first[n + 1]); being a root costs root_cost[n]. Costs are finite. Returns the arc
// that each node takes, k_none for a root. Of equal choices the first is taken, an arc before the root. Cost:
// linear in the arcs, plus the arcs of contracted nodes once for every contraction round them.
std::vector<std::uint32_t> cheapest_arborescence(std::span<const std::uint32_t> first,
                                                 std::span<const ParentArc> arcs,
                                                 std::span<const double> root_cost);

}  // namespace copse
