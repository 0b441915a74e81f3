#include "lib/formats/import/gltf/material.h"

#include "lib/formats/import/text.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace copse {
namespace {

constexpr double k_largest_shininess = 1000;  // as OBJ's Ns; a sharper highlight is smaller than a pixel

// The Blinn-Phong exponent whose highlight is as wide as a GGX lobe of that roughness: 2 / a^2 - 2, a =
// roughness^2.
float shininess(double roughness) {
  const double a = std::max(roughness * roughness, 1e-3);
  return static_cast<float>(std::clamp(2 / (a * a) - 2, 0.0, k_largest_shininess));
}

Float3 clamped(const Double3& c, double most = 1) {
  const auto channel = [most](double v) { return static_cast<float>(std::clamp(v, 0.0, most)); };
  return {channel(c.x), channel(c.y), channel(c.z)};
}

Double3 mix(const Double3& a, const Double3& b, double t) {
  return a * (1 - t) + b * t;
}

// The type of an image by its first bytes.
std::string mime_of(std::span<const std::uint8_t> bytes) {
  const auto starts = [&](std::string_view magic) {
    return bytes.size() >= magic.size() &&
           std::equal(magic.begin(), magic.end(), reinterpret_cast<const char*>(bytes.data()));
  };
  if (starts("\x89PNG")) return "image/png";
  if (starts("\xff\xd8\xff")) return "image/jpeg";
  if (starts("RIFF")) return "image/webp";
  return {};
}

class MaterialReader {
 public:
  explicit MaterialReader(GltfDocument& document) : document_(document), builder_(document.builder()) {}

  bool read(const JsonValue& json, UvTransform& uv) {
    Material m;
    m.name = to_utf8(json["name"].text());
    const JsonValue extensions = json["extensions"];
    const JsonValue glossy = extensions["KHR_materials_pbrSpecularGlossiness"];
    JsonValue texture;
    const bool good = glossy.exists() ? specular_glossiness(glossy, m, texture)
                                      : metallic_roughness(json, extensions, m, texture);
    if (!good || !emission(json, extensions, m) || !colour_texture(texture, m, uv) || !alpha(json, m) ||
        !json["doubleSided"].read(m.double_sided, builder_))
      return false;
    if (extensions["KHR_materials_unlit"].exists()) {
      m.specular = {};
      m.shininess = 0;
    }
    m.ambient = m.diffuse;
    builder_.mesh.materials.push_back(std::move(m));
    return true;
  }

 private:
  bool rgb(const JsonValue& json, Double3& out) {
    std::array<double, 3> c{out.x, out.y, out.z};
    if (!json.read(c, builder_)) return false;
    out = {c[0], c[1], c[2]};
    return true;
  }

  bool rgba(const JsonValue& json, Double3& colour, float& alpha) {
    std::array<double, 4> c{1, 1, 1, 1};
    if (!json.read(c, builder_)) return false;
    colour = {c[0], c[1], c[2]};
    alpha = static_cast<float>(std::clamp(c[3], 0.0, 1.0));
    return true;
  }

  bool metallic_roughness(const JsonValue& json, const JsonValue& extensions, Material& m,
                          JsonValue& texture) {
    const JsonValue pbr = json["pbrMetallicRoughness"];
    const JsonValue layer = extensions["KHR_materials_specular"];
    Double3 base, tint{1, 1, 1};
    double metallic = 1, roughness = 1, ior = 1.5, strength = 1;
    if (!rgba(pbr["baseColorFactor"], base, m.alpha) || !pbr["metallicFactor"].read(metallic, builder_) ||
        !pbr["roughnessFactor"].read(roughness, builder_) ||
        !extensions["KHR_materials_ior"]["ior"].read(ior, builder_) ||
        !layer["specularFactor"].read(strength, builder_) || !rgb(layer["specularColorFactor"], tint))
      return false;
    metallic = std::clamp(metallic, 0.0, 1.0);
    roughness = std::clamp(roughness, 0.0, 1.0);
    const double reflected = ior > 0 ? (ior - 1) / (ior + 1) : 1;
    const Double3 dielectric = tint * (reflected * reflected * std::clamp(strength, 0.0, 1.0));
    // The rougher, the wider light is scattered: a fully rough metal is a diffuse surface of its colour.
    const double mirrored = 1 - roughness * roughness;
    m.diffuse = clamped(base * (1 - metallic * mirrored));
    m.specular = clamped(mix(dielectric, base, metallic) * mirrored);
    m.shininess = shininess(roughness);
    texture = pbr["baseColorTexture"];
    return true;
  }

  bool specular_glossiness(const JsonValue& json, Material& m, JsonValue& texture) {
    Double3 diffuse, specular{1, 1, 1};
    double glossiness = 1;
    if (!rgba(json["diffuseFactor"], diffuse, m.alpha) || !rgb(json["specularFactor"], specular) ||
        !json["glossinessFactor"].read(glossiness, builder_))
      return false;
    const double roughness = 1 - std::clamp(glossiness, 0.0, 1.0);
    m.diffuse = clamped(diffuse);
    m.specular = clamped(specular * (1 - roughness * roughness));
    m.shininess = shininess(roughness);
    texture = json["diffuseTexture"];
    return true;
  }

