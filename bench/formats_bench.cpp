// Opening, loading and encoding an .stree of about 200 MB. Each figure is named by what it includes.
#include "lib/formats/container/atomic_file.h"
#include "lib/formats/tree_file/tree_file.h"
#include "tests/formats/tree_maker.h"

#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include <benchmark/benchmark.h>
#include <unistd.h>

namespace copse {
namespace {

const Tree& large_tree() {
  static const Tree k_tree = make_tree(
      {.roots = 1, .radii = 240000, .leaves = 300000, .groups = 20000, .ring = 8, .segment = 16, .leaf = 2},
      1);
  return k_tree;
}

// Files that live as long as the program.
struct Files {
  std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("copse_bench_" + std::to_string(::getpid()));
  std::uint64_t bytes[2] = {};
  Files() {
    std::filesystem::create_directory(folder);
    for (const Encoding encoding : {Encoding::raw, Encoding::zstd}) {
      const auto encoded = encode_tree(large_tree(), {.encoding = encoding});
      if (!encoded || !write_file(path(encoding), *encoded)) std::abort();
      bytes[static_cast<int>(encoding)] = encoded->size();
    }
    std::printf("raw %.1f MB, zstd %.1f MB\n", static_cast<double>(bytes[0]) / 1e6,
                static_cast<double>(bytes[1]) / 1e6);
  }
  ~Files() { std::filesystem::remove_all(folder); }
  std::filesystem::path path(Encoding encoding) const {
    return folder / (encoding == Encoding::raw ? "raw.stree" : "zstd.stree");
  }
};

const Files& files() {
  static const Files k_files;
  return k_files;
}

void set_bytes(benchmark::State& state, std::uint64_t bytes) {
  state.SetBytesProcessed(static_cast<std::int64_t>(bytes) * state.iterations());
}

void open_only(benchmark::State& state, Encoding encoding) {
  const auto path = files().path(encoding);
  for (auto _ : state) {
    auto file = TreeFile::open(path, Trust::file);
    if (!file) std::abort();
    benchmark::DoNotOptimize(file);
  }
}

void open_and_load(benchmark::State& state, Encoding encoding, Trust trust) {
  const auto path = files().path(encoding);
  for (auto _ : state) {
    const auto file = TreeFile::open(path, trust);
    auto tree = file->load();
    if (!tree) {
      std::puts(tree.error().what.c_str());
      std::abort();
    }
    benchmark::DoNotOptimize(tree);
  }
  if (trust != Trust::file) set_bytes(state, files().bytes[0]);
}

void encode(benchmark::State& state, Encoding encoding) {
  const Tree& tree = large_tree();
  for (auto _ : state) {
    auto bytes = encode_tree(tree, {.encoding = encoding});
    benchmark::DoNotOptimize(bytes);
  }
  set_bytes(state, files().bytes[0]);
}

BENCHMARK_CAPTURE(open_only, raw, Encoding::raw)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(open_and_load, raw_trust_file, Encoding::raw, Trust::file)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(open_and_load, raw_trust_checksums, Encoding::raw, Trust::checksums)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(open_and_load, raw_trust_nothing, Encoding::raw, Trust::nothing)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(open_and_load, zstd_trust_file, Encoding::zstd, Trust::file)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(open_and_load, zstd_trust_nothing, Encoding::zstd, Trust::nothing)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(encode, raw, Encoding::raw)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(encode, zstd, Encoding::zstd)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace copse
