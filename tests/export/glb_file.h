// A GLB taken apart, for tests.
#pragma once

#include "lib/formats/vec.h"

#include <cstring>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace copse {

struct GlbFile {
  nlohmann::json json;
  std::string binary;

  // The floats behind an accessor.
  std::vector<float> floats(std::size_t accessor) const {
    const auto& a = json["accessors"][accessor];
    const auto& view = json["bufferViews"][a["bufferView"].get<std::size_t>()];
    const std::size_t width = a["type"] == "VEC3" ? 3 : 2;
    std::vector<float> values(a["count"].get<std::size_t>() * width);
    EXPECT_EQ(view["byteLength"], values.size() * sizeof(float));
    std::memcpy(values.data(), binary.data() + view["byteOffset"].get<std::size_t>(),
                values.size() * sizeof(float));
    return values;
  }
  std::vector<std::uint32_t> indices(std::size_t accessor) const {
    const auto& a = json["accessors"][accessor];
    const auto& view = json["bufferViews"][a["bufferView"].get<std::size_t>()];
    const char* at = binary.data() + view["byteOffset"].get<std::size_t>();
    std::vector<std::uint32_t> values;
    for (std::size_t i = 0; i < a["count"]; ++i) {
      std::uint32_t value = 0;
      const std::size_t width = a["componentType"] == 5125 ? 4 : 2;
      std::memcpy(&value, at + i * width, width);
      values.push_back(value);
    }
    return values;
  }
};

inline std::uint32_t u32_at(const std::string& bytes, std::size_t offset) {
  std::uint32_t value = 0;
  EXPECT_LE(offset + 4, bytes.size());
  std::memcpy(&value, bytes.data() + offset, 4);
  return value;
}

// Checks the frame of the file as it goes.
inline GlbFile take_apart(const std::string& bytes) {
  EXPECT_EQ(bytes.substr(0, 4), "glTF");
  EXPECT_EQ(u32_at(bytes, 4), 2u);
  EXPECT_EQ(u32_at(bytes, 8), bytes.size());
  const std::size_t json_size = u32_at(bytes, 12);
  EXPECT_EQ(json_size % 4, 0u);
  EXPECT_EQ(bytes.substr(16, 4), "JSON");
  GlbFile file;
  file.json = nlohmann::json::parse(bytes.substr(20, json_size));
  const std::size_t rest = 20 + json_size;
  if (rest == bytes.size()) return file;
  EXPECT_EQ(u32_at(bytes, rest) % 4, 0u);
  EXPECT_EQ(bytes.substr(rest + 4, 4), std::string("BIN\0", 4));
  file.binary = bytes.substr(rest + 8);
  EXPECT_EQ(file.binary.size(), u32_at(bytes, rest));
  EXPECT_EQ(file.json["buffers"][0]["byteLength"], file.binary.size());
  return file;
}

}  // namespace copse
