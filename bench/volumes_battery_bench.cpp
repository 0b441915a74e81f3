// bench_volumes_battery: every method on the degenerate battery of the tests (tests/volumes/point_sets.h),
// judged in exact arithmetic; the table of docs/results/volumes.md. Exits 1 when a point is outside.
#include "lib/analysis/volumes/certify.h"
#include "lib/analysis/volumes/fit_volumes.h"
#include "tests/volumes/point_sets.h"

#include <fmt/format.h>

namespace copse {
namespace {

struct Least {
  double stored = 0, fitted = 0;
};
struct Row {
  std::size_t fitted = 0, beyond_float32 = 0, outside = 0;
  std::array<Least, k_volume_kinds> least{};  // of each kind, by its search
};

// The volume as stored and, where that is more than a thousandth, what float32 has added to the fit.
std::string cell(const Least& v) {
  if (v.stored <= v.fitted * 1.001) return fmt::format("{:.6g}", v.stored);
  if (v.fitted <= v.stored * 1e-4) return fmt::format("{:.6g} (all of it float32's)", v.stored);
  return fmt::format("{:.6g} (float32 +{:.2g} %)", v.stored, 100 * (v.stored / v.fitted - 1));
}

Row fit_all(const VolumeFitter& fitter, const Points& points) {
  Row row;
  for (const FitMethod& method : fit_methods()) {
    const auto v = fitter.fit(method);
    if (!v) {
      ++row.beyond_float32;
      continue;
    }
    ++row.fitted;
    row.outside += certify(v->volume, points).outside;
    if (method.least) row.least[static_cast<std::size_t>(method.kind)] = {v->measures.volume, v->fitted};
  }
  return row;
}

int run() {
  constexpr std::array k_columns{VolumeKind::sphere, VolumeKind::obb, VolumeKind::capsule,
                                 VolumeKind::cylinder, VolumeKind::lozenge};
  fmt::print("| set | points | dimension | volumes | beyond float32 | points outside |");
  for (const VolumeKind kind : k_columns) fmt::print(" {} |", name_of(kind));
  fmt::print("\n|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n");
  std::size_t sets = 0, volumes = 0, outside = 0;
  for (const NamedPoints& set : degenerate_battery()) {
    const auto fitter = VolumeFitter::make(set.points);
    if (!fitter) {
      fmt::print("| {} | {} | refused: {} |\n", set.name, set.points.size(), fitter.error().what);
      continue;
    }
    const Row row = fit_all(*fitter, set.points);
    ++sets, volumes += row.fitted, outside += row.outside;
    fmt::print("| {} | {} | {} | {} | {} | {} |", set.name, set.points.size(), fitter->hull().dimension,
               row.fitted, row.beyond_float32, row.outside);
    for (const VolumeKind kind : k_columns)
      fmt::print(" {} |", cell(row.least[static_cast<std::size_t>(kind)]));
    fmt::print("\n");
  }
  fmt::print("\n{} volumes round {} sets, {} points outside, in exact arithmetic and as stored.\n", volumes,
             sets, outside);
  return outside == 0 ? 0 : 1;
}

}  // namespace
}  // namespace copse

int main() {
  return copse::run();
}
