// Ecosystem files that lie: with every checksum put right, nothing that loads may be unsound.
#include "lib/formats/ecosystem/ecosystem_file.h"
#include "lib/formats/ecosystem/instance_codec.h"
#include "lib/formats/random.h"
#include "tests/formats/ecosystem_maker.h"
#include "tests/formats/tampering.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

using tampering::Bytes;

Bytes bytes_of(bool exact) {
  auto bytes = encode_ecosystem(little_ecosystem(exact));
  EXPECT_TRUE(bytes);
  return *bytes;
}

std::string refusal(Bytes bytes) {
  const auto file = EcosystemFile::from_bytes(std::move(bytes), "x.eco");
  if (!file) return file.error().what;
  const auto loaded = file->load();
  return loaded ? "" : loaded.error().what;
}

TEST(HostileEcosystem, TheLittleOneIsSound) {
  for (const bool exact : {false, true}) {
    EXPECT_EQ(check_ecosystem(little_ecosystem(exact)), std::vector<std::string>{});
    EXPECT_EQ(refusal(bytes_of(exact)), "");
  }
}

TEST(HostileEcosystem, ADamagedByteNeverPasses) {
  const Bytes sound = bytes_of(false);
  Random random(1);
  for (int i = 0; i < 2000; ++i) {
    Bytes bytes = sound;
    bytes[random.below(bytes.size())] ^= static_cast<std::uint8_t>(1u << random.below(8));
    EXPECT_NE(refusal(bytes), "");
  }
}

TEST(HostileEcosystem, AForgedByteIsRefusedOrHarmless) {
  for (const bool exact : {false, true}) {
    const Bytes sound = bytes_of(exact);
    Random random(2);
    for (int i = 0; i < 4000; ++i) {
      Bytes bytes = sound;
      bytes[random.below(bytes.size())] = static_cast<std::uint8_t>(random.below(256));
      tampering::mend_checksums(bytes);
      const auto file = EcosystemFile::from_bytes(bytes, "x.eco");
      if (!file) continue;
      (void)file->verify();
      const auto eco = file->load();
      if (!eco) continue;
      for (const InstanceBlock& b : eco->blocks)
        for (std::size_t k = b.first; k < b.first + b.count; ++k) {
          const Instance instance = instance_of(*eco, b, k);
          EXPECT_TRUE(is_finite(instance.position) && instance.scale > 0);
          EXPECT_TRUE(instance.trunk_material == k_none || instance.trunk_material < eco->materials.size());
        }
    }
  }
}

TEST(HostileEcosystem, EveryTruncationIsRefused) {
  const Bytes sound = bytes_of(true);
  for (std::size_t size = 0; size < sound.size(); size += 7) {
    Bytes bytes(sound.begin(), sound.begin() + static_cast<std::ptrdiff_t>(size));
    EXPECT_NE(refusal(bytes), "");
    tampering::mend_checksums(bytes);
    EXPECT_NE(refusal(bytes), "");
  }
}

TEST(HostileEcosystem, WhatIsWrongIsNamedWithSectionAndOffset) {
  const Bytes sound = bytes_of(false);
  const auto with = [&](std::string_view section, std::size_t offset, auto value) {
    Bytes bytes = sound;
    tampering::set(bytes, tampering::section_at(bytes, section) + offset, value);
    return refusal(bytes);
  };
  EXPECT_NE(with("EBLK", 0, std::uint32_t{9}).find("section EBLK at offset"), std::string::npos);
  EXPECT_NE(with("EBLK", 0, std::uint32_t{9}).find("type out of range"), std::string::npos);
  EXPECT_NE(with("EBLK", 4, std::uint32_t{1}).find("do not follow"), std::string::npos);
  EXPECT_NE(with("EBLK", 40, 0.3f).find("power of two"), std::string::npos);
  EXPECT_NE(with("EBLK", 52, std::numeric_limits<float>::quiet_NaN()).find("box"), std::string::npos);
  EXPECT_NE(with("EINS", 8, ~std::uint64_t{0}).find("rotation"), std::string::npos);
  EXPECT_NE(with("EINS", 21, std::uint8_t{200}).find("material"), std::string::npos);
  EXPECT_NE(with("EBOX", 28, std::uint32_t{77}).find("blocks out of range"), std::string::npos);
  EXPECT_NE(with("EHGT", 0, std::numeric_limits<float>::infinity()).find("not finite"), std::string::npos);
  EXPECT_NE(with("EHED", 80, std::uint32_t{64}).find("unknown flags"), std::string::npos);
  EXPECT_NE(with("EHED", 92, std::uint32_t{4000000000}).find("header says"), std::string::npos);
  EXPECT_NE(with("EHED", 104, std::uint32_t{11}).find("depth 11"), std::string::npos);
  EXPECT_NE(with("EHED", 250, std::uint8_t{1}).find("reserved"), std::string::npos);
  EXPECT_NE(with("ETYP", 0, std::uint32_t{4000000000}).find("longer than what is left"), std::string::npos);
  EXPECT_NE(with("ETYP", 40, -1.0f).find("scales"), std::string::npos);
}

TEST(HostileEcosystem, BoxesThatDoNotHoldTheirTreesAreFoundByVerification) {
  Bytes bytes = bytes_of(false);
  tampering::set(bytes, tampering::section_at(bytes, "EBLK") + 52 + 12, 0.001f);  // max.x of the first block
  const auto file = EcosystemFile::from_bytes(bytes, "x.eco");
  ASSERT_TRUE(file);
  EXPECT_TRUE(file->load());
  ASSERT_FALSE(file->verify().empty());
  EXPECT_NE(file->verify().front().find("does not hold its instances"), std::string::npos);
}

TEST(HostileEcosystem, ATreeIsNoEcosystem) {
  Bytes bytes = bytes_of(false);
  tampering::set(bytes, 12, std::uint32_t{1});
  EXPECT_NE(refusal(bytes).find("no ecosystem"), std::string::npos);
}

TEST(HostileEcosystem, CompressedItLoadsTheSame) {
  const Ecosystem eco = little_ecosystem(false);
  const auto bytes = encode_ecosystem(eco, Encoding::zstd);
  ASSERT_TRUE(bytes);
  const auto loaded = EcosystemFile::from_bytes(*bytes, "x")->load();
  ASSERT_TRUE(loaded) << loaded.error().what;
  EXPECT_EQ(loaded->packed.to_vector(), eco.packed.to_vector());
}

TEST(HostileEcosystem, ArraysThatDoNotFitTogetherAreABugOfTheCaller) {
  Ecosystem eco = little_ecosystem(false);
  eco.types[0].uri.clear();
  EXPECT_EQ(encode_ecosystem(eco).error().fault, Fault::bug);
  eco = little_ecosystem(false);
  eco.terrain.heights = {};
  EXPECT_EQ(encode_ecosystem(eco).error().fault, Fault::bug);
  eco = little_ecosystem(false);
  eco.depth = 3;
  EXPECT_EQ(encode_ecosystem(eco).error().fault, Fault::bug);
}

}  // namespace
}  // namespace copse
