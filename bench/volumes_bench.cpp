// bench_volumes: bounding volumes beside those of CGAL and FCL, in one process, on every model that is to be
// had (volumes_models.h): volumes as ratios to the smallest known, CPU times of the one thread, peers in turn
// with ours. What it prints is docs/results/volumes.md.
#include "bench/volumes_models.h"
#include "bench/volumes_peers.h"
#include "lib/analysis/boxes/minimal_box.h"
#include "lib/analysis/boxes/oriented_boxes.h"
#include "lib/analysis/round/bounding_spheres.h"
#include "lib/analysis/round/cylinders.h"
#include "lib/analysis/round/ellipsoids.h"
#include "lib/analysis/swept/capsule.h"
#include "lib/analysis/swept/lozenge.h"
#include "lib/analysis/swept/minimal_capsule.h"
#include "lib/analysis/swept/minimal_lozenge.h"
#include "lib/analysis/volumes/certify.h"
#include "lib/analysis/volumes/fit_volumes.h"
#include "lib/formats/import/import.h"
#include "lib/formats/random.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace copse {
namespace {

double cpu_ms() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values.empty() ? 0 : values[values.size() / 2];
}

// A way to a volume: what it fits is compared with the best of its kind, or with its own proven bound.
struct Fitted {
  double volume = 0, bound = 0;
};
struct Way {
  std::string name;
  std::string kind;  // whose best it is compared with; empty: its bound
  std::string peer;  // the way whose time it is compared with, or none
  std::function<Fitted()> fit;
};

struct Measured {
  std::string model;
  double volume = 0, bound = 0, ms = 0;
};

// All that was measured, by way.
class Results {
 public:
  // The ways in turn, `repeats` times; the medians count.
  void run(const std::string& model, const std::vector<Way>& ways, int repeats) {
    std::vector<std::vector<double>> times(ways.size());
    std::vector<Fitted> fitted(ways.size());
    for (int r = 0; r < repeats; ++r) {
      for (std::size_t w = 0; w < ways.size(); ++w) {
        const double start = cpu_ms();
        fitted[w] = ways[w].fit();
        times[w].push_back(cpu_ms() - start);
      }
    }
    for (std::size_t w = 0; w < ways.size(); ++w) {
      if (!of_.contains(ways[w].name)) order_.push_back(ways[w]), order_.back().fit = {};
      of_[ways[w].name].push_back({model, fitted[w].volume, fitted[w].bound, median(times[w])});
      if (!ways[w].kind.empty()) know(model, ways[w].kind, fitted[w].volume);
    }
  }
  void know(const std::string& model, const std::string& kind, double volume) {
    if (!(volume > 0)) return;
    double& best = best_.try_emplace({model, kind}, volume).first->second;
    best = std::min(best, volume);
  }
  double best(const std::string& model, const std::string& kind) const {
    const auto at = best_.find({model, kind});
    return at == best_.end() ? 0 : at->second;
  }

  void print() const {
    fmt::print(
        "| volume, method | models | volume / best, geometric mean | worst | ms, median | most | time / "
        "peer's, median |\n");
    fmt::print("|---|---:|---:|---|---:|---:|---:|\n");
    for (const Way& way : order_) print(way);
  }
  double ratio(const Way& way, const Measured& m) const {
    const double by = way.kind.empty() ? m.bound : best(m.model, way.kind);
    return by > 0 && m.volume > 0 ? m.volume / by : 0;
  }
  const std::vector<Way>& order() const { return order_; }
  const Measured* of(const std::string& way, const std::string& model) const {
    const auto at = of_.find(way);
    if (at == of_.end()) return nullptr;
    for (const Measured& m : at->second) {
      if (m.model == model) return &m;
    }
    return nullptr;
  }

 private:
  void print(const Way& way) const {
    double logs = 0, worst = 0, most = 0;
    std::string worst_model;
    std::size_t counted = 0;
    std::vector<double> times, ratios;
    for (const Measured& m : of_.at(way.name)) {
      times.push_back(m.ms), most = std::max(most, m.ms);
      if (const Measured* peer = of(way.peer, m.model); peer != nullptr) ratios.push_back(m.ms / peer->ms);
      const double r = ratio(way, m);
      if (r == 0) continue;
      ++counted, logs += std::log(r);
      if (r > worst) worst = r, worst_model = m.model;
    }
    const std::string quality = counted == 0
                                    ? "|"
                                    : fmt::format("{:.6f} | {:.6f} {}", std::exp(logs / double(counted)),
                                                  worst, worst > 1.0000005 ? worst_model : "");
    fmt::print("| {} | {} | {} | {:.3f} | {:.1f} | {} |\n", way.name, times.size(), quality, median(times),
               most, ratios.empty() ? "" : fmt::format("{:.2f}", median(ratios)));
  }

