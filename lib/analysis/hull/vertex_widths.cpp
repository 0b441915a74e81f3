#include "lib/analysis/hull/vertex_widths.h"

#include <algorithm>

namespace copse {
namespace {
constexpr std::size_t k_lanes = 8;
}  // namespace

// A second version for processors with wider vectors, chosen when the program starts. The sanitizers'
// start-up comes after that choice, so they get the plain one.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define COPSE_WIDE __attribute__((target_clones("avx2", "default")))
#else
#define COPSE_WIDE
#endif

VertexWidths::VertexWidths(std::span<const Double3> vertices) : count_(vertices.size()) {
  const std::size_t padded = (count_ + k_lanes - 1) / k_lanes * k_lanes;
  x_.reserve(padded), y_.reserve(padded), z_.reserve(padded);
  for (std::size_t i = 0; i < padded; ++i) {
    const Double3& p = vertices[i < count_ ? i : 0];
    x_.push_back(p.x), y_.push_back(p.y), z_.push_back(p.z);
  }
}

// The same bits for every instruction set: products and sums are not contracted, and minima do not round.
COPSE_WIDE double VertexWidths::along(const Double3& axis) const {
  double low[k_lanes], high[k_lanes];
  const double first = axis.x * x_[0] + axis.y * y_[0] + axis.z * z_[0];
  std::fill(low, low + k_lanes, first);
  std::fill(high, high + k_lanes, first);
  const double *x = x_.data(), *y = y_.data(), *z = z_.data();
  for (std::size_t i = 0; i < x_.size(); i += k_lanes) {
    for (std::size_t k = 0; k < k_lanes; ++k) {
      const double d = axis.x * x[i + k] + axis.y * y[i + k] + axis.z * z[i + k];
      low[k] = d < low[k] ? d : low[k];
      high[k] = d > high[k] ? d : high[k];
    }
  }
  return *std::max_element(high, high + k_lanes) - *std::min_element(low, low + k_lanes);
}

}  // namespace copse
