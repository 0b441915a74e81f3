#include "lib/formats/levels/spectrum_file.h"

#include "lib/formats/random.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

namespace copse {
namespace {

// A spectrum of n quads, of which one goes in every step and every third step a new triangle comes.
Spectrum sample(std::uint32_t n) {
  Random random(7);
  std::vector<SpectrumVertex> vertices;
  std::vector<SpectrumElement> elements;
  std::vector<std::uint32_t> first{0};
  std::vector<std::array<std::uint32_t, 3>> triangles;
  const auto corner = [&] {
    const Double3 d{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    vertices.push_back(
        {to_float(d * 10.0), to_float(normalized(d)), {static_cast<float>(random.uniform()), 0.5f}});
    return static_cast<std::uint32_t>(vertices.size() - 1);
  };
  for (std::uint32_t e = 0; e < n; ++e) {
    const std::uint32_t death = n - e;
    elements.push_back(
        {.birth = 0, .death = death == n ? k_none : death, .material = e % 2, .radius = e % 5});
    const std::uint32_t a = corner(), b = corner(), c = corner(), d = corner();
    triangles.push_back({a, b, c}), triangles.push_back({a, c, d});
    first.push_back(static_cast<std::uint32_t>(triangles.size()));
    if (death % 3 != 0 || death == n) continue;
    elements.push_back({.birth = death - 1, .death = death, .material = k_none, .radius = k_none});
    triangles.push_back({a, b, d});
    first.push_back(static_cast<std::uint32_t>(triangles.size()));
  }
  Spectrum s{.method = LodMethod::collapse,
             .vertices = {},
             .elements = {},
             .first_triangle = {},
             .triangles = {},
             .counts = {},
             .errors = {}};
  std::vector<float> errors(n);
  for (std::uint32_t i = 0; i < n; ++i) errors[i] = 0.001f * static_cast<float>(i);
  std::vector<std::uint32_t> counts(n);
  for (std::uint32_t step = 0; step < n; ++step) {
    for (std::size_t e = 0; e < elements.size(); ++e)
      if (elements[e].birth <= step && step < elements[e].death) counts[step] += first[e + 1] - first[e];
  }
  s.vertices = vertices, s.elements = elements, s.first_triangle = first, s.triangles = triangles,
  s.counts = counts, s.errors = errors;
  return s;
}

Spectrum decoded(const EncodedSpectrum& e) {
  auto s = decode_spectrum(e.bytes, "test");
  EXPECT_TRUE(s.has_value()) << s.error().what;
  return s ? *s : Spectrum{};
}

TEST(SpectrumFile, FastCodingIsExact) {
  const Spectrum s = sample(40);
  const auto e = encode_spectrum(s, {});
  ASSERT_TRUE(e.has_value());
  EXPECT_EQ(e->position_error, 0);
  const Spectrum d = decoded(*e);
  EXPECT_EQ(d.method, s.method);
  EXPECT_EQ(d.vertices.to_vector(), s.vertices.to_vector());
  EXPECT_EQ(d.elements.to_vector(), s.elements.to_vector());
  EXPECT_EQ(d.triangles.to_vector(), s.triangles.to_vector());
  EXPECT_EQ(d.first_triangle.to_vector(), s.first_triangle.to_vector());
  EXPECT_EQ(d.counts.to_vector(), s.counts.to_vector());
  EXPECT_EQ(d.errors.to_vector(), s.errors.to_vector());
}

TEST(SpectrumFile, SmallCodingErrsByNoMoreThanItSays) {
  const Spectrum s = sample(200);
  double before = 1e9;
  for (const int bits : {8, 10, 12, 14, 16}) {
    const auto e = encode_spectrum(s, {.coding = SpectrumCoding::small, .position_bits = bits});
    ASSERT_TRUE(e.has_value());
    const Spectrum d = decoded(*e);
    ASSERT_EQ(d.vertices.size(), s.vertices.size());
    double worst = 0;
    // The codec may turn the corners of a triangle round, never reorder triangles.
    for (std::size_t v = 0; v < s.vertices.size(); ++v)
      worst = std::max(worst, distance(to_double(d.vertices[v].position), to_double(s.vertices[v].position)));
    EXPECT_LE(worst, e->position_error * (1 + 1e-12)) << bits;
    EXPECT_LE(e->position_error, 20.0 / ((1 << bits) - 1) * std::sqrt(3.0) / 2 * 1.01) << bits;
    EXPECT_LT(worst, before);
    before = worst;
    EXPECT_EQ(d.elements.to_vector(), s.elements.to_vector());
    EXPECT_EQ(d.counts.to_vector(), s.counts.to_vector());
    EXPECT_EQ(d.errors.to_vector(), s.errors.to_vector());
    for (std::size_t t = 0; t < s.triangles.size(); ++t) {
      auto a = s.triangles[t], b = d.triangles[t];
      std::rotate(a.begin(), std::min_element(a.begin(), a.end()), a.end());
      std::rotate(b.begin(), std::min_element(b.begin(), b.end()), b.end());
      ASSERT_EQ(a, b) << t;
    }
  }
}

TEST(SpectrumFile, SmallIsSmaller) {
  const Spectrum s = sample(400);
  EXPECT_LT(encode_spectrum(s, {.coding = SpectrumCoding::small})->bytes.size(),
            encode_spectrum(s, {})->bytes.size() / 2);
}

TEST(SpectrumFile, TheSameSpectrumGivesTheSameBytes) {
  const SpectrumCodingOptions small{.coding = SpectrumCoding::small};
  EXPECT_EQ(encode_spectrum(sample(50), small)->bytes, encode_spectrum(sample(50), small)->bytes);
}

TEST(SpectrumFile, DamageIsRefusedOrHarmless) {
  for (const SpectrumCoding coding : {SpectrumCoding::fast, SpectrumCoding::small}) {
    const std::vector<std::uint8_t> good = encode_spectrum(sample(30), {.coding = coding})->bytes;
    Random random(11);
    int refused = 0;
    for (int i = 0; i < 2000; ++i) {
      std::vector<std::uint8_t> bad = good;
      const auto at = random.below(bad.size());
      bad[at] = static_cast<std::uint8_t>(bad[at] ^ (1 + random.below(255)));
      if (i % 5 == 0) bad.resize(random.below(bad.size()));
      const auto s = decode_spectrum(bad, "test");
      refused += !s;
      if (!s) continue;
      for (const auto& t : s->triangles)
        for (const std::uint32_t v : t) ASSERT_LT(v, s->vertices.size());
      for (const SpectrumElement& e : s->elements) ASSERT_LE(e.birth, s->steps());
    }
    EXPECT_GT(refused, 400);
  }
}

TEST(SpectrumFile, CountsThatTheBytesCannotHoldTakeNoMemory) {
  std::vector<std::uint8_t> bytes = encode_spectrum(sample(5), {})->bytes;
  for (std::size_t field = 8; field < 24; field += 4) {
    std::vector<std::uint8_t> bad = bytes;
    for (std::size_t i = 0; i < 4; ++i) bad[field + i] = 0xfe;
    EXPECT_FALSE(decode_spectrum(bad, "test").has_value()) << field;
    std::vector<std::uint8_t> small = encode_spectrum(sample(5), {.coding = SpectrumCoding::small})->bytes;
    for (std::size_t i = 0; i < 4; ++i) small[field + i] = 0xfe;
    EXPECT_FALSE(decode_spectrum(small, "test").has_value()) << field;
  }
}

TEST(SpectrumFile, LinksAreCheckedAgainstTheTree) {
  const Spectrum s = sample(20);
  EXPECT_EQ(check_spectrum_links(s, 5, 2), "");
  EXPECT_NE(check_spectrum_links(s, 4, 2).find("radius 4 of 4"), std::string::npos);
  EXPECT_NE(check_spectrum_links(s, 5, 1).find("material 1 of 1"), std::string::npos);
}

LodSpectra levels() {
  LodSpectra s;
  s.trunk = sample(20), s.leaves = sample(30);
  const auto level = [&](std::uint32_t n, std::uint32_t m, float error) {
    return LodLevel{n, m, s.trunk.counts[n] + s.leaves.counts[m], error, error * 10};
  };
  s.schedule = {level(0, 0, 0), level(3, 5, 0.1f), level(19, 29, 1)};
  s.discrete = {level(3, 5, 0.1f), level(10, 20, 0.5f)};
  s.near = 1, s.far = 20, s.hysteresis = 0.2f;
  return s;
}

TEST(SpectrumFile, LevelsComeBack) {
  const LodSpectra s = levels();
  LodSpectra back;
  back.trunk = s.trunk, back.leaves = s.leaves;
  ASSERT_TRUE(decode_levels(encode_levels(s), "test", back).has_value());
  EXPECT_EQ(back.schedule, s.schedule);
  EXPECT_EQ(back.discrete, s.discrete);
  EXPECT_EQ(back.hysteresis, s.hysteresis);
  EXPECT_EQ(back.far, s.far);
}

TEST(SpectrumFile, WhatIsCodedSmallHasItsLevelsCompressedAndTheyComeBack) {
  LodSpectra s = levels();
  for (std::uint32_t n = 4; n < 20; ++n) {
    s.schedule.push_back(s.schedule.back());
    s.schedule[s.schedule.size() - 2] = LodLevel{n, n + 2, s.trunk.counts[n] + s.leaves.counts[n + 2],
                                                 0.1f + 0.01f * n, s.schedule.back().distance};
  }
  for (const bool small : {false, true}) {
    ContainerWriter writer(FileKind::tree);
    ASSERT_TRUE(put_spectra(writer, s, {.coding = small ? SpectrumCoding::small : SpectrumCoding::fast}));
    const auto file = Container::from_bytes(writer.finish().value(), "f");
    ASSERT_TRUE(file.has_value());
    const SectionInfo* section = file->find("LSLD");
    ASSERT_NE(section, nullptr);
    EXPECT_EQ(section->encoding, small ? Encoding::zstd : Encoding::raw);
    const auto back = load_spectra(*file, 100, 100);
    ASSERT_TRUE(back.has_value()) << back.error().what;
    for (auto list : {&LodSpectra::schedule, &LodSpectra::discrete}) {
      std::vector<LodLevel> expected = s.*list;
      for (LodLevel& l : expected)
        l.error = std::max(back->trunk.errors[l.trunk_steps], back->leaves.errors[l.leaf_steps]);
      EXPECT_EQ((*back).*list, expected) << "errors are those of the spectra as they are read";
    }
  }
}

TEST(SpectrumFile, LevelsThatDoNotFitAreRefused) {
  const auto refused = [](LodSpectra s) {
    LodSpectra back;
    back.trunk = s.trunk, back.leaves = s.leaves;
    return !decode_levels(encode_levels(s), "test", back);
  };
  LodSpectra s = levels();
  s.schedule[1].trunk_steps = 99;
  EXPECT_TRUE(refused(s));
  s = levels(), s.schedule[1].triangles += 1;
  EXPECT_TRUE(refused(s));
  s = levels(), s.leaves = {};  // one part alone: its triangles count too
  for (auto* list : {&s.schedule, &s.discrete})
    for (LodLevel& l : *list) l.leaf_steps = 0, l.triangles = s.trunk.counts[l.trunk_steps];
  EXPECT_FALSE(refused(s));
  s.discrete[1].triangles -= 1;
  EXPECT_TRUE(refused(s));
  s = levels(), std::swap(s.discrete[0], s.discrete[1]);
  EXPECT_TRUE(refused(s));
  s = levels(), s.hysteresis = 1;
  EXPECT_TRUE(refused(s));
  s = levels(), s.far = 0.5f;
  EXPECT_TRUE(refused(s));
  s = levels(), s.discrete[1].error = std::nanf("");
  EXPECT_TRUE(refused(s));
  s = levels(), s.discrete[0].distance = 2, s.discrete[1].distance = 1;
  EXPECT_TRUE(refused(s));
}

}  // namespace
}  // namespace copse