  std::vector<Way> order_;
  std::map<std::string, std::vector<Measured>> of_;
  std::map<std::pair<std::string, std::string>, double> best_;
};

// Volumes that leave points outside, as certify finds them on the very numbers.
struct Judged {
  std::size_t volumes = 0, leaky = 0, points = 0;
  double worst = 0;  // how far out, of the size
  void add(const Volume<double>& v, std::span<const Double3> p, double size) {
    const Certificate c = certify(v, p);
    ++volumes, points += c.outside;
    if (!c.holds()) ++leaky, worst = std::max(worst, c.excess / size);
  }
  void print(const char* who) const {
    fmt::print("| {} | {} | {} | {} | {} |\n", who, volumes, leaky, points,
               leaky ? fmt::format("{:.1e}", worst) : "0");
  }
};

struct Bench {
  Results results;
  Judged ours, cgal_spheres, fcl_boxes, fcl_lozenges;
  std::map<std::string, std::array<std::size_t, 2>> sizes;  // points, corners of the hull
};

double volume_of(const Volume<double>& v, const PointFrame& frame = {}) {
  return frame.volume_out(measures_of(v).volume);
}
template <class V>
Fitted out(const V& fit, const PointFrame& frame) {
  return {volume_of(fit.volume, frame), frame.volume_out(fit.lower_bound)};
}

std::vector<Way> quick_ways(const std::vector<Double3>& points, const PointCloud& cloud, const CgalPeer& cgal,
                            const FclPeer& fcl) {
  const PointFrame& frame = cloud.frame;
  const auto plain = [&](const Volume<double>& v) { return Fitted{volume_of(v, frame), 0}; };
  std::vector<Way> ways{
      {"preparation (checked, framed, copied)", "", "",
       [&] {
         return Fitted{make_point_cloud(points).value().frame.scale, 0};
       }},
      {"sphere, minimal, with preparation", "sphere", "sphere, CGAL Min_sphere_of_spheres_d (double)",
       [&] {
         const PointCloud own = make_point_cloud(points).value();
         return Fitted{volume_of(smallest_sphere(own).fit.volume, own.frame), 0};
       }},
      {"sphere, CGAL Min_sphere_of_spheres_d (double)", "sphere", "",
       [&] {
         return Fitted{volume_of(cgal.sphere()), 0};
       }},
      {"sphere, Ritter", "sphere", "", [&, plain] { return plain(extremal_sphere(cloud)); }},
      {"box, Gaussian", "box", "box, CGAL principal axes", [&, plain] { return plain(gaussian_box(cloud)); }},
      {"box, CGAL principal axes", "box", "",
       [&] {
         return Fitted{volume_of(cgal.principal_box()), 0};
       }},
      {"capsule, least squares (as Geometric Tools)", "capsule", "",
       [&, plain] { return plain(least_squares_capsule(cloud.points)); }},
      {"lozenge, Gaussian", "lozenge", FclPeer::available ? "lozenge, FCL RSS" : "",
       [&, plain] { return plain(gaussian_lozenge(cloud.points)); }}};
  if (FclPeer::available) {
    ways.push_back({"box, FCL OBB", "box", "", [&] { return Fitted{volume_of(fcl.box()), 0}; }});
    ways.push_back({"lozenge, FCL RSS", "lozenge", "", [&] { return Fitted{volume_of(fcl.lozenge()), 0}; }});
  }
  return ways;
}

std::vector<Way> search_ways(const std::vector<Double3>& points, const CgalPeer& cgal) {
  return {{"hull, with preparation", "", "",
           [&] {
             return Fitted{convex_hull(make_point_cloud(points).value()).volume, 0};
           }},
          {"box, minimal, with hull", "box", "box, CGAL oriented_bounding_box",
           [&] {
             const ConvexHull hull = convex_hull(make_point_cloud(points).value());
             return Fitted{volume_of(minimal_box(hull).volume, hull.frame), 0};
           }},
          {"box, CGAL oriented_bounding_box", "box", "", [&] {
             return Fitted{cgal.box_volume(), 0};
           }}};
}

std::vector<Way> hull_ways(const ConvexHull& hull, const Capsule<double>& capsule) {
  return {{"capsule, projected circle, after the hull", "capsule", "",
           [&] {
             return Fitted{volume_of(projected_circle_capsule(hull.vertices), hull.frame), 0};
           }},
          {"capsule, minimal, after the hull", "capsule", "",
           [&] { return out(minimal_capsule(hull), hull.frame); }},
          {"lozenge, minimal, after hull and capsule", "lozenge", "",
           [&] { return out(minimal_lozenge(hull, capsule), hull.frame); }}};
}

