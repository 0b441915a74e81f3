// How fast meshes are read, against the floor: touching every byte of the same file once.
//
//   build/bench/bin/bench_import --benchmark_counters_tabular=true
//
// The mesh is a field of tubes of 1 million triangles (COPSE_BENCH_TRIANGLES changes that), made in memory
// with positions, normals and texture coordinates.
#include "lib/formats/import/import.h"

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <numeric>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

namespace copse {
namespace {

struct Field {
  std::vector<Float3> positions, normals;
  std::vector<Float2> texcoords;
  std::vector<std::uint32_t> indices;
};

constexpr std::uint32_t k_sides = 12, k_rings = 400;

std::uint64_t wanted_triangles() {
  const char* text = std::getenv("COPSE_BENCH_TRIANGLES");
  return text != nullptr ? std::strtoull(text, nullptr, 10) : 1'000'000;
}

const Field& field() {
  static const Field made = [] {
    Field f;
    const std::uint64_t tubes = wanted_triangles() / (2 * k_sides * k_rings) + 1;
    for (std::uint64_t tube = 0; tube < tubes; ++tube) {
      const auto first = static_cast<std::uint32_t>(f.positions.size());
      for (std::uint32_t ring = 0; ring <= k_rings; ++ring) {
        for (std::uint32_t side = 0; side < k_sides; ++side) {
          const float a = 6.2831853f * static_cast<float>(side) / k_sides;
          const float r = 0.3f + 0.1f * std::sin(0.05f * static_cast<float>(ring));
          f.positions.push_back({static_cast<float>(tube) * 1.37f + r * std::cos(a),
                                 0.0123f * static_cast<float>(ring), r * std::sin(a)});
          f.normals.push_back({std::cos(a), 0, std::sin(a)});
          f.texcoords.push_back({static_cast<float>(side) / k_sides, static_cast<float>(ring) / k_rings});
          if (ring == k_rings) continue;
          const std::uint32_t here = first + ring * k_sides + side;
          const std::uint32_t next = first + ring * k_sides + (side + 1) % k_sides;
          f.indices.insert(f.indices.end(),
                           {here, here + k_sides, next, next, here + k_sides, next + k_sides});
        }
      }
    }
    return f;
  }();
  return made;
}

std::string obj(bool all) {
  const Field& f = field();
  fmt::memory_buffer out;
  auto to = fmt::appender(out);
  for (const Float3& p : f.positions) fmt::format_to(to, "v {:.6f} {:.6f} {:.6f}\n", p.x, p.y, p.z);
  if (all) {
    for (const Float2& t : f.texcoords) fmt::format_to(to, "vt {:.6f} {:.6f}\n", t.x, t.y);
    for (const Float3& n : f.normals) fmt::format_to(to, "vn {:.4f} {:.4f} {:.4f}\n", n.x, n.y, n.z);
  }
  for (std::size_t i = 0; i < f.indices.size(); i += 3) {
    const std::uint32_t a = f.indices[i] + 1, b = f.indices[i + 1] + 1, c = f.indices[i + 2] + 1;
    if (all) {
      fmt::format_to(to, "f {}/{}/{} {}/{}/{} {}/{}/{}\n", a, a, a, b, b, b, c, c, c);
    } else {
      fmt::format_to(to, "f {} {} {}\n", a, b, c);
    }
  }
  return fmt::to_string(out);
}

template <class Number>
void append(std::string& out, const std::vector<Number>& numbers) {
  out.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number));
}

