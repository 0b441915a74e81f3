#include "tools/bvfit/measured_costs.h"

#include "lib/formats/random.h"
#include "lib/runtime/volume_tests.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <numbers>
#include <vector>

namespace copse::bvfit {
namespace {

constexpr int k_volumes = 1000, k_runs = 12;

Float3 unit_vector(Random& random) {
  const double z = random.around(0, 1), a = random.uniform(0, 2 * std::numbers::pi),
               r = std::sqrt(std::max(0.0, 1 - z * z));
  return to_float(Double3{r * std::cos(a), r * std::sin(a), z});
}

Volume<float> random_volume(VolumeKind kind, Random& random, std::size_t slabs) {
  const auto number = [&] { return static_cast<float>(random.around(0, 5)); };
  const auto size = [&] { return static_cast<float>(random.uniform(0.2, 1)); };
  const Float3 c{number(), number(), number()}, u = unit_vector(random);
  const Float3 v = to_float(normalized(cross(to_double(u), {0.3, 1, 0.1}))), w = cross(u, v);
  const Float3 half{size(), size(), size()};
  switch (kind) {
    case VolumeKind::aabb:
      return FloatBox{c - half, c + half};
    case VolumeKind::sphere:
      return BoundingSphere<float>{c, half.x};
    case VolumeKind::obb:
      return OrientedBox<float>{c, {u, v, w}, half};
    case VolumeKind::capsule:
      return Capsule<float>{c, c + u, half.x};
    case VolumeKind::cylinder:
      return Cylinder<float>{c, c + u, half.x};
    case VolumeKind::lozenge:
      return Lozenge<float>{c, u * half.x, v * half.y, half.z};
    case VolumeKind::ellipsoid:
      return Ellipsoid<float>{c, {u, v, w}, half};
    case VolumeKind::kdop:
      break;
  }
  Kdop<float> k;
  for (std::size_t i = 0; i < slabs; ++i) {
    const Float3 n = i < 3 ? Float3{i == 0 ? 1.0f : 0.0f, i == 1 ? 1.0f : 0.0f, i == 2 ? 1.0f : 0.0f}
                           : unit_vector(random);
    const float at = dot(n, c);
    k.normals.push_back(n), k.min.push_back(at - half.x), k.max.push_back(at + half.x);
  }
  return k;
}

double seconds_of(VolumeKind kind, std::size_t slabs) {
  Random random(1);
  std::vector<Volume<float>> volumes;
  for (int i = 0; i < k_volumes; ++i) volumes.push_back(random_volume(kind, random, slabs));
  std::vector<FloatPlane> planes;
  for (int i = 0; i < 6; ++i) planes.push_back({unit_vector(random), 6});
  double best = std::numeric_limits<double>::infinity();
  std::uint32_t seen = 0;
  for (int run = 0; run < k_runs; ++run) {
    const auto start = std::chrono::steady_clock::now();
    for (const Volume<float>& v : volumes) {
      std::uint32_t mask = 63;
      (void)in_frustum(v, planes, mask);
      seen += mask;
    }
    best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  volatile std::uint32_t sink = seen;  // so that the tests are not left out
  (void)sink;
  return best;
}

}  // namespace

TestCosts measured_costs() {
  TestCosts costs{};
  const double sphere = seconds_of(VolumeKind::sphere, 0);
  for (std::uint32_t k = 0; k < k_volume_kinds; ++k) {
    const auto kind = static_cast<VolumeKind>(k);
    if (kind == VolumeKind::kdop) continue;
    costs.relative[k] = seconds_of(kind, 0) / sphere;
  }
  constexpr std::size_t k_few = 7, k_many = 13;
  const double few = seconds_of(VolumeKind::kdop, k_few) / sphere,
               many = seconds_of(VolumeKind::kdop, k_many) / sphere;
  costs.per_slab = std::max(0.0, (many - few) / (k_many - k_few));
  costs.relative[static_cast<std::size_t>(VolumeKind::kdop)] = std::max(0.0, few - costs.per_slab * k_few);
  return costs;
}

}  // namespace copse::bvfit