// Proofs: compared with their own bound.
std::vector<Way> proven_ways(const ConvexHull& hull, const Capsule<double>& capsule) {
  const auto box = [&](double gap) { return out(minimal_box(hull, {.gap = gap}), hull.frame); };
  const auto swept = [](double gap) {
    SweptBoundOptions o;
    o.gap = gap;
    return o;
  };
  return {{"box, proven to 1 %", "", "", [&, box] { return box(0.01); }},
          {"box, proven to 0.01 %", "", "", [&, box] { return box(1e-4); }},
          {"capsule, proven to 2 %", "", "",
           [&, swept] { return out(minimal_capsule(hull, swept(0.02)), hull.frame); }},
          {"lozenge, proven to 10 %", "", "",
           [&, swept] { return out(minimal_lozenge(hull, capsule, swept(0.1)), hull.frame); }},
          {"lozenge, proven to 2 %", "", "",
           [&, swept] { return out(minimal_lozenge(hull, capsule, swept(0.02)), hull.frame); }},
          {"cylinder, minimal", "", "", [&] { return out(minimal_cylinder(hull), hull.frame); }},
          {"ellipsoid, minimal", "", "", [&] { return out(minimal_ellipsoid(hull), hull.frame); }}};
}

void judge(const std::vector<Double3>& points, const CgalPeer& cgal, const FclPeer& fcl, double size,
           Bench& bench) {
  const auto fitter = VolumeFitter::make(points);
  if (!fitter) return;
  for (const FitMethod& method : fit_methods()) {
    if (const auto v = fitter->fit(method)) bench.ours.add(to_double(v->volume), points, size);
  }
  bench.cgal_spheres.add(cgal.sphere(), points, size);
  if (!FclPeer::available) return;
  bench.fcl_boxes.add(fcl.box(), points, size);
  bench.fcl_lozenges.add(fcl.lozenge(), points, size);
}

// Refused models are told and left out.
bool run_model(const BenchModel& model, Bench& bench) {
  const auto mesh = import_mesh(model.file);
  if (!mesh) {
    fmt::print("- {}: {}\n", model.name, mesh.error().what);
    return false;
  }
  const std::vector<Double3>& points = mesh->mesh.positions;
  const PointCloud cloud = make_point_cloud(points).value();
  const ConvexHull hull = convex_hull(cloud);
  const double size = length(cloud.box.extent()) * cloud.frame.scale;
  if (hull.dimension < 3) {
    fmt::print("- {}: flat, left out of the tables (every volume of it is certified all the same)\n",
               model.name);
    judge(points, CgalPeer(points), FclPeer(points), size, bench);
    return false;
  }
  const CgalPeer cgal(points);
  const FclPeer fcl(points);
  const Capsule<double> capsule = minimal_capsule(hull).volume;
  Results& r = bench.results;
  r.know(model.name, "box", model.box), r.know(model.name, "sphere", model.sphere);
  r.know(model.name, "capsule", model.capsule), r.know(model.name, "lozenge", model.lozenge);
  r.run(model.name, quick_ways(points, cloud, cgal, fcl), 7);
  r.run(model.name, search_ways(points, cgal), 3);
  r.run(model.name, hull_ways(hull, capsule), 3);
  r.run(model.name, proven_ways(hull, capsule), 1);
  // What a proof has found on its way counts as known.
  for (const char* way : {"box, proven to 0.01 %", "capsule, proven to 2 %", "lozenge, proven to 2 %"}) {
    const std::string name = way;
    r.know(model.name, name.substr(0, name.find(',')), r.of(name, model.name)->volume);
  }
  judge(points, cgal, fcl, size, bench);
  bench.sizes[model.name] = {points.size(), hull.vertices.size()};
  return true;
}

