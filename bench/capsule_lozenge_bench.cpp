// Capsules and lozenges around the data meshes of CGAL: volume over the best known, proven gap, time after
// the hull.
//
//   bench_capsule_lozenge [--gap G] [--seconds S]      defaults 0.02, 10
//
// The quick ways are those of the libraries that fit these volumes: least squares as in Geometric Tools'
// ContCapsule3, the Gaussian frame with moved corners as in FCL's RSS. Times are of the CPU.
#include "lib/analysis/volumes/capsule.h"
#include "lib/analysis/volumes/lozenge.h"
#include "lib/analysis/volumes/minimal_capsule.h"
#include "lib/analysis/volumes/minimal_lozenge.h"
#include "tests/volumes/reference_models.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <ctime>

namespace {

using namespace copse;

struct Measured {
  double volume = 0, milliseconds = 0, bound = 0;
};

double milliseconds() {
  timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
}

template <class Fit>
Measured measured(Fit&& fit) {
  const double start = milliseconds();
  const auto found = fit();
  const double end = milliseconds();
  return {interior_volume(found.volume), end - start, found.lower_bound};
}

class Column {
 public:
  void add(const Measured& m, double best) {
    excess_.push_back(m.volume / best), times_.push_back(m.milliseconds);
    if (m.bound > 0) gaps_.push_back(m.volume / m.bound - 1);
  }
  void print(const char* name) {
    double sum = 0;
    for (const double e : excess_) sum += std::log(e);
    std::sort(times_.begin(), times_.end());
    std::printf("%-26s %10.6f %10.6f %10.3f %10.3f", name,
                std::exp(sum / static_cast<double>(excess_.size())),
                *std::max_element(excess_.begin(), excess_.end()), times_[times_.size() / 2], times_.back());
    if (!gaps_.empty()) std::printf(" %9.3f %%", 100 * *std::max_element(gaps_.begin(), gaps_.end()));
    std::printf("\n");
  }

 private:
  std::vector<double> excess_, times_, gaps_;
};

}  // namespace

int main(int argc, char** argv) {
  SweptBoundOptions proof;
  proof.gap = 0.02, proof.seconds = 10;
  for (int i = 1; i + 1 < argc; i += 2) {
    (std::strcmp(argv[i], "--gap") == 0 ? proof.gap : proof.seconds) = std::strtod(argv[i + 1], nullptr);
  }
  if (reference_folder().empty()) {
    std::printf("the reference models are in Debian's libcgal-demo, which is not installed\n");
    return 0;
  }
  std::array<Column, 7> columns;
  std::printf("%-26s %5s | %9s %9s %9s %8s | %9s %9s %8s | proven within, ms: capsule, lozenge\n",
              "volume / best known", "hull", "l.squares", "circle", "minimal", "ms", "gaussian", "minimal",
              "ms");
  for (const ReferenceModel& model : k_reference_models) {
    const std::vector<Double3> points = reference_points(model.name);
    const auto cloud = make_point_cloud(points);
    if (!cloud) continue;
    const ConvexHull hull = convex_hull(*cloud);
    const double unit = std::pow(hull.frame.scale, 3), capsule = model.capsule / unit,
                 lozenge = model.lozenge / unit;
    const std::span<const Double3> v = hull.vertices;
    const BoundedFit<Capsule<double>> known = minimal_capsule(hull);
    using C = BoundedFit<Capsule<double>>;
    using L = BoundedFit<Lozenge<double>>;
    const std::array<Measured, 7> m{measured([&] {
                                      return C{least_squares_capsule(v), 0};
                                    }),
                                    measured([&] {
                                      return C{projected_circle_capsule(v), 0};
                                    }),
                                    measured([&] { return minimal_capsule(hull); }),
                                    measured([&] { return minimal_capsule(hull, proof); }),
                                    measured([&] {
                                      return L{gaussian_lozenge(v), 0};
                                    }),
                                    measured([&] { return minimal_lozenge(hull, known.volume); }),
                                    measured([&] { return minimal_lozenge(hull, known.volume, proof); })};
    for (std::size_t k = 0; k < m.size(); ++k) columns[k].add(m[k], k < 4 ? capsule : lozenge);
    std::printf("%-26s %5zu | %9.4f %9.4f %9.6f %8.2f | %9.4f %9.6f %8.2f | %.3f %% %.1f, %.3f %% %.1f\n",
                model.name, hull.vertices.size(), m[0].volume / capsule, m[1].volume / capsule,
                m[2].volume / capsule, m[2].milliseconds, m[4].volume / lozenge, m[5].volume / lozenge,
                m[5].milliseconds, 100 * (m[3].volume / m[3].bound - 1), m[3].milliseconds,
                100 * (m[6].volume / m[6].bound - 1), m[6].milliseconds);
  }
  std::printf("\n%-26s %10s %10s %10s %10s %11s\n", "", "geo. mean", "worst", "median ms", "worst ms",
              "worst gap");
  const std::array names{"capsule least squares", "capsule projected circle", "capsule minimal",
                         "capsule proven",        "lozenge gaussian",         "lozenge minimal",
                         "lozenge proven"};
  for (std::size_t k = 0; k < names.size(); ++k) columns[k].print(names[k]);
}
