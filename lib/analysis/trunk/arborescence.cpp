#include "lib/analysis/trunk/arborescence.h"

#include "lib/formats/material.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace copse {
namespace {

// Arcs 0 .. arcs - 1 are the caller's; arc arcs + n makes node n a root.
class Solver {
 public:
  Solver(std::span<const std::uint32_t> first, std::span<const ParentArc> arcs,
         std::span<const double> root_cost)
      : first_(first), arcs_(arcs), root_cost_(root_cost), nodes_(root_cost.size()) {
    heads_.resize(arcs.size());
    for (std::uint32_t n = 0; n < nodes_; ++n) {
      std::fill(heads_.begin() + first[n], heads_.begin() + first[n + 1], n);
    }
    top_.resize(nodes_);
    std::iota(top_.begin(), top_.end(), 0u);
    outer_.assign(nodes_, k_none);
    taken_.assign(nodes_, k_none);
    state_.assign(nodes_, unseen);
    in_.resize(nodes_);
  }

  std::vector<std::uint32_t> run() {
    for (std::uint32_t n = 0; n < nodes_; ++n) {
      std::vector<std::uint32_t> path;
      std::uint32_t at = top(n);
      while (at != k_none && state_[at] != done) {
        if (state_[at] == on_path) {
          at = contract(path, at);
        }
        take_cheapest(at);
        state_[at] = on_path;
        path.push_back(at);
        at = parent_of_arc(taken_[at]);
      }
      for (const std::uint32_t p : path) state_[p] = done;
    }
    expand();
    for (std::uint32_t& arc : taken_) {
      if (arc >= arcs_.size()) arc = k_none;
    }
    taken_.resize(nodes_);
    return std::move(taken_);
  }

 private:
  enum State : std::uint8_t { unseen, on_path, done };
  struct Incoming {
    std::uint32_t arc;
    double cost;  // less what has been paid inside contracted nodes
  };

  std::uint32_t top(std::uint32_t node) {
    while (top_[node] != node) node = top_[node] = top_[top_[node]];
    return node;
  }
  std::uint32_t head(std::uint32_t arc) const {
    return arc < arcs_.size() ? heads_[arc] : arc - static_cast<std::uint32_t>(arcs_.size());
  }
  std::uint32_t parent_of_arc(std::uint32_t arc) {
    return arc < arcs_.size() ? top(arcs_[arc].parent) : k_none;
  }

  void take_cheapest(std::uint32_t node) {
    std::vector<Incoming>& in = in_[node];
    if (node < nodes_) {  // gathered when first needed
      for (std::uint32_t a = first_[node]; a < first_[node + 1]; ++a) in.push_back({a, arcs_[a].cost});
      in.push_back({static_cast<std::uint32_t>(arcs_.size()) + node, root_cost_[node]});
    }
    std::erase_if(in, [&](const Incoming& i) { return parent_of_arc(i.arc) == node; });
    const auto cheapest = std::ranges::min_element(in, [](const Incoming& a, const Incoming& b) {
      return std::pair(a.cost, a.arc) < std::pair(b.cost, b.arc);
    });
    taken_[node] = cheapest->arc;
    const double paid = cheapest->cost;
    for (Incoming& i : in) i.cost -= paid;
  }

  // Makes one node of the end of the path from `first` on, and takes it off the path.
  std::uint32_t contract(std::vector<std::uint32_t>& path, std::uint32_t first) {
    const auto super = static_cast<std::uint32_t>(top_.size());
    top_.push_back(super);
    outer_.push_back(k_none);
    taken_.push_back(k_none);
    state_.push_back(unseen);
    std::vector<Incoming> all;
    while (true) {
      const std::uint32_t member = path.back();
      path.pop_back();
      top_[member] = super;
      outer_[member] = super;
      std::vector<Incoming> in = std::exchange(in_[member], {});
      if (in.size() > all.size()) std::swap(in, all);
      all.insert(all.end(), in.begin(), in.end());
      if (member == first) break;
    }
    in_.push_back(std::move(all));
    return super;
  }

  // A contracted node enters its cycle at one member, which gives up its place in the cycle.
  void expand() {
    for (auto super = static_cast<std::uint32_t>(taken_.size()); super-- > nodes_;) {
      const std::uint32_t arc = taken_[super];
      std::uint32_t member = head(arc);
      while (outer_[member] != super) member = outer_[member];
      taken_[member] = arc;
    }
  }

  std::span<const std::uint32_t> first_;
  std::span<const ParentArc> arcs_;
  std::span<const double> root_cost_;
  std::size_t nodes_;
  std::vector<std::uint32_t> heads_;        // of the caller's arcs
  std::vector<std::uint32_t> top_, outer_;  // the outermost and the next contracted node round a node
  std::vector<std::uint32_t> taken_;        // arc
  std::vector<std::uint8_t> state_;
  std::vector<std::vector<Incoming>> in_;
};

}  // namespace

std::vector<std::uint32_t> cheapest_arborescence(std::span<const std::uint32_t> first,
                                                 std::span<const ParentArc> arcs,
                                                 std::span<const double> root_cost) {
  return Solver(first, arcs, root_cost).run();
}

}  // namespace copse