void print_models(const std::vector<BenchModel>& models, const Bench& bench) {
  constexpr std::array k_columns{std::pair{"sphere, minimal, with preparation", "sphere"},
                                 std::pair{"box, minimal, with hull", "box"},
                                 std::pair{"box, CGAL oriented_bounding_box", "CGAL's box"},
                                 std::pair{"capsule, minimal, after the hull", "capsule"},
                                 std::pair{"lozenge, minimal, after hull and capsule", "lozenge"}};
  fmt::print("\n## Every model\n\nVolume / best, ms.\n\n| model | points | corners |");
  for (const auto& [way, title] : k_columns) fmt::print(" {} | |", title);
  fmt::print("\n|---|---:|---:|");
  for (std::size_t i = 0; i < k_columns.size(); ++i) fmt::print("---:|---:|");
  fmt::print("\n");
  for (const BenchModel& model : models) {
    const auto size = bench.sizes.find(model.name);
    if (size == bench.sizes.end()) continue;
    fmt::print("| {} | {} | {} |", model.name, size->second[0], size->second[1]);
    for (const auto& [name, title] : k_columns) {
      const auto way = std::find_if(bench.results.order().begin(), bench.results.order().end(),
                                    [&](const Way& w) { return w.name == name; });
      const Measured* m = bench.results.of(name, model.name);
      fmt::print(" {:.5f} | {:.2f} |", bench.results.ratio(*way, *m), m->ms);
    }
    fmt::print("\n");
  }
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

std::vector<Double3> cone(int sides) {
  std::vector<Double3> points{{0, 0, 1}};
  for (int i = 0; i < sides; ++i) {
    const double turn = 2 * std::numbers::pi * i / sides;
    points.push_back({std::cos(turn), std::sin(turn), 0});
  }
  return points;
}

template <class Work>
auto timed(Work&& work, double& ms) {
  const double start = cpu_ms();
  auto result = work();
  ms = cpu_ms() - start;
  return result;
}

void run_large(const char* name, const std::vector<Double3>& points) {
  const CgalPeer cgal(points);
  double prepare = 0, sphere = 0, hull_ms = 0, box = 0, cs = 0, cb = 0;
  const PointCloud cloud = timed([&] { return make_point_cloud(points).value(); }, prepare);
  const auto ball = timed([&] { return smallest_sphere(cloud); }, sphere);
  const ConvexHull hull = timed([&] { return convex_hull(cloud); }, hull_ms);
  const auto fit = timed([&] { return minimal_box(hull); }, box);
  const auto theirs = timed([&] { return cgal.sphere(); }, cs);
  const double their_box = timed([&] { return cgal.box_volume(); }, cb);
  fmt::print(
      "- {}: preparation {:.1f} ms; sphere {:.1f} ms (CGAL {:.1f}, ours / theirs {:.12f}); hull {:.0f} ms, "
      "{} "
      "corners of {} kept, loss {:.1e}; box {:.0f} ms; preparation, hull and box {:.0f} ms (CGAL's box "
      "{:.0f} ms, "
      "ours / theirs {:.6f})\n",
      name, prepare, sphere, cs, volume_of(ball.fit.volume, hull.frame) / volume_of(theirs), hull_ms,
      hull.vertices.size(), hull.boundary.size(), hull.loss, box, prepare + hull_ms + box, cb,
      volume_of(fit.volume, hull.frame) / their_box);
}

std::string load() {
  std::array<double, 3> average{};
  return getloadavg(average.data(), 3) == 3 ? fmt::format("{:.1f}", average[0]) : "unknown";
}

int run() {
  const BenchModels models;
  fmt::print("# Bounding volumes, as measured\n\n    ./run bench volumes\n\n");
  fmt::print("Load average at the start: {}.\n\n## Models\n\n", load());
  std::map<std::string, std::size_t> sources;
  Bench bench;
  for (const BenchModel& model : models.found()) sources[model.source] += run_model(model, bench);
  for (const auto& [source, count] : sources) fmt::print("- {}: {}\n", source, count);
  for (const std::string& line : models.missing()) fmt::print("- missing: {}\n", line);
  fmt::print("\n## Volumes and times\n\n");
  bench.results.print();
  fmt::print(
      "\n## Points outside\n\nIn exact arithmetic, in the very numbers that each gives. Ours: every method "
      "of every "
      "type, float32 as stored.\n\n| whose | volumes | with points outside | points | worst, of the diagonal "
      "|\n"
      "|---|---:|---:|---:|---:|\n");
  bench.ours.print("bvfit, all methods");
  bench.cgal_spheres.print("CGAL Min_sphere_of_spheres_d (double)");
  if (FclPeer::available) bench.fcl_boxes.print("FCL OBB"), bench.fcl_lozenges.print("FCL RSS");
  fmt::print("\n## Many points\n\n");
  run_large("1 000 000 Gaussian points", gaussian_points(1'000'000));
  std::vector<Double3> sphere = gaussian_points(200'000);
  for (Double3& p : sphere) p = normalized(p);
  run_large("200 000 co-spherical points", sphere);
  run_large("cone of 8 000 sides", cone(8000));
  print_models(models.found(), bench);
  fmt::print("\nLoad average at the end: {}.\n", load());
  return bench.ours.leaky == 0 ? 0 : 1;
}

}  // namespace
}  // namespace copse

int main() {
  return copse::run();
}