std::string glb() {
  const Field& f = field();
  std::string bin;
  std::vector<std::size_t> offsets;
  const auto add = [&](const auto& numbers) {
    offsets.push_back(bin.size());
    append(bin, numbers);
  };
  add(f.positions);
  add(f.normals);
  add(f.texcoords);
  add(f.indices);
  offsets.push_back(bin.size());
  std::string views;
  for (std::size_t i = 0; i < 4; ++i)
    views += fmt::format("{}{{\"buffer\":0,\"byteOffset\":{},\"byteLength\":{}}}", i == 0 ? "" : ",",
                         offsets[i], offsets[i + 1] - offsets[i]);
  std::string json = fmt::format(
      R"({{"asset":{{"version":"2.0"}},"buffers":[{{"byteLength":{}}}],"bufferViews":[{}],"accessors":[)"
      R"({{"bufferView":0,"componentType":5126,"count":{},"type":"VEC3"}},{{"bufferView":1,"componentType":5126,"count":{},"type":"VEC3"}},)"
      R"({{"bufferView":2,"componentType":5126,"count":{},"type":"VEC2"}},{{"bufferView":3,"componentType":5125,"count":{},"type":"SCALAR"}}],)"
      R"("meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"NORMAL":1,"TEXCOORD_0":2}},"indices":3}}]}}],"nodes":[{{"mesh":0}}],)"
      R"("scenes":[{{"nodes":[0]}}]}})",
      bin.size(), views, f.positions.size(), f.positions.size(), f.positions.size(), f.indices.size());
  while (json.size() % 4 != 0) json += ' ';
  std::string out = "glTF";
  const auto put = [&out](std::size_t value) {
    const auto v = static_cast<std::uint32_t>(value);
    out.append(reinterpret_cast<const char*>(&v), 4);
  };
  put(2), put(28 + json.size() + bin.size()), put(json.size()), put(0x4e4f534a);
  out += json;
  put(bin.size()), put(0x004e4942);
  return out + bin;
}

std::string ply() {
  const Field& f = field();
  std::string out = fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty "
      "float z\n"
      "element face {}\nproperty list uchar uint vertex_indices\nend_header\n",
      f.positions.size(), f.indices.size() / 3);
  append(out, f.positions);
  for (std::size_t i = 0; i < f.indices.size(); i += 3) {
    out += '\3';
    out.append(reinterpret_cast<const char*>(&f.indices[i]), 12);
  }
  return out;
}

std::string stl() {
  const Field& f = field();
  std::string out(80, ' ');
  const auto count = static_cast<std::uint32_t>(f.indices.size() / 3);
  out.append(reinterpret_cast<const char*>(&count), 4);
  for (std::size_t i = 0; i < f.indices.size(); ++i) {
    if (i % 3 == 0) out.append(12, '\0');
    out.append(reinterpret_cast<const char*>(&f.positions[f.indices[i]]), 12);
    if (i % 3 == 2) out.append(2, '\0');
  }
  return out;
}

void run(benchmark::State& state, const std::string& file, MeshFormat format) {
  std::size_t triangles = 0;
  for (auto _ : state) {
    const auto import =
        import_mesh({reinterpret_cast<const std::uint8_t*>(file.data()), file.size()}, format, "bench");
    if (!import) return state.SkipWithError(import.error().what.c_str());
    triangles = import->mesh.triangles.size();
  }
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * file.size()));
  state.counters["triangles/s"] =
      benchmark::Counter(static_cast<double>(triangles), benchmark::Counter::kIsIterationInvariantRate);
  state.counters["MB"] = static_cast<double>(file.size()) * 1e-6;
}

// The floor of any reader of the file: every byte is looked at once.
void floor_of(benchmark::State& state, const std::string& file) {
  for (auto _ : state) {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i + 8 <= file.size(); i += 8) {
      std::uint64_t word = 0;
      std::memcpy(&word, file.data() + i, 8);
      sum += word;
    }
    benchmark::DoNotOptimize(sum);
  }
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * file.size()));
}

void import_obj_positions(benchmark::State& state) {
  static const std::string file = obj(false);
  run(state, file, MeshFormat::obj);
}
void import_obj_full(benchmark::State& state) {
  static const std::string file = obj(true);
  run(state, file, MeshFormat::obj);
}
void floor_obj_full(benchmark::State& state) {
  static const std::string file = obj(true);
  floor_of(state, file);
}
void import_glb(benchmark::State& state) {
  static const std::string file = glb();
  run(state, file, MeshFormat::glb);
}
void floor_glb(benchmark::State& state) {
  static const std::string file = glb();
  floor_of(state, file);
}
void import_ply_binary(benchmark::State& state) {
  static const std::string file = ply();
  run(state, file, MeshFormat::ply);
}
void import_stl_binary(benchmark::State& state) {
  static const std::string file = stl();
  run(state, file, MeshFormat::stl);
}

BENCHMARK(import_obj_positions)->Unit(benchmark::kMillisecond);
BENCHMARK(import_obj_full)->Unit(benchmark::kMillisecond);
BENCHMARK(floor_obj_full)->Unit(benchmark::kMillisecond);
BENCHMARK(import_glb)->Unit(benchmark::kMillisecond);
BENCHMARK(floor_glb)->Unit(benchmark::kMillisecond);
BENCHMARK(import_ply_binary)->Unit(benchmark::kMillisecond);
BENCHMARK(import_stl_binary)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace copse
