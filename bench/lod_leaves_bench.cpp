// Leaves at a tenth, a fiftieth, ... of their triangles: what leaf collapse and its peers keep of them.
//
//   bench_lod_leaves [--views N] [--ratio R] [--quality fast|balanced|exact] [--no-peers] [--speed]
//   [--errors] [--projections] TREE...      .tree or .stree files that hold leaves
//
// Each ratio of triangles at the size in pixels at which it would be shown; times are of all threads
// together.
#include "lib/analysis/lod/hausdorff_errors.h"
#include "lib/analysis/lod/leaf_collapse.h"
#include "lib/analysis/lod/lines_points.h"
#include "lib/analysis/measure/lod_quality.h"
#include "lib/analysis/measure/surface_distance.h"
#include "lib/formats/import/image.h"
#include "lib/formats/tree_file/tree_file.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <optional>
#include <span>

#include <fmt/format.h>
#include <meshoptimizer.h>

namespace {

using namespace copse;
// Of all threads together: what a core would need, however busy the machine is.
struct Clock {
  static std::clock_t now() { return std::clock(); }
};

double seconds_since(std::clock_t start) {
  return double(std::clock() - start) / CLOCKS_PER_SEC;
}

DrawnMesh meshopt(const DrawnMesh& source, std::size_t triangles) {
  std::vector<float> points;
  for (const Double3& p : source.positions) points.insert(points.end(), {float(p.x), float(p.y), float(p.z)});
  std::vector<unsigned> indices;
  for (const Triangle& t : source.triangles) indices.insert(indices.end(), t.begin(), t.end());
  std::vector<unsigned> out(indices.size());
  const auto simplify = meshopt_simplify(out.data(), indices.data(), indices.size(), points.data(),
                                         source.positions.size(), 12, 3 * triangles, 1e9f, 0, nullptr);
  DrawnMesh level = source;
  level.triangles.clear(), level.material.clear();
  for (std::size_t i = 0; i + 2 < simplify; i += 3) {
    level.triangles.push_back({out[i], out[i + 1], out[i + 2]});
    level.material.push_back(source.material.front());
  }
  return level;
}

// The area of the largest triangle that a crown's hull holds when it may reach out of it by 3 % of its
// width: its corners are the hull's, as far as 162 directions find them.
double largest_triangle(const DrawnMesh& source) {
  std::vector<Double3> corners;
  for (const Double3& d : view_sphere(2).directions) {
    const auto farthest =
        std::max_element(source.positions.begin(), source.positions.end(),
                         [&](const Double3& p, const Double3& q) { return dot(p, d) < dot(q, d); });
    if (std::find(corners.begin(), corners.end(), *farthest) == corners.end()) corners.push_back(*farthest);
  }
  double most = 0;
  for (std::size_t i = 0; i < corners.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      for (std::size_t k = 0; k < j; ++k) {
        const Double3 n = cross(corners[j] - corners[i], corners[k] - corners[i]);
        most = std::max(most, dot(n, n));
      }
  return 0.5 * std::sqrt(most) * 1.06 * 1.06;
}

// `fits`: of the source's area what so many triangles can have at most.
void row(const std::string& tree, const std::string& method, double ratio, const LodQuality& q,
         double seconds, double fits) {
  fmt::print(
      "{:24} {:10} {:5.3f} {:7} {:6.3f} {:6.3f} {:5.2f}-{:4.2f} {:6.3f} {:6.3f} {:7.4f} {:7.4f} {:7.4f} "
      "{:8.3f} {:6.3f}\n",
      tree, method, ratio, q.triangles, q.area_ratio, q.coverage_ratio, q.coverage_low, q.coverage_high,
      q.iou, q.iou_low, q.rmse, q.ssim, q.hull_growth,
      seconds > 0 ? double(q.source_triangles) / seconds / 1e6 : 0.0, std::min(1.0, fits));
}

int size_for(double ratio) {
  return ratio >= 0.25 ? 512 : ratio >= 0.05 ? 128 : 32;
}

struct Options {
  int views = 42;
  double only = 0;  // one ratio; 0: all of them
  bool peers = true;
  bool speed = false;                      // instead: triangles a second of every quality
  std::optional<CollapseQuality> quality;  // balanced, or with --speed all of them
  bool errors = false;                     // instead: each level's stored error beside the measured distance
  bool projections = false;                // instead: how wrong the estimates for lines and points are
};

// The largest and the mean error over 162 directions, at full, half and a tenth of coverage.
void projections(const std::string& name, const Tree& tree) {
  const auto directions = view_sphere(2).directions;
  for (const double coverage : {1.0, 0.5, 0.1}) {
    const auto errors = [&](const EstimateOptions& options) {
      return projection_errors(tree, coverage, directions, options);
    };
    const ProjectionErrors e = errors({}),
                           even = errors({.orientation = Orientation::isotropic, .divisor = 1.8}),
                           seed = errors({.orientation = Orientation::seed});
    fmt::print(
        "{:24} {:4.1f}  leaf area {:.3f} {:.3f} (by 1.8: {:.3f} {:.3f})  trunk area {:.3f} {:.3f} (1/4: "
        "{:.3f} {:.3f})  length {:.3f} {:.3f} (pi/4: {:.3f} {:.3f}, cosine: {:.3f} {:.3f})\n",
        name, coverage, e.largest.leaf_area, e.mean.leaf_area, even.largest.leaf_area, even.mean.leaf_area,
        e.largest.trunk_area, e.mean.trunk_area, even.largest.trunk_area, even.mean.trunk_area,
        e.largest.length, e.mean.length, even.largest.length, even.mean.length, seed.largest.length,
        seed.mean.length);
  }
}

// Million triangles a processor second: each quality for the whole spectrum, the errors of the first one's
// steps, meshoptimizer for the one level at a tenth. What takes long is left out of large trees.
void speeds(const std::string& name, const Tree& tree, const DrawnMesh& source, const Looks& looks,
            std::optional<CollapseQuality> only) {
  const auto rate = [&](const auto& work) {
    const auto start = Clock::now();
    work();
    return double(source.triangles.size()) / std::max(seconds_since(start), 1e-6) / 1e6;
  };
  fmt::print("{:24} {:8}", name, source.triangles.size());
  Spectrum spectrum;
  for (const CollapseQuality q : {CollapseQuality::fast, CollapseQuality::balanced, CollapseQuality::exact}) {
    const std::size_t most = q == CollapseQuality::exact ? 100'000 : 1'000'000;
    if ((only && *only != q) || (q != CollapseQuality::fast && source.triangles.size() > most))
      fmt::print(" {:>8}", "-");
    else
      fmt::print(" {:8.3f}",
                 rate([&] { spectrum = collapse_spectrum(tree, looks, {.quality = q, .errors = false}); }));
    if (q == CollapseQuality::fast || only == q)
      fmt::print(" {:8.3f}", rate([&] { hausdorff_errors(spectrum); }));
  }
  fmt::print(" {:8.3f}\n", rate([&] { meshopt(source, source.triangles.size() / 10); }));
}

// The state of a spectrum with no more triangles.
std::uint32_t state_of(const Spectrum& spectrum, std::size_t triangles) {
  std::uint32_t n = 0;
  while (n < spectrum.steps() && spectrum.counts[n] > triangles) ++n;
  return n;
}

// The stored error of a level, metres, beside the largest distance of points spread over full detail and over
// the level to the other one; and what the errors of all steps cost, nanoseconds a triangle.
void errors(const std::string& name, const DrawnMesh& source, const Spectrum& spectrum) {
  const auto start = Clock::now();
  const auto stored = hausdorff_errors(spectrum);
  const double nanoseconds = 1e9 * seconds_since(start) / double(source.triangles.size());
  const DrawnMesh full = drawn_state(spectrum, 0);
  for (const double ratio : {0.5, 0.25, 0.1, 0.05, 0.02}) {
    const std::uint32_t n =
        state_of(spectrum, static_cast<std::size_t>(ratio * double(source.triangles.size())));
    const SurfaceDistances d = surface_distance(full, drawn_state(spectrum, n), 100'000);
    const double measured = std::max(d.from_level.max, d.from_source.max);
    fmt::print("{:24} {:5.3f} {:7} {:8.4f} {:8.4f} {:8.4f} {:6.3f} {:8.0f}\n", name, ratio,
               spectrum.counts[n], stored[n], d.from_source.max, d.from_level.max,
               measured > 1e-9 ? stored[n] / measured : 1.0, nanoseconds);
  }
}

void bench(const std::filesystem::path& path, const Options& options) {
  const auto file = TreeFile::open(path);
  if (!file) return fmt::print("{}\n", to_line(file.error(), "bench"));
  const auto loaded = file->load();
  if (!loaded) return fmt::print("{}\n", to_line(loaded.error(), "bench"));
  const Tree& tree = *loaded;
  if (options.projections) return projections(path.stem().string(), tree);
  const DrawnMesh source = drawn_leaves(tree);
  if (source.triangles.empty()) return;
  Image image;
  const auto masks = alpha_masks(tree.materials, [&](std::uint32_t t) -> std::optional<TextureImage> {
    const Texture& texture = tree.textures[t];
    auto read =
        texture.bytes.empty() ? read_image(path.parent_path() / texture.uri) : read_image(texture.bytes, "");
    if (!read) return {};
    image = std::move(*read);
    return TextureImage{image.width, image.height, image.rgba};
  });
  const Looks looks{tree.materials, masks};
  const std::string name = path.stem().string();
  if (options.speed) return speeds(name, tree, source, looks, options.quality);
  const auto start = Clock::now();
  const Spectrum spectrum = collapse_spectrum(
      tree, looks,
      {.quality = options.quality.value_or(CollapseQuality::balanced), .errors = options.errors});
  const double collapse_seconds = seconds_since(start);
  if (options.errors) return errors(name, source, spectrum);
  const DrawnMesh full = drawn_state(spectrum, 0);
  const double share = largest_triangle(full) / std::max(area(full), 1e-300);
  for (const double ratio : {0.5, 0.25, 0.1, 0.05, 0.02}) {
    if (options.only > 0 && ratio != options.only) continue;
    const LodJudge judge(full, looks, {.views = options.views, .image_size = size_for(ratio)});
    const auto target = static_cast<std::size_t>(ratio * double(source.triangles.size()));
    if (options.peers) {
      const auto begin = Clock::now();
      const DrawnMesh level = meshopt(source, target);
      const double s = seconds_since(begin);
      const LodQuality q = judge.measure(level);
      row(name, "meshopt", ratio, q, s, double(q.triangles) * share);
    }
    const LodQuality q = judge.measure(drawn_state(spectrum, state_of(spectrum, target)));
    row(name, "collapse", ratio, q, collapse_seconds, double(q.triangles) * share);
  }
}

CollapseQuality quality_of(const std::string& name) {
  if (name == "fast") return CollapseQuality::fast;
  return name == "exact" ? CollapseQuality::exact : CollapseQuality::balanced;
}

}  // namespace

int main(int argc, char** argv) {
  fmt::print("{:24} {:10} {:>5} {:>7} {:>6} {:>6} {:>10} {:>6} {:>6} {:>7} {:>7} {:>7} {:>8} {:>6}\n", "tree",
             "method", "ratio", "tris", "area", "cover", "lo-hi", "iou", "iou-lo", "rmse", "ssim", "hull+",
             "Mtri/s", "fits");
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--no-peers")
      options.peers = false;
    else if (argument == "--speed")
      options.speed = true;
    else if (argument == "--errors")
      options.errors = true;
    else if (argument == "--projections")
      options.projections = true;
    else if (argument == "--quality" && i + 1 < argc)
      options.quality = quality_of(argv[++i]);
    else if (argument == "--views" && i + 1 < argc)
      options.views = std::atoi(argv[++i]);
    else if (argument == "--ratio" && i + 1 < argc)
      options.only = std::atof(argv[++i]);
    else
      bench(argument, options);
  }
}
