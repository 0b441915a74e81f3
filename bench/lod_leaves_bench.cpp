// Leaves at a tenth, a fiftieth, ... of their triangles: what leaf collapse and its peers keep of them.
//
//   lod_leaves_bench TREE...      .tree or .stree files that hold leaves
#include "lib/analysis/measure/lod_quality.h"
#include "lib/formats/import/image.h"
#include "lib/formats/tree_file.h"

#include <chrono>
#include <filesystem>
#include <span>

#include <fmt/format.h>
#include <meshoptimizer.h>

namespace {

using namespace copse;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

DrawnMesh meshopt(const DrawnMesh& source, std::size_t triangles, bool sloppy) {
  std::vector<float> points;
  for (const Double3& p : source.positions) points.insert(points.end(), {float(p.x), float(p.y), float(p.z)});
  std::vector<unsigned> indices;
  for (const Triangle& t : source.triangles) indices.insert(indices.end(), t.begin(), t.end());
  std::vector<unsigned> out(indices.size());
  const auto simplify =
      sloppy ? meshopt_simplifySloppy(out.data(), indices.data(), indices.size(), points.data(),
                                      source.positions.size(), 12, 3 * triangles, 1e9f, nullptr)
             : meshopt_simplify(out.data(), indices.data(), indices.size(), points.data(),
                                source.positions.size(), 12, 3 * triangles, 1e9f, 0, nullptr);
  DrawnMesh level = source;
  level.triangles.clear(), level.material.clear();
  for (std::size_t i = 0; i + 2 < simplify; i += 3) {
    level.triangles.push_back({out[i], out[i + 1], out[i + 2]});
    level.material.push_back(source.material.front());
  }
  return level;
}

void row(const std::string& tree, const std::string& method, double ratio, const LodQuality& q,
         double seconds) {
  fmt::print(
      "{:24} {:10} {:5.3f} {:7} {:6.3f} {:6.3f} {:5.2f}-{:4.2f} {:6.3f} {:6.3f} {:7.4f} {:7.4f} {:7.4f} "
      "{:8.2f}\n",
      tree, method, ratio, q.triangles, q.area_ratio, q.coverage_ratio, q.coverage_low, q.coverage_high,
      q.iou, q.iou_low, q.rmse, q.ssim, q.hull_growth,
      seconds > 0 ? double(q.source_triangles) / seconds / 1e6 : 0.0);
}

int size_for(double ratio) {
  return ratio >= 0.25 ? 512 : ratio >= 0.05 ? 128 : 32;
}

void bench(const std::filesystem::path& path) {
  const auto file = TreeFile::open(path);
  if (!file) return fmt::print("{}\n", to_line(file.error(), "bench"));
  const auto loaded = file->load();
  if (!loaded) return fmt::print("{}\n", to_line(loaded.error(), "bench"));
  const Tree& tree = *loaded;
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
  for (const double ratio : {0.5, 0.25, 0.1, 0.05, 0.02}) {
    const LodJudge judge(source, looks, {.views = 42, .image_size = size_for(ratio)});
    const auto target = static_cast<std::size_t>(ratio * double(source.triangles.size()));
    for (const bool sloppy : {false, true}) {
      const auto start = Clock::now();
      const DrawnMesh level = meshopt(source, target, sloppy);
      const double s = seconds_since(start);
      row(name, sloppy ? "sloppy" : "meshopt", ratio, judge.measure(level), s);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  fmt::print("{:24} {:10} {:>5} {:>7} {:>6} {:>6} {:>10} {:>6} {:>6} {:>7} {:>7} {:>7} {:>8}\n", "tree",
             "method", "ratio", "tris", "area", "cover", "lo-hi", "iou", "iou-lo", "rmse", "ssim", "hull+",
             "Mtri/s");
  for (int i = 1; i < argc; ++i) bench(argv[i]);
}
