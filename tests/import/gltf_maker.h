// Makes small glTF assets: a JSON tree that a test may bend as it likes, and one buffer.
#pragma once

#include "tests/import/testing.h"

#include <cstring>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace copse::testing {

using Json = nlohmann::json;

class GltfMaker {
 public:
  Json json = {{"asset", {{"version", "2.0"}}}};
  std::string bin;

  // A buffer view of those numbers; returns its index.
  template <class Number>
  int view(const std::vector<Number>& numbers, int stride = 0) {
    while (bin.size() % 4 != 0) bin += '\0';
    Json entry = {{"buffer", 0}, {"byteOffset", bin.size()}, {"byteLength", numbers.size() * sizeof(Number)}};
    if (stride != 0) entry["byteStride"] = stride;
    bin.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number));
    return add("bufferViews", entry);
  }

  template <class Number>
  static int component_type() {
    if constexpr (std::is_same_v<Number, std::int8_t>) return 5120;
    if constexpr (std::is_same_v<Number, std::uint8_t>) return 5121;
    if constexpr (std::is_same_v<Number, std::int16_t>) return 5122;
    if constexpr (std::is_same_v<Number, std::uint16_t>) return 5123;
    if constexpr (std::is_same_v<Number, std::uint32_t>) return 5125;
    return 5126;
  }

  template <class Number>
  int accessor(const std::vector<Number>& numbers, const std::string& type, bool normalized = false) {
    const std::size_t components = type == "SCALAR" ? 1
                                   : type == "MAT4" ? 16
                                                    : static_cast<std::size_t>(type[3] - '0');
    Json entry = {{"bufferView", view(numbers)},
                  {"componentType", component_type<Number>()},
                  {"count", numbers.size() / components},
                  {"type", type}};
    if (normalized) entry["normalized"] = true;
    return add("accessors", entry);
  }

  int add(const char* list, const Json& entry) {
    json[list].push_back(entry);
    return static_cast<int>(json[list].size()) - 1;
  }

  // A mesh of one primitive, and a node in the scene that shows it. Returns the node.
  int show(const Json& primitive, const Json& node = Json::object()) {
    Json shown = node;
    shown["mesh"] = add("meshes", {{"primitives", Json::array({primitive})}});
    const int index = add("nodes", shown);
    if (json["scenes"].empty()) json["scenes"].push_back({{"nodes", Json::array()}});
    json["scenes"][0]["nodes"].push_back(index);
    return index;
  }

  // One triangle in the plane z = 0.
  int triangle() { return accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3"); }
  // A unit square: corners 0 1 2 3 counter-clockwise.
  int square() { return accessor<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, "VEC3"); }

  std::string glb() const {
    Json whole = json;
    if (!bin.empty() && !whole.contains("buffers"))
      whole["buffers"] = Json::array({{{"byteLength", bin.size()}}});
    return glb_of(whole.dump(), bin);
  }

  static std::string glb_of(std::string text, std::string data) {
    while (text.size() % 4 != 0) text += ' ';
    while (data.size() % 4 != 0) data += '\0';
    std::string out = "glTF";
    const auto put = [&out](std::size_t value) {
      const auto v = static_cast<std::uint32_t>(value);
      out.append(reinterpret_cast<const char*>(&v), 4);
    };
    put(2);
    put(12 + 8 + text.size() + (data.empty() ? 0 : 8 + data.size()));
    put(text.size());
    put(0x4e4f534a);
    out += text;
    if (!data.empty()) {
      put(data.size());
      put(0x004e4942);
      out += data;
    }
    return out;
  }

  Result<Import> read(bool strict = false) const { return testing::read(glb(), MeshFormat::glb, strict); }
  Import import() const { return good(read()); }
  std::string refusal(bool strict = false) const { return error_of(read(strict)); }
};

inline std::string base64(std::string_view bytes) {
  static const char* k_digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t v = 0;
    for (std::size_t k = 0; k < 3; ++k)
      v = v << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) out += i + k > bytes.size() ? '=' : k_digits[v >> (18 - 6 * k) & 63];
  }
  return out;
}

}  // namespace copse::testing
