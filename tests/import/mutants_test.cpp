// Ten thousand damaged files of each format: every one is refused, or becomes a mesh that keeps all promises.
#include "tests/import/gltf_maker.h"
#include "tests/import/seeds.h"

#include <chrono>
#include <iostream>
#include <random>

namespace copse {
namespace {

using namespace copse::testing;

constexpr int k_mutants = 10'000;

class Mutator {
 public:
  explicit Mutator(std::uint64_t seed) : random_(seed) {}

  std::string operator()(std::string bytes) {
    for (std::uint64_t left = 1 + pick(4); left > 0; --left) change(bytes);
    return bytes;
  }
  std::uint64_t pick(std::uint64_t below) { return random_() % below; }

 private:
  void change(std::string& bytes) {
    if (bytes.empty()) return;
    const std::size_t at = pick(bytes.size());
    switch (pick(8)) {
      case 0:
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << pick(8)));
        break;
      case 1:
        bytes[at] = static_cast<char>(pick(256));
        break;
      case 2:
        bytes.resize(at);
        break;
      case 3:
        bytes.erase(at, 1 + pick(8));
        break;
      case 4:
        bytes.insert(at, bytes.substr(pick(bytes.size()), pick(32)));
        break;
      case 5:
        replace_number(bytes, at);
        break;
      case 6:
        replace_number(bytes, at);
        break;
      case 7:
        put_integer(bytes, at);
        break;
    }
  }

  // The next number of a text becomes one that hurts.
  void replace_number(std::string& bytes, std::size_t at) {
    static constexpr const char* k_numbers[] = {
        "0",     "-1",         "1",          "3",          "255",
        "65536", "2147483648", "4294967295", "4294967296", "18446744073709551615",
        "1e999", "-1e308",     "1e-320",     "nan",        "inf",
        "0.5",   "",           "[]",         "{}"};
    const std::size_t start = bytes.find_first_of("0123456789", at);
    if (start == std::string::npos) return;
    const std::size_t end = bytes.find_first_not_of("0123456789.", start);
    bytes.replace(start, (end == std::string::npos ? bytes.size() : end) - start,
                  k_numbers[pick(std::size(k_numbers))]);
  }

  void put_integer(std::string& bytes, std::size_t at) {
    static constexpr std::uint32_t k_values[] = {0,     1,       0x7fffffffu, 0x80000000u, 0xffffffffu,
                                                 0xffu, 0xffffu, 0x7fc00000u, 0x7f800000u};
    const std::uint32_t value = k_values[pick(std::size(k_values))];
    for (std::size_t i = 0; i < 4 && at + i < bytes.size(); ++i)
      bytes[at + i] = static_cast<char>(value >> (8 * i));
  }

  std::mt19937_64 random_;
};

// Damages the JSON or the buffer of a GLB but keeps its container whole, so that the damage gets further.
std::string mutate_inside(const std::string& glb, Mutator& mutate) {
  std::uint32_t size = 0;
  std::memcpy(&size, glb.data() + 12, 4);
  std::string text = glb.substr(20, size);
  std::string data = glb.size() > 28 + size ? glb.substr(28 + size) : "";
  (mutate.pick(2) == 0 ? text : data) = mutate(mutate.pick(2) == 0 || data.empty() ? text : data);
  return GltfMaker::glb_of(text, data);
}

void expect_all_mutants_survive(MeshFormat format) {
  const std::vector<std::string> seeds = seeds_of(format);
  for (const std::string& seed : seeds) {
    ASSERT_TRUE(read(seed, format)) << error_of(read(seed, format));
  }
  Mutator mutate(static_cast<std::uint64_t>(format) + 1);
  int accepted = 0;
  double slowest = 0;
  for (int i = 0; i < k_mutants; ++i) {
    const std::string& seed = seeds[mutate.pick(seeds.size())];
    const bool inside = format == MeshFormat::glb && mutate.pick(4) != 0;
    const std::string mutant = inside ? mutate_inside(seed, mutate) : mutate(seed);
    const auto start = std::chrono::steady_clock::now();
    const auto result =
        import_mesh(as_bytes(mutant), format, "mutant", {.strict = i % 3 == 0, .instance_limit = 100'000});
    slowest =
        std::max(slowest, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    if (result) {
      ++accepted;
      ASSERT_EQ(broken_promise(*result), nullptr) << "mutant " << i;
    } else {
      ASSERT_NE(result.error().fault, Fault::bug) << "mutant " << i << ": " << error_of(result);
      ASSERT_FALSE(result.error().what.empty());
    }
  }
  std::cout << k_mutants << " mutants: " << accepted << " read, " << k_mutants - accepted
            << " refused, the slowest took " << slowest << " s\n";
  EXPECT_GT(accepted, k_mutants / 100) << "damage must get beyond the first check";
  EXPECT_LT(accepted, k_mutants);
  EXPECT_LT(slowest, 2);
}

TEST(Mutants, Obj) {
  expect_all_mutants_survive(MeshFormat::obj);
}
TEST(Mutants, Ply) {
  expect_all_mutants_survive(MeshFormat::ply);
}
TEST(Mutants, Off) {
  expect_all_mutants_survive(MeshFormat::off);
}
TEST(Mutants, Stl) {
  expect_all_mutants_survive(MeshFormat::stl);
}
TEST(Mutants, Gltf) {
  expect_all_mutants_survive(MeshFormat::gltf);
}
TEST(Mutants, Glb) {
  expect_all_mutants_survive(MeshFormat::glb);
}

// The same with the format guessed, and behind gzip.
TEST(Mutants, OfAnyFormatBehindGzip) {
  Mutator mutate(99);
  for (int i = 0; i < 1000; ++i) {
    const auto format = static_cast<MeshFormat>(1 + mutate.pick(6));
    const std::vector<std::string> seeds = seeds_of(format);
    const std::string packed = gzipped(seeds[mutate.pick(seeds.size())]);
    const std::string mutant = i % 2 == 0 ? mutate(packed) : gzipped(mutate(seeds[0]));
    const auto result =
        import_mesh(as_bytes(mutant), MeshFormat::unknown, "mutant", {.instance_limit = 100'000});
    if (result) {
      ASSERT_EQ(broken_promise(*result), nullptr);
    } else {
      ASSERT_NE(result.error().fault, Fault::bug) << error_of(result);
    }
  }
}

}  // namespace
}  // namespace copse
