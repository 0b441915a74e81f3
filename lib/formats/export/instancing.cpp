#include "lib/formats/export/instancing.h"

#include "lib/formats/little_endian.h"

#include <algorithm>
#include <cstring>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace copse {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* k_extension = "EXT_mesh_gpu_instancing";
constexpr int k_float = 5126;

struct Glb {
  Json json;
  std::string binary;
};

// Precondition: what this project's own writer made.
Glb take_apart(std::string_view bytes) {
  const auto u32 = [&](std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
  };
  const std::size_t json_size = u32(12), binary = 20 + json_size + 8;
  Glb glb{Json::parse(bytes.substr(20, json_size)), {}};
  if (binary <= bytes.size()) glb.binary = bytes.substr(binary);
  return glb;
}

void add_u32(std::string& out, std::uint64_t value) {
  for (int shift = 0; shift < 32; shift += 8) out += static_cast<char>(value >> shift & 0xff);
}

std::string put_together(const Glb& glb) {
  std::string json = glb.json.dump(-1, ' ', false, Json::error_handler_t::replace);
  json.resize(align_up(json.size(), 4), ' ');
  std::string out = "glTF";
  add_u32(out, 2);
  add_u32(out, 20 + json.size() + 8 + glb.binary.size());
  add_u32(out, json.size());
  out += "JSON" + json;
  add_u32(out, glb.binary.size());
  out.append("BIN\0", 4);
  return out + glb.binary;
}

class Instancer {
 public:
  Instancer(Glb& glb, Instancing form) : glb_(glb), form_(form) {}

  bool add(const NodeInstances& n) {
    Json& nodes = glb_.json["nodes"];
    const auto at = std::find_if(nodes.begin(), nodes.end(), [&](const Json& node) {
      return node.value("name", "") == n.node && node.contains("mesh");
    });
    if (at == nodes.end()) return false;
    if (form_ == Instancing::nodes) {
      add_children(static_cast<std::size_t>(at - nodes.begin()), n);
      return true;
    }
    std::vector<Float3> scales;
    for (const float s : n.scales) scales.push_back({s, s, s});
    Json attributes = {
        {"TRANSLATION", accessor(n.translations.data(), n.translations.size(), "VEC3", sizeof(Float3))},
        {"ROTATION", accessor(n.rotations.data(), n.rotations.size(), "VEC4", 4 * sizeof(float))},
        {"SCALE", accessor(scales.data(), scales.size(), "VEC3", sizeof(Float3))}};
    if (!n.colours.empty())
      attributes["_COLOR_0"] = accessor(n.colours.data(), n.colours.size(), "VEC3", sizeof(Float3));
    (*at)["extensions"][k_extension]["attributes"] = std::move(attributes);
    return true;
  }

 private:
  // The node's mesh goes to children of it, one an instance.
  void add_children(std::size_t index, const NodeInstances& n) {
    Json& nodes = glb_.json["nodes"];
    const Json mesh = nodes[index]["mesh"];
    nodes[index].erase("mesh");
    Json children = Json::array();
    for (std::size_t i = 0; i < n.translations.size(); ++i) {
      const Float3& t = n.translations[i];
      children.push_back(nodes.size());
      nodes.push_back({{"name", fmt::format("{} {}", n.node, i + 1)},
                       {"mesh", mesh},
                       {"translation", {t.x, t.y, t.z}},
                       {"rotation", n.rotations[i]},
                       {"scale", {n.scales[i], n.scales[i], n.scales[i]}}});
    }
    nodes[index]["children"] = std::move(children);
  }

  std::size_t accessor(const void* data, std::size_t count, const char* type, std::size_t stride) {
    glb_.binary.resize(align_up(glb_.binary.size(), 4));
    const std::size_t offset = glb_.binary.size(), size = count * stride;
    glb_.binary.append(static_cast<const char*>(data), size);
    glb_.json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", offset}, {"byteLength", size}});
    glb_.json["accessors"].push_back({{"bufferView", glb_.json["bufferViews"].size() - 1},
                                      {"componentType", k_float},
                                      {"count", count},
                                      {"type", type}});
    return glb_.json["accessors"].size() - 1;
  }

  Glb& glb_;
  Instancing form_;
};

void move_everything(Json& json, const Double3& origin) {
  if (origin == Double3{} || !json["scenes"][0].contains("nodes")) return;
  json["nodes"].push_back({{"name", "ecosystem"},
                           {"translation", {origin.x, origin.y, origin.z}},
                           {"children", json["scenes"][0]["nodes"]}});
  json["scenes"][0]["nodes"] = Json::array({json["nodes"].size() - 1});
}

}  // namespace

Result<std::string> with_instances(std::string_view bytes, std::span<const NodeInstances> nodes,
                                   const Double3& origin, Instancing form) {
  Glb glb = take_apart(bytes);
  Instancer instancer(glb, form);
  std::size_t count = 0;
  for (const NodeInstances& n : nodes) count += n.translations.size();
  if (form == Instancing::nodes && count > k_most_nodes)
    return refuse("", fmt::format("{} instances as nodes; {} are the limit", count, k_most_nodes),
                  "export them by the extension, or fewer");
  bool any = false;
  for (const NodeInstances& n : nodes) {
    if (n.translations.empty()) continue;
    if (!instancer.add(n))
      return refuse("", fmt::format("no node of the GLB is called '{}'", n.node), "report this");
    any = true;
  }
  if (any && form == Instancing::extension) {
    for (const char* list : {"extensionsUsed", "extensionsRequired"}) glb.json[list].push_back(k_extension);
    glb.binary.resize(align_up(glb.binary.size(), 4));
    glb.json["buffers"][0]["byteLength"] = glb.binary.size();
  }
  move_everything(glb.json, origin);
  constexpr std::uint64_t k_most = 0xffffffff;
  if (glb.binary.size() + (1u << 20) > k_most)
    return refuse("", "a GLB holds 4 GiB and no more", "export fewer instances");
  return put_together(glb);
}

}  // namespace copse
