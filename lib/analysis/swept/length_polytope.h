// length_polytope: the least volume of a capsule or lozenge whose lengths satisfy linear inequalities.
//
// The inequalities bound a polytope in the space of (a, b, r), for a capsule of (a, r). The cube root of the
// volume is concave there (Brunn-Minkowski), so the least volume is at a vertex.
//
// Source: outer approximation of a quasi-concave minimisation; Horst and Tuy, "Global Optimization" (1996),
// chapter VI. The vertices are kept; a cut costs the pairs of them.
#pragma once

#include "lib/analysis/swept/swept_shape.h"

#include <cstdint>
#include <vector>

namespace copse {

class LengthPolytope {
 public:
  static constexpr int k_most_cuts = 56;

  // 0 <= a <= most.a and so on; a capsule's b is 0.
  LengthPolytope(Swept kind, const SweptLengths& most);

  // Adds alpha a + beta b + gamma r >= least, coefficients >= 0. False when there have been k_most_cuts cuts
  // already: nothing is changed then, and what is proven stays true.
  bool cut(double alpha, double beta, double gamma, double least);

  bool empty() const { return vertices_.empty(); }
  // The vertex of least volume; not when empty.
  SweptLengths least() const;
  // No more than the volume of any lengths that satisfy the inequalities, rounding included; infinity when
  // there are none.
  double least_volume() const;
  // Whether the n-th cut (from 0) touches that vertex, or any vertex.
  bool supports(int n) const;
  bool supports_least(int n) const;

 private:
  struct Vertex {
    SweptLengths at;
    std::uint64_t on = 0;  // one bit a plane
  };
  const Vertex& least_vertex() const;

  int dimension_;
  int planes_ = 6;
  double size_;
  std::vector<Vertex> vertices_;
};

}  // namespace copse
