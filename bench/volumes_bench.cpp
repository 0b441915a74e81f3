// bench_volumes: bounding volumes of CGAL's data meshes beside CGAL's own box, sphere and principal axes, in
// one process: volumes as ratios to the smallest known (volumes_best.txt), times as CPU time of the thread.
#include "lib/analysis/volumes/bounding_spheres.h"
#include "lib/analysis/volumes/box_search.h"
#include "lib/analysis/volumes/cylinders.h"
#include "lib/analysis/volumes/ellipsoids.h"
#include "lib/analysis/volumes/minimal_box.h"
#include "lib/analysis/volumes/minimal_capsule.h"
#include "lib/analysis/volumes/minimal_lozenge.h"
#include "lib/analysis/volumes/oriented_boxes.h"
#include "lib/analysis/volumes/volume_measures.h"
#include "lib/formats/import/import.h"
#include "lib/formats/random.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Min_sphere_of_points_d_traits_3.h>
#include <CGAL/Min_sphere_of_spheres_d.h>
#include <CGAL/linear_least_squares_fitting_3.h>
#include <CGAL/optimal_bounding_box.h>
#include <fmt/format.h>

namespace copse {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using CgalPoints = std::vector<Kernel::Point_3>;

constexpr const char* k_archive = "/usr/share/doc/libcgal-dev/data.tar.gz";
constexpr int k_repeats = 3;  // the quickest counts

double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

// What `work` returns, and its milliseconds.
template <class Work>
auto timed(Work&& work, double& ms, int repeats = k_repeats) {
  double best = 1e300;
  for (int i = 1;; ++i) {
    const double start = cpu_seconds();
    auto result = work();
    best = std::min(best, 1e3 * (cpu_seconds() - start));
    if (i < repeats) continue;
    ms = best;
    return result;
  }
}

struct Model {
  std::string file;
  std::size_t points = 0;
  double box = 0, sphere = 0, capsule = 0, lozenge = 0;
};

std::vector<Model> models() {
  std::ifstream list(COPSE_SOURCE_DIR "/bench/volumes_best.txt");
  std::vector<Model> found;
  for (std::string line; std::getline(list, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream row(line);
    Model m;
    row >> m.file >> m.points >> m.box >> m.sphere >> m.capsule >> m.lozenge;
    found.push_back(m);
  }
  return found;
}

// A column of the table: ratio to the best known (or a gap), and time, of every model.
struct Column {
  std::vector<double> ratios, times;
  void add(double ratio, double ms) { ratios.push_back(ratio), times.push_back(ms); }
};

class Table {
 public:
  void add(const std::string& name, double ratio, double ms) {
    if (!columns_.contains(name)) order_.push_back(name);
    columns_[name].add(ratio, ms);
  }
  void print() const {
    fmt::print(
        "\n| volume, method | volume / best known, geometric mean | worst | ms, median | ms, most |\n");
    fmt::print("|---|---|---|---|---|\n");
    for (const std::string& name : order_) {
      Column c = columns_.at(name);
      double logs = 0;
      for (const double r : c.ratios) logs += std::log(r);
      std::sort(c.times.begin(), c.times.end());
      fmt::print(
          "| {} | {:.6f} | {:.6f} | {:.3f} | {:.2f} |\n", name, std::exp(logs / double(c.ratios.size())),
          *std::max_element(c.ratios.begin(), c.ratios.end()), c.times[c.times.size() / 2], c.times.back());
    }
  }

 private:
  std::map<std::string, Column> columns_;
  std::vector<std::string> order_;
};

double cgal_box(const CgalPoints& points) {
  std::array<Kernel::Point_3, 8> c;
  CGAL::oriented_bounding_box(points, c);
  const auto l = [&](int i) { return std::sqrt(CGAL::to_double(CGAL::squared_distance(c[0], c[i]))); };
  return l(1) * l(3) * l(5);
}

double cgal_sphere(const CgalPoints& points) {
  using Traits = CGAL::Min_sphere_of_points_d_traits_3<Kernel, double>;
  CGAL::Min_sphere_of_spheres_d<Traits> ball(points.begin(), points.end());
  const double r = ball.radius();
  return 4 * std::numbers::pi / 3 * r * r * r;
}

double cgal_principal_box(const CgalPoints& points, const PointCloud& cloud) {
  Kernel::Line_3 line;
  Kernel::Plane_3 plane;
  CGAL::linear_least_squares_fitting_3(points.begin(), points.end(), line, CGAL::Dimension_tag<0>());
  CGAL::linear_least_squares_fitting_3(points.begin(), points.end(), plane, CGAL::Dimension_tag<0>());
  const auto u = line.to_vector();
  const auto n = plane.orthogonal_vector();
  const Double3 along{u.x(), u.y(), u.z()}, across{n.x(), n.y(), n.z()};
  const OrientedBox<double> box = box_in_axes(cloud.points, axes_along(along, cross(across, along)));
  return cloud.frame.volume_out(measures_of(box).volume);
}

CgalPoints for_cgal(const std::vector<Double3>& points) {
  CgalPoints copies;
  for (const Double3& p : points) copies.emplace_back(p.x, p.y, p.z);
  return copies;
}

void run_model(const Model& model, const std::vector<Double3>& points, Table& table) {
  const PointCloud cloud = make_point_cloud(points).value();
  const CgalPoints copies = for_cgal(points);
  double ms = 0, hull_ms = 0;
  const ConvexHull hull = timed([&] { return convex_hull(make_point_cloud(points).value()); }, hull_ms);
  const auto ratio = [&](const auto& v, double best) {
    return hull.frame.volume_out(measures_of(v).volume) / best;
  };
  std::string line = fmt::format("{:<36}{:>8}{:>6}", model.file, points.size(), hull.vertices.size());
  const auto add = [&](const std::string& name, double r, double t) {
    table.add(name, r, t);
    line += fmt::format("  {:.5f} {:7.2f}", r, t);
  };
  const auto sphere = timed([&] { return smallest_sphere(make_point_cloud(points).value()); }, ms);
  add("sphere, minimal, preparation included", ratio(sphere.fit.volume, model.sphere), ms);
  const double cs = timed([&] { return cgal_sphere(copies); }, ms);
  add("sphere, CGAL Min_sphere_of_spheres_d, double", cs / model.sphere, ms);
  const auto quick = timed([&] { return gaussian_box(cloud); }, ms);
  add("box, gaussian", ratio(quick, model.box), ms);
  const double pca = timed([&] { return cgal_principal_box(copies, cloud); }, ms);
  add("box, CGAL principal axes", pca / model.box, ms);
  const auto box = timed([&] { return minimal_box(hull); }, ms);
  add("box, minimal, hull included", ratio(box.volume, model.box), ms + hull_ms);
  const double cb = timed([&] { return cgal_box(copies); }, ms);
  add("box, CGAL oriented_bounding_box", cb / model.box, ms);
  MinimalBoxOptions exact;
  exact.gap = 0.01;
  const auto proven = timed([&] { return minimal_box(hull, exact); }, ms, 1);
  table.add("box, proven to 1 %: volume / bound", measures_of(proven.volume).volume / proven.lower_bound, ms);
  exact.gap = 1e-4;
  const auto tight = timed([&] { return minimal_box(hull, exact); }, ms, 1);
  table.add("box, proven to 0.01 %: volume / bound", measures_of(tight.volume).volume / tight.lower_bound,
            ms);
  table.add("box, proven to 0.01 %", ratio(tight.volume, model.box), ms);
  const auto capsule = timed([&] { return minimal_capsule(hull); }, ms, 1);
  add("capsule, minimal, after the hull", ratio(capsule.volume, model.capsule), ms);
  const auto lozenge = timed([&] { return minimal_lozenge(hull, capsule.volume); }, ms, 1);
  add("lozenge, minimal, after hull and capsule", ratio(lozenge.volume, model.lozenge), ms);
  const auto cylinder = timed([&] { return minimal_cylinder(hull); }, ms, 1);
  table.add("cylinder, minimal: volume / bound", measures_of(cylinder.volume).volume / cylinder.lower_bound,
            ms);
  const auto ellipsoid = timed([&] { return minimal_ellipsoid(hull); }, ms, 1);
  table.add("ellipsoid, minimal: volume / bound",
            measures_of(ellipsoid.volume).volume / ellipsoid.lower_bound, ms);
  table.add("hull, preparation included (points per corner)",
            double(points.size()) / double(hull.vertices.size()), hull_ms);
  fmt::print("{}\n", line);
}

void run_large(const char* name, const std::vector<Double3>& points) {
  const CgalPoints copies = for_cgal(points);
  double prepare = 0, sphere = 0, hull_ms = 0, box = 0, cs = 0, cb = 0;
  const PointCloud cloud = timed([&] { return make_point_cloud(points).value(); }, prepare);
  const auto ball = timed([&] { return smallest_sphere(cloud); }, sphere);
  const ConvexHull hull = timed([&] { return convex_hull(cloud); }, hull_ms, 1);
  const auto fit = timed([&] { return minimal_box(hull); }, box, 1);
  const double theirs = timed([&] { return cgal_sphere(copies); }, cs);
  const double their_box = timed([&] { return cgal_box(copies); }, cb, 1);
  fmt::print("\n{}: preparation {:.1f} ms; sphere {:.1f} ms (CGAL {:.1f}, ours / theirs {:.12f});\n", name,
             prepare, sphere, cs, hull.frame.volume_out(measures_of(ball.fit.volume).volume) / theirs);
  fmt::print(
      "  hull {:.0f} ms, {} corners of {} kept, loss {:.1e}; box {:.0f} ms; all {:.0f} ms (CGAL {:.0f}, ours "
      "/ theirs {:.6f}), volume / bound {:.4f}\n",
      hull_ms, hull.vertices.size(), hull.boundary.size(), hull.loss, box, prepare + hull_ms + box, cb,
      hull.frame.volume_out(measures_of(fit.volume).volume) / their_box,
      measures_of(fit.volume).volume / fit.lower_bound);
}

std::vector<Double3> gaussian_points(int n) {
  Random random(1);
  std::vector<Double3> points;
  const auto normal = [&] {
    return std::sqrt(-2 * std::log(1 - random.uniform())) * std::cos(2 * std::numbers::pi * random.uniform());
  };
  for (int i = 0; i < n; ++i) {
    const double x = normal(), y = normal(), z = normal();
    points.push_back({x, y, z});
  }
  return points;
}

int run() {
  namespace fs = std::filesystem;
  if (fs::exists(k_archive)) {
    const fs::path folder = fs::temp_directory_path() / "copse-bench-volumes";
    fs::create_directories(folder);
    const std::string command = fmt::format("tar -xzf {} -C {}", k_archive, folder.string());
    if (std::system(command.c_str()) != 0) return 1;
    fmt::print(
        "model, points, corners; then volume / best known and ms of: sphere, CGAL's, gaussian box, CGAL's, "
        "minimal box, CGAL's, capsule, lozenge\n");
    Table table;
    for (const Model& model : models()) {
      const auto mesh = import_mesh(folder / "data" / model.file);
      if (mesh) {
        run_model(model, mesh->mesh.positions, table);
      } else {
        fmt::print("{}: {}\n", model.file, mesh.error().what);
      }
    }
    table.print();
    fs::remove_all(folder);
  } else {
    fmt::print("no reference models: apt-get install libcgal-demo\n");
  }
  run_large("1 000 000 Gaussian points", gaussian_points(1'000'000));
  std::vector<Double3> sphere = gaussian_points(200'000);
  for (Double3& p : sphere) p = normalized(p);
  run_large("200 000 co-spherical points", sphere);
  return 0;
}

}  // namespace
}  // namespace copse

int main() {
  return copse::run();
}
