#include "lib/formats/ecosystem/type_volumes.h"

#include "lib/formats/little_endian.h"

#include <limits>

#include <gtest/gtest.h>

namespace copse {
namespace {

std::vector<TreeType> types() {
  std::vector<TreeType> t(3);
  t[0].volumes = {BoundingSphere<float>{{0, 1, 0}, 2}, Capsule<float>{{0, 0, 0}, {0, 3, 0}, 1}};
  t[2].volumes = {FloatBox{{0, 0, 0}, {1, 1, 1}}};
  t[2].envelopes = {OrientedBox<float>{{0, 0, 0}, {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {1, 2, 3}}};
  return t;
}

std::string fault(const EncodedTypeVolumes& bytes, std::size_t count = 3) {
  std::vector<TreeType> t(count);
  return decode_type_volumes(bytes.records, bytes.numbers, t).what;
}

TEST(TypeVolumes, ComeBackTypeByType) {
  const auto bytes = encode_type_volumes(types());
  EXPECT_EQ(bytes.records.size(), 4 * k_type_volume_record);
  EXPECT_EQ(bytes.numbers.size(), 4 * (4 + 7 + 6 + 15));
  std::vector<TreeType> back(3);
  EXPECT_EQ(decode_type_volumes(bytes.records, bytes.numbers, back).what, "");
  for (std::size_t t = 0; t < 3; ++t) {
    EXPECT_EQ(back[t].volumes, types()[t].volumes);
    EXPECT_EQ(back[t].envelopes, types()[t].envelopes);
  }
  EXPECT_TRUE(encode_type_volumes({}).records.empty());
}

TEST(TypeVolumes, WhatMakesNoBoxIsRefused) {
  const auto sound = encode_type_volumes(types());
  EXPECT_NE(fault(sound, 2), "");  // a type that is not there
  const auto with = [&](std::size_t offset, std::uint32_t value) {
    auto bytes = sound;
    put(std::span(bytes.records), offset, value);
    return fault(bytes);
  };
  EXPECT_NE(with(0, 2), "");   // the next is of type 0: out of order
  EXPECT_NE(with(4, 2), "");   // neither rest nor envelope
  EXPECT_NE(with(8, 7), "");   // a k-DOP
  EXPECT_NE(with(8, 99), "");  // no kind
  EXPECT_NE(with(12, 5), "");  // not the count of a sphere
  EXPECT_NE(with(12, 4000000000u), "");
  auto bytes = sound;
  bytes.numbers.resize(bytes.numbers.size() + 4);
  EXPECT_NE(fault(bytes), "");  // numbers of no volume
  bytes = sound;
  put(std::span(bytes.numbers), 12, -1.0f);  // a radius below 0
  EXPECT_NE(fault(bytes), "");
  bytes = sound;
  put(std::span(bytes.numbers), 0, std::numeric_limits<float>::quiet_NaN());
  EXPECT_NE(fault(bytes), "");
  bytes = sound;
  for (std::size_t i = 0; i < 3; ++i)  // axes without a volume
    put(std::span(bytes.numbers), 4 * (4 + 7 + 6 + 3 + 3 * i), 0.0f);
  EXPECT_NE(fault(bytes), "");
}

}  // namespace
}  // namespace copse
