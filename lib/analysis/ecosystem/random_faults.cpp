#include "lib/analysis/ecosystem/random_faults.h"

#include <cmath>
#include <vector>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace copse {
namespace {

struct Fault {
  double nx = 1, nz = 0, offset = 0;  // the side where nx x + nz z >= offset rises
  double half = 0;
};

Fault draw(Random random, const DoubleBox& box) {
  Fault f;
  const double x = random.uniform(box.min.x, box.max.x), z = random.uniform(box.min.z, box.max.z);
  double square = 0;
  do {  // a point of the unit disc, not at its centre: every direction is as likely
    f.nx = random.uniform(-1, 1);
    f.nz = random.uniform(-1, 1);
    square = f.nx * f.nx + f.nz * f.nz;
  } while (square > 1 || square < 1e-6);
  const double l = std::sqrt(square);
  f.nx /= l;
  f.nz /= l;
  f.offset = f.nx * x + f.nz * z;
  return f;
}

void smooth_line(std::span<Double3> v, std::size_t first, std::size_t stride, std::size_t count) {
  double before = v[first].y;
  for (std::size_t i = 1; i + 1 < count; ++i) {
    double& here = v[first + i * stride].y;
    const double old = here;
    here = 0.25 * before + 0.5 * here + 0.25 * v[first + (i + 1) * stride].y;
    before = old;
  }
}

}  // namespace

void apply_faults(std::span<Double3> vertices, std::size_t columns, const FaultOptions& options,
                  const Random& random) {
  if (vertices.empty()) return;
  DoubleBox box;
  for (const Double3& v : vertices) box.grow(v);
  std::vector<Fault> faults(options.count);
  for (std::uint32_t i = 0; i < options.count; ++i) {
    faults[i] = draw(random.fork(i), box);
    const double t = options.count > 1 ? static_cast<double>(i) / (options.count - 1) : 0;
    faults[i].half = 0.5 * (options.first + (options.last - options.first) * t);
  }
  const std::size_t rows = vertices.size() / columns;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, rows), [&](const auto& range) {
    for (std::size_t r = range.begin(); r < range.end(); ++r) {
      const auto row = vertices.subspan(r * columns, columns);
      for (const Fault& f : faults)
        for (Double3& v : row) v.y += f.nx * v.x + f.nz * v.z >= f.offset ? f.half : -f.half;
    }
  });
  for (std::uint32_t pass = 0; pass < options.smooth; ++pass) {
    tbb::parallel_for(std::size_t{0}, rows,
                      [&](std::size_t r) { smooth_line(vertices, r * columns, 1, columns); });
    tbb::parallel_for(std::size_t{0}, columns,
                      [&](std::size_t c) { smooth_line(vertices, c, columns, rows); });
  }
}

}  // namespace copse
