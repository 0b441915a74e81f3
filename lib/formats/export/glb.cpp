// GLB: one node and mesh an object and group, one primitive a part.
#include "lib/formats/export/export_detail.h"
#include "lib/formats/export/glb_geometry.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <string_view>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace copse {
namespace {

using Json = nlohmann::ordered_json;

// The number whose shortest decimal form is that of the float: 0.8, not 0.800000011920929.
double short_form(float value) {
  return std::stod(fmt::format("{}", value));
}

double unit(float value) {
  return std::isfinite(value) ? std::clamp(short_form(value), 0.0, 1.0) : 0.0;
}

Json unit_colour(const Float3& c) {
  return Json::array({unit(c.x), unit(c.y), unit(c.z)});
}

// Characters that a URI may hold as they are; the rest is percent-encoded.
std::string encoded_uri(const std::string& path) {
  std::string out;
  for (const char c : path) {
    const bool plain = (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') ||
                       std::string_view("-._~/!$&'()*+,;=@").find(c) != std::string_view::npos;
    if (plain) {
      out += c;
    } else {
      out += fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
  }
  return out;
}

class GlbWriter {
 public:
  GlbWriter(const Mesh& mesh, const std::string& name, GlbGeometry geometry, const ExportOptions& options)
      : mesh_(mesh), name_(name), geometry_(std::move(geometry)), options_(options) {}

  std::vector<ExportedFile> write() {
    root_["asset"] = {{"version", "2.0"}, {"generator", fmt::format("copse {}", COPSE_VERSION)}};
    root_["scene"] = 0;
    root_["scenes"] = Json::array({Json::object()});
    add_meshes();
    add_materials();
    add_accessors();
    add_buffer();
    add_extensions();
    files_.insert(files_.begin(), ExportedFile{name_, assemble()});
    return std::move(files_);
  }

 private:
  void add_meshes() {
    std::map<std::tuple<std::uint32_t, std::string, std::string>, std::size_t> index;
    Json meshes = Json::array(), nodes = Json::array();
    std::vector<std::uint32_t> level_of_node;
    for (const Primitive& primitive : geometry_.primitives) {
      const Part part = mesh_.parts.empty() ? Part{} : mesh_.parts[primitive.part];
      const std::uint32_t level =
          primitive.part < options_.level_of_part.size() ? options_.level_of_part[primitive.part] : 0;
      const auto [at, is_new] = index.try_emplace({level, part.object, part.group}, meshes.size());
      if (is_new) {
        level_of_node.push_back(level);
        meshes.push_back(
            {{"name", part.group.empty() ? part.object : part.group}, {"primitives", Json::array()}});
        nodes.push_back({{"name", part.object}, {"mesh", at->second}});
      }
      meshes[at->second]["primitives"].push_back(primitive_json(primitive, part));
    }
    if (meshes.empty()) return;
    Json roots = Json::array();
    for (std::size_t n = 0; n < nodes.size(); ++n) roots.push_back(n);
    const Double3& t = geometry_.translation;
    if (!options_.level_of_part.empty()) {
      roots = add_levels(nodes, level_of_node);
    } else if (t != Double3{}) {
      nodes.push_back({{"name", "origin"}, {"translation", {t.x, t.y, t.z}}, {"children", std::move(roots)}});
      roots = Json::array({nodes.size() - 1});
    }
    root_["scenes"][0]["nodes"] = std::move(roots);
    root_["nodes"] = std::move(nodes);
    root_["meshes"] = std::move(meshes);
  }

  // One node a level over the nodes of its meshes; the first names the others, which are in no scene.
  Json add_levels(Json& nodes, const std::vector<std::uint32_t>& level_of_node) {
    std::map<std::uint32_t, Json> children;
    for (std::size_t n = 0; n < level_of_node.size(); ++n) children[level_of_node[n]].push_back(n);
    const std::size_t first = nodes.size();
    const Double3& t = geometry_.translation;
    Json others = Json::array();
    for (auto& [level, below] : children) {
      if (nodes.size() > first) others.push_back(nodes.size());
      Json node = {{"name", fmt::format("level {}", level)}, {"children", std::move(below)}};
      if (t != Double3{}) node["translation"] = {t.x, t.y, t.z};
      nodes.push_back(std::move(node));
    }
    if (!others.empty()) {
      nodes[first]["extensions"]["MSFT_lod"]["ids"] = std::move(others);
      if (!options_.screen_coverage.empty())
        nodes[first]["extras"]["MSFT_screencoverage"] = options_.screen_coverage;
      use_extension("MSFT_lod", false);
    }
    return Json::array({first});
  }

  Json primitive_json(const Primitive& primitive, const Part& part) {
    Json attributes = {{"POSITION", primitive.position}};
    if (primitive.normal) attributes["NORMAL"] = *primitive.normal;
    if (primitive.texcoord) attributes["TEXCOORD_0"] = *primitive.texcoord;
    Json json = {{"attributes", std::move(attributes)}, {"indices", primitive.indices}};
    if (part.material != k_none) json["material"] = material(part.material, primitive.texcoord.has_value());
    if (primitive.draco) {
      const DracoStream& draco = *primitive.draco;
      Json ids = {{"POSITION", draco.position}};
      if (draco.normal >= 0) ids["NORMAL"] = draco.normal;
      if (draco.texcoord >= 0) ids["TEXCOORD_0"] = draco.texcoord;
      json["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", draco.view},
                                                          {"attributes", std::move(ids)}};
      use_extension("KHR_draco_mesh_compression", true);
    }
    return json;
  }

  // A primitive without texture coordinates may not use a material with a texture: it gets one without.
  std::size_t material(std::uint32_t index, bool with_texture) {
    const std::uint32_t image = mesh_.materials[index].texture;
    const bool textured = with_texture && image != k_none && has_image(mesh_.textures[image]);
    const auto [at, is_new] = material_numbers_.try_emplace({index, textured}, materials_.size());
    if (is_new) materials_.push_back(material_json(mesh_.materials[index], textured));
    return at->second;
  }

  // Blinn-Phong to metallic-roughness: the exponent n of a Blinn-Phong lobe and the width a of a Beckmann
  // lobe agree at a^2 = 2 / (n + 2), and glTF's roughness is the root of a. Without a highlight: fully rough.
  Json material_json(const Material& m, bool textured) {
    const bool shiny = m.specular != Float3{} && m.shininess > 0 && std::isfinite(m.shininess);
    const double roughness = shiny ? std::pow(2.0 / (m.shininess + 2.0), 0.25) : 1.0;
    Json pbr = {
        {"baseColorFactor", unit_colour(m.diffuse)}, {"metallicFactor", 0}, {"roughnessFactor", roughness}};
    pbr["baseColorFactor"].push_back(unit(m.alpha));
    if (textured) pbr["baseColorTexture"]["index"] = texture(m.texture);
    Json json = {{"name", m.name}, {"pbrMetallicRoughness", std::move(pbr)}};
    const float strength = std::max({m.emission.x, m.emission.y, m.emission.z});
    if (strength > 0 && std::isfinite(strength)) {
      json["emissiveFactor"] = unit_colour(strength > 1 ? m.emission / strength : m.emission);
    }
    if (strength > 1 && std::isfinite(strength)) {
      json["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = short_form(strength);
      use_extension("KHR_materials_emissive_strength", false);
    }
    if (m.alpha_cutoff > 0) {
      json["alphaMode"] = "MASK";
      json["alphaCutoff"] = short_form(m.alpha_cutoff);
    } else if (m.alpha < 1) {
      json["alphaMode"] = "BLEND";
    }
    if (m.double_sided) json["doubleSided"] = true;
    return json;
  }

  std::size_t texture(std::uint32_t index) {
    const auto [at, is_new] = texture_numbers_.try_emplace(index, textures_.size());
    if (!is_new) return at->second;
    textures_.push_back({{"sampler", 0}, {"source", images_.size()}});
    images_.push_back(image_json(index));
    return at->second;
  }

  // Only PNG and JPEG may be embedded; an image of another kind goes into a file of its own.
  Json image_json(std::uint32_t index) {
    const Texture& texture = mesh_.textures[index];
    if (texture.bytes.empty()) return {{"uri", encoded_uri(texture.uri)}};
    const std::string mime = image_mime(texture);
    const std::string_view bytes(reinterpret_cast<const char*>(texture.bytes.data()), texture.bytes.size());
    if (mime == "image/png" || mime == "image/jpeg") {
      return {{"mimeType", mime}, {"bufferView", geometry_.add_view(bytes, 0)}};
    }
    files_.push_back({texture_file_name(name_, index, texture), std::string(bytes)});
    return {{"uri", encoded_uri(files_.back().name)}};
  }

  void add_materials() {
    if (!materials_.empty()) root_["materials"] = std::move(materials_);
    if (textures_.empty()) return;
    root_["textures"] = std::move(textures_);
    root_["images"] = std::move(images_);
    root_["samplers"] = Json::array({{{"wrapS", 10497}, {"wrapT", 10497}}});  // both repeat
  }

  void add_accessors() {
    for (const Accessor& a : geometry_.accessors) {
      Json json;
      if (a.view) json["bufferView"] = *a.view;
      json["componentType"] = a.component;
      json["count"] = a.count;
      json["type"] = a.type;
      if (a.bounds) {
        const auto& [low, high] = *a.bounds;
        json["min"] = {low.x, low.y, low.z};
        json["max"] = {high.x, high.y, high.z};
      }
      root_["accessors"].push_back(std::move(json));
    }
  }

  void add_buffer() {
    for (const BufferView& view : geometry_.views) {
      Json json = {{"buffer", 0}, {"byteOffset", view.offset}, {"byteLength", view.size}};
      if (view.target != 0) json["target"] = view.target;
      root_["bufferViews"].push_back(std::move(json));
    }
    if (!geometry_.binary.empty())
      root_["buffers"] = Json::array({{{"byteLength", geometry_.binary.size()}}});
  }

  void use_extension(const std::string& name, bool required) { extensions_[name] = required; }

  void add_extensions() {
    for (const auto& [name, required] : extensions_) {
      root_["extensionsUsed"].push_back(name);
      if (required) root_["extensionsRequired"].push_back(name);
    }
  }

  // Header, JSON chunk, binary chunk. Names that are not UTF-8 lose the bytes that are not.
  std::string assemble() {
    std::string json = root_.dump(-1, ' ', false, Json::error_handler_t::replace);
    json.resize((json.size() + 3) / 4 * 4, ' ');
    std::string& binary = geometry_.binary;
    const std::size_t binary_size = binary.size();
    std::string head = "glTF";
    add_u32(head, 2);
    add_u32(head, 20 + json.size() + (binary_size == 0 ? 0 : 8 + binary_size));
    add_u32(head, json.size());
    head += "JSON" + json;
    if (binary_size > 0) {
      add_u32(head, binary_size);
      head.append("BIN\0", 4);
    }
    binary.insert(0, head);
    return std::move(binary);
  }

  static void add_u32(std::string& out, std::size_t value) {
    for (int shift = 0; shift < 32; shift += 8) out += static_cast<char>(value >> shift & 0xff);
  }

  const Mesh& mesh_;
  const std::string& name_;
  GlbGeometry geometry_;
  const ExportOptions& options_;
  Json root_;
  std::vector<ExportedFile> files_;
  Json materials_ = Json::array(), textures_ = Json::array(), images_ = Json::array();
  std::map<std::pair<std::uint32_t, bool>, std::size_t> material_numbers_;
  std::map<std::uint32_t, std::size_t> texture_numbers_;
  std::map<std::string, bool> extensions_;
};

}  // namespace

Result<std::vector<ExportedFile>> export_glb(const Mesh& mesh, const std::string& name,
                                             const ExportOptions& options) {
  auto geometry = glb_geometry(mesh, name, options);
  if (!geometry) return std::unexpected(std::move(geometry.error()));
  return GlbWriter(mesh, name, std::move(*geometry), options).write();
}

}  // namespace copse
