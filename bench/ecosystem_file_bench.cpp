// probe_ecosystem FILE.eco: what opening it and culling it cost. Called by bench/ecosystem.py.
#include "lib/formats/ecosystem/ecosystem_file.h"
#include "lib/runtime/block_culling.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace copse {
namespace {

template <class Action>
double median_ms(int times, Action&& action) {
  std::vector<double> all;
  for (int i = 0; i < times; ++i) {
    const auto start = std::chrono::steady_clock::now();
    action();
    all.push_back(
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
  }
  std::nth_element(all.begin(), all.begin() + times / 2, all.end());
  return all[static_cast<std::size_t>(times / 2)];
}

Ecosystem load(const char* path, Trust trust) {
  const auto file = EcosystemFile::open(path, trust);
  auto eco = file ? file->load() : std::unexpected(file.error());
  if (eco) return std::move(*eco);
  fmt::print(stderr, "{}\n", eco.error().what);
  std::exit(1);
}

void bench(const char* path) {
  const auto open = [&](Trust trust) { return median_ms(15, [&] { (void)load(path, trust); }); };
  const double on_demand = median_ms(15, [&] {
    const auto file = EcosystemFile::open(path);
    (void)file->load(Instances::on_demand);
  });
  fmt::print(
      "{:>10s} opened in {:.2f} ms checked in full, {:.2f} ms checksums alone, {:.3f} ms trusted; {:.2f} ms "
      "with instances on demand, as the player does\n",
      "", open(Trust::nothing), open(Trust::checksums), open(Trust::file), on_demand);
  const Ecosystem eco = load(path, Trust::nothing);
  const Double3 middle = eco.origin + to_double(eco.bounds.centre());
  const Camera camera{
      .eye = middle + Double3{0, 3, 0}, .target = middle + Double3{30, 0, 10}, .up = {0, 1, 0}, .fov = 0.8};
  const Frustum frustum = frustum_of(make_view(camera, 16.0 / 9, 0.1, 5000));
  for (const auto& [by, name] : {std::pair(BlockHierarchy::flat, "every block tested"),
                                 {BlockHierarchy::boxes, "box hierarchy"},
                                 {BlockHierarchy::kd_tree, "kd-tree"},
                                 {BlockHierarchy::rtree, "R-tree"}}) {
    if (!has_hierarchy(eco, by)) continue;
    std::vector<SeenBlock> visible;
    CullCounts counts;
    const double ms = median_ms(200, [&] { visible_blocks(eco, by, frustum, camera.eye, visible, &counts); });
    fmt::print(
        "{:>10s} culled in {:.4f} ms by {:<18s} {:>6d} nodes, {:>6d} blocks, {:>7d} plane tests: {} seen\n",
        "", ms, name, counts.nodes_visited, counts.blocks_tested, counts.plane_tests, visible.size());
  }
}

}  // namespace
}  // namespace copse

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  copse::bench(argv[1]);
  return 0;
}