  bool emission(const JsonValue& json, const JsonValue& extensions, Material& m) {
    Double3 colour{0, 0, 0};
    double strength = 1;
    if (!rgb(json["emissiveFactor"], colour) ||
        !extensions["KHR_materials_emissive_strength"]["emissiveStrength"].read(strength, builder_))
      return false;
    m.emission = clamped(colour * std::max(strength, 0.0), 1e6);
    return true;
  }

  bool alpha(const JsonValue& json, Material& m) {
    std::string mode = "OPAQUE";
    float cutoff = 0.5f;
    if (!json["alphaMode"].read(mode, builder_) || !json["alphaCutoff"].read(cutoff, builder_)) return false;
    if (mode == "MASK") {
      m.alpha_cutoff = std::clamp(cutoff, 0.0f, 1.0f);
    } else if (mode == "BLEND") {
      // Leaves that are blended are cut out in real time: sorting them costs more than it shows.
      if (m.texture != k_none) m.alpha_cutoff = 0.5f;
    } else {
      m.alpha = 1;
    }
    return true;
  }

  bool colour_texture(const JsonValue& info, Material& m, UvTransform& uv) {
    std::uint32_t index = k_none;
    std::uint64_t set = 0;
    if (!info["index"].read_index(index, document_.root()["textures"].size(), builder_) ||
        !info["texCoord"].read(set, builder_) ||
        !transform(info["extensions"]["KHR_texture_transform"], set, uv))
      return false;
    if (index == k_none) return true;
    const JsonValue texture = document_.root()["textures"].at(index);
    const std::size_t images = document_.root()["images"].size();
    std::uint32_t source = k_none;
    if (!texture["extensions"]["EXT_texture_webp"]["source"].read_index(source, images, builder_))
      return false;
    if (source == k_none && !texture["source"].read_index(source, images, builder_)) return false;
    if (source == k_none) {
      builder_.notes.add("textures left out",
                         fmt::format("{} has no image that is read here", texture.path()));
      return true;
    }
    return image(source, m.texture);
  }

  bool transform(const JsonValue& json, std::uint64_t set, UvTransform& uv) {
    std::array<double, 2> offset{}, scale{1, 1};
    double angle = 0;
    if (!json["offset"].read(offset, builder_) || !json["scale"].read(scale, builder_) ||
        !json["rotation"].read(angle, builder_) || !json["texCoord"].read(set, builder_))
      return false;
    uv.set = static_cast<std::uint32_t>(std::min<std::uint64_t>(set, 1000));
    const double c = std::cos(angle), s = std::sin(angle);
    uv.m = {c * scale[0], s * scale[1], offset[0], -s * scale[0], c * scale[1], offset[1]};
    return true;
  }

  bool image(std::uint32_t index, std::uint32_t& out) {
    if (const auto it = textures_.find(index); it != textures_.end()) {
      out = it->second;
      return true;
    }
    const JsonValue json = document_.root()["images"].at(index);
    std::string uri;
    std::uint32_t view_index = k_none;
    Texture texture;
    if (!json["uri"].read(uri, builder_) || !json["mimeType"].read(texture.mime, builder_) ||
        !json["bufferView"].read_index(view_index, document_.root()["bufferViews"].size(), builder_))
      return false;
    if (view_index != k_none) {
      GltfDocument::View view;
      if (!document_.view(view_index, view)) return false;
      if (!spend(json, view.bytes.size())) return false;
      texture.bytes.assign(view.bytes.begin(), view.bytes.end());
    } else if (GltfDocument::is_data_uri(uri)) {
      auto bytes = GltfDocument::decode_data_uri(uri);
      if (!bytes) return builder_.refuse(json.path() + ".uri is a damaged data URI", k_gltf_remedy);
      texture.bytes = std::move(*bytes);
    } else {
      texture.uri = texture_uri(GltfDocument::decode_percent(uri), builder_);
    }
    if (texture.mime.empty()) texture.mime = mime_of(texture.bytes);
    if (texture.bytes.empty() && texture.uri.empty()) {
      builder_.notes.add("textures left out", json.path() + " is empty");
    } else {
      out = static_cast<std::uint32_t>(builder_.mesh.textures.size());
      builder_.mesh.textures.push_back(std::move(texture));
    }
    textures_.emplace(index, out);
    return true;
  }

  // Views may overlap, so that a small file could hold many large images.
  bool spend(const JsonValue& json, std::uint64_t bytes) {
    image_bytes_ += bytes;
    return image_bytes_ <= document_.stored_bytes() ||
           builder_.refuse(json.path() + ": its images overlap", k_gltf_remedy);
  }

  GltfDocument& document_;
  MeshBuilder& builder_;
  std::map<std::uint32_t, std::uint32_t> textures_;  // by image
  std::uint64_t image_bytes_ = 0;
};

}  // namespace

bool read_materials(GltfDocument& document, GltfMaterials& out) {
  MaterialReader reader(document);
  const JsonValue materials = document.root()["materials"];
  out.uv.resize(materials.size());
  for (std::size_t i = 0; i < materials.size(); ++i) {
    if (!reader.read(materials.at(i), out.uv[i])) return false;
  }
  return true;
}

}  // namespace copse
