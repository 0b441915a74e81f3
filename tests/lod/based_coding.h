// What spectra that are coded against their tree must keep, for the tests of both codings.
#pragma once

#include "lib/formats/levels/spectrum_file.h"
#include "lib/formats/random.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

namespace copse {

inline constexpr SpectrumCodingOptions k_small{.coding = SpectrumCoding::small};

inline bool is_based(const EncodedSpectrum& e) {
  return e.bytes.size() > 4 && e.bytes[4] == static_cast<std::uint8_t>(SpectrumCoding::based);
}

// Lifetimes, materials, radii and triangles of all elements, whatever their order among equals.
inline std::vector<std::array<std::uint32_t, 5>> lives(const Spectrum& s) {
  std::vector<std::array<std::uint32_t, 5>> out;
  for (std::size_t e = 0; e < s.elements.size(); ++e) {
    const SpectrumElement& x = s.elements[e];
    out.push_back({x.birth, x.death, x.material, x.radius, s.first_triangle[e + 1] - s.first_triangle[e]});
  }
  std::sort(out.begin(), out.end());
  return out;
}

// Corners of the elements that are there at full detail.
inline std::vector<std::array<float, 8>> full_detail(const Spectrum& s) {
  std::vector<std::array<float, 8>> out;
  for (std::size_t e = 0; e < s.elements.size(); ++e) {
    if (s.elements[e].birth != 0) continue;
    for (std::uint32_t t = s.first_triangle[e]; t < s.first_triangle[e + 1]; ++t)
      for (const std::uint32_t v : s.triangles[t]) {
        const SpectrumVertex& x = s.vertices[v];
        out.push_back({x.position.x, x.position.y, x.position.z, x.normal.x, x.normal.y, x.normal.z,
                       x.texcoord.x, x.texcoord.y});
      }
  }
  std::sort(out.begin(), out.end());
  return out;
}

inline void expect_kept(const Spectrum& s, const Spectrum& d) {
  EXPECT_EQ(d.method, s.method);
  EXPECT_EQ(lives(d), lives(s));
  EXPECT_EQ(full_detail(d), full_detail(s));
  EXPECT_EQ(d.counts.to_vector(), s.counts.to_vector());
  ASSERT_EQ(d.errors.size(), s.errors.size());
  for (std::size_t n = 0; n < s.errors.size(); ++n) {
    EXPECT_GE(d.errors[n], s.errors[n]);
    EXPECT_LE(d.errors[n], s.errors[n] * 1.001f);
  }
}

// Coded against its tree and read back: what must be kept is kept.
inline void expect_round_trip(const Spectrum& s, const Tree& tree) {
  const auto e = encode_spectrum(s, k_small, &tree);
  ASSERT_TRUE(e.has_value());
  EXPECT_TRUE(is_based(*e));
  const auto d = decode_spectrum(e->bytes, "test", &tree);
  ASSERT_TRUE(d.has_value()) << d.error().what;
  expect_kept(s, *d);
}

// Bytes changed and cut off at random: refused, or a spectrum that fits together.
inline void expect_harmless(const std::vector<std::uint8_t>& good, const Tree& tree, int mutants) {
  Random random(7);
  int refused = 0;
  for (int i = 0; i < mutants; ++i) {
    std::vector<std::uint8_t> bad = good;
    for (int k = 0; k < 1 + i % 3; ++k) {
      const auto at = random.below(bad.size());
      bad[at] = static_cast<std::uint8_t>(bad[at] ^ (1 + random.below(255)));
    }
    if (i % 7 == 0) bad.resize(random.below(bad.size()));
    const auto s = decode_spectrum(bad, "mutant", &tree);
    refused += !s;
    if (!s) continue;
    for (const auto& t : s->triangles)
      for (const std::uint32_t v : t) ASSERT_LT(v, s->vertices.size());
    for (const SpectrumElement& e : s->elements) ASSERT_LE(e.birth, s->steps());
  }
  EXPECT_GT(refused, mutants / 2);
}

}  // namespace copse
