#include "lib/formats/import/gltf/document.h"

#include "lib/formats/import/gltf/meshopt.h"
#include "lib/formats/import/text.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include <fmt/format.h>

namespace copse {
namespace {

// What is understood, or changes neither shape nor anything that a Blinn-Phong material can hold.
constexpr std::array<std::string_view, 23> k_understood{"EXT_mesh_gpu_instancing",
                                                        "EXT_meshopt_compression",
                                                        "EXT_texture_webp",
                                                        "KHR_draco_mesh_compression",
                                                        "KHR_lights_punctual",
                                                        "KHR_materials_anisotropy",
                                                        "KHR_materials_clearcoat",
                                                        "KHR_materials_dispersion",
                                                        "KHR_materials_emissive_strength",
                                                        "KHR_materials_ior",
                                                        "KHR_materials_iridescence",
                                                        "KHR_materials_pbrSpecularGlossiness",
                                                        "KHR_materials_sheen",
                                                        "KHR_materials_specular",
                                                        "KHR_materials_transmission",
                                                        "KHR_materials_unlit",
                                                        "KHR_materials_variants",
                                                        "KHR_materials_volume",
                                                        "KHR_mesh_quantization",
                                                        "KHR_texture_transform",
                                                        "KHR_xmp",
                                                        "KHR_xmp_json_ld",
                                                        "MSFT_lod"};

std::uint32_t read_u32(std::span<const std::uint8_t> bytes, std::size_t at) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, 4);
  return value;
}

int base64_value(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+' || c == '-') return 62;
  return c == '/' || c == '_' ? 63 : -1;
}

std::optional<std::vector<std::uint8_t>> decode_base64(std::string_view text) {
  while (text.ends_with('=')) text.remove_suffix(1);
  std::vector<std::uint8_t> out;
  out.reserve(text.size() / 4 * 3 + 3);
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    const int value = base64_value(c);
    if (value < 0) return std::nullopt;
    bits = (bits << 6) | static_cast<std::uint32_t>(value);
    count += 6;
    if (count >= 8) {
      count -= 8;
      out.push_back(static_cast<std::uint8_t>(bits >> count));
    }
  }
  return out;
}

int hex_value(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

}  // namespace

bool fits(std::uint64_t offset, std::uint64_t length, std::uint64_t available) {
  return offset <= available && length <= available - offset;
}

std::string GltfDocument::decode_percent(std::string_view uri) {
  std::string out;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] == '%' && i + 2 < uri.size() && hex_value(uri[i + 1]) >= 0 && hex_value(uri[i + 2]) >= 0) {
      out += static_cast<char>(hex_value(uri[i + 1]) * 16 + hex_value(uri[i + 2]));
      i += 2;
    } else {
      out += uri[i];
    }
  }
  return out;
}

std::optional<std::vector<std::uint8_t>> GltfDocument::decode_data_uri(std::string_view uri) {
  const std::size_t comma = uri.find(',');
  if (!is_data_uri(uri) || comma == std::string_view::npos) return std::nullopt;
  const std::string_view head = uri.substr(0, comma);
  const std::string_view data = uri.substr(comma + 1);
  if (head.ends_with(";base64")) return decode_base64(data);
  const std::string plain = decode_percent(data);
  return std::vector<std::uint8_t>(plain.begin(), plain.end());
}

bool GltfDocument::open(std::span<const std::uint8_t> bytes) {
  std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (text.starts_with("glTF")) {
    if (!open_glb(bytes, text)) return false;
  } else if (text.starts_with("\xef\xbb\xbf")) {
    text.remove_prefix(3);
  }
  return json_.parse(text, builder_) && check_version() && check_extensions();
}

bool GltfDocument::open_glb(std::span<const std::uint8_t> bytes, std::string_view& json) {
  if (bytes.size() < 20) return builder_.refuse("ends in the middle of its header", "copy the file again");
  const std::uint32_t version = read_u32(bytes, 4);
  if (version != 2)
    return builder_.refuse(fmt::format("is GLB version {}, and only version 2 is read", version),
                           "export it as glTF 2.0");
  const std::uint32_t length = read_u32(bytes, 8);
  if (length > bytes.size())
    return builder_.refuse(fmt::format("has {} bytes, and its header says {}", bytes.size(), length),
                           "copy the file again: its end is missing");
  if (length < bytes.size())
    builder_.notes.add("bytes after the end",
                       fmt::format("byte {}: bytes follow the end of the GLB", length));
  bytes = bytes.first(length);
  bool has_json = false;
  for (std::uint64_t at = 12; at < bytes.size();) {
    if (!fits(at, 8, bytes.size()))
      return builder_.refuse(fmt::format("byte {}: a chunk's header is cut off", at), "copy the file again");
    const std::uint32_t size = read_u32(bytes, at);
    const std::uint32_t type = read_u32(bytes, at + 4);
    if (!fits(at + 8, size, bytes.size()))
      return builder_.refuse(fmt::format("byte {}: a chunk of {} bytes reaches beyond the end", at, size),
                             "copy the file again");
    const auto chunk = bytes.subspan(at + 8, size);
    if (type == 0x4e4f534a && !has_json) {  // "JSON"
      json = {reinterpret_cast<const char*>(chunk.data()), chunk.size()};
      has_json = true;
    } else if (type == 0x004e4942 && !bin_) {  // "BIN"
      bin_ = chunk;
    }
    at += 8 + std::uint64_t{size};
  }
  return has_json || builder_.refuse("has no JSON chunk", k_gltf_remedy);
}

bool GltfDocument::check_version() {
  const JsonValue asset = root()["asset"];
  std::string version, least;
  if (!asset["version"].read(version, builder_) || !asset["minVersion"].read(least, builder_)) return false;
  if (version.empty() && root()["meshes"].is_object()) version = "1.0";  // it was optional then
  if (version.empty()) builder_.notes.add("missing properties", "asset.version is missing, taken as 2.0");
  if (!version.empty() && !version.starts_with("2."))
    return builder_.refuse(fmt::format("is glTF {}, and only glTF 2 is read", in_quotes(version)),
                           "export it as glTF 2.0");
  if (!least.empty() && least != "2.0")
    return builder_.refuse(fmt::format("needs glTF {}, and only 2.0 is read", in_quotes(least)),
                           "export it as glTF 2.0");
  return true;
}

bool GltfDocument::check_extensions() {
  const JsonValue required = root()["extensionsRequired"];
  for (std::size_t i = 0; i < required.size(); ++i) {
    std::string name;
    if (!required.at(i).read(name, builder_)) return false;
    if (std::find(k_understood.begin(), k_understood.end(), name) == k_understood.end())
      return builder_.refuse(
          fmt::format("requires the extension {}, which is not understood", in_quotes(name)),
          "export the mesh without it");
  }
  return true;
}

bool GltfDocument::load_buffer(std::uint32_t index, Bytes& out) {
  const JsonValue json = root()["buffers"].at(index);
  std::string uri;
  std::uint64_t length = 0;
  if (!json["uri"].read(uri, builder_) || !json["byteLength"].read(length, builder_)) return false;
  if (!json["uri"].exists()) {
    if (!bin_ || index != 0)
      return builder_.refuse(fmt::format("{} has no bytes", json.path()), k_gltf_remedy);
    out = Bytes(*bin_, nullptr);
  } else if (is_data_uri(uri)) {
    auto bytes = decode_data_uri(uri);
    if (!bytes)
      return builder_.refuse(fmt::format("{}.uri is a damaged data URI", json.path()), k_gltf_remedy);
    out = Bytes(std::move(*bytes));
  } else {
    auto bytes = companions_.open(decode_percent(uri), builder_);
    if (!bytes)
      return builder_.refuse(fmt::format("{}: {} {}", json.path(), bytes.error().file, bytes.error().what),
                             "put the buffer beside the mesh");
    out = std::move(*bytes);
  }
  if (out.size() < length)
    return builder_.refuse(fmt::format("{} has {} bytes instead of {}", json.path(), out.size(), length),
                           "copy the file again: its end is missing");
  out = Bytes(out.span().first(length), std::make_shared<Bytes>(out));
  buffer_bytes_ += length;
  return true;
}

bool GltfDocument::buffer(std::uint32_t index, std::span<const std::uint8_t>& out) {
  auto it = buffers_.find(index);
  if (it == buffers_.end()) {
    Bytes bytes;
    if (!load_buffer(index, bytes)) return false;
    it = buffers_.emplace(index, std::move(bytes)).first;
  }
  out = it->second;
  return true;
}

bool GltfDocument::view(std::uint32_t index, View& out) {
  const JsonValue json = root()["bufferViews"].at(index);
  const JsonValue compression = json["extensions"]["EXT_meshopt_compression"];
  return compression.exists() ? compressed_view(compression, index, out) : plain_view(json, out);
}

// Also for the view that EXT_meshopt_compression describes: it has the same members.
bool GltfDocument::plain_view(const JsonValue& json, View& out) {
  std::uint32_t buffer_index = k_none;
  std::uint64_t offset = 0, length = 0;
  if (!json["buffer"].read_index(buffer_index, root()["buffers"].size(), builder_) ||
      !json["byteOffset"].read(offset, builder_) || !json["byteLength"].read(length, builder_) ||
      !json["byteStride"].read(out.stride, builder_))
    return false;
  if (buffer_index == k_none)
    return builder_.refuse(fmt::format("{}.buffer is missing", json.path()), k_gltf_remedy);
  std::span<const std::uint8_t> bytes;
  if (!buffer(buffer_index, bytes)) return false;
  if (!fits(offset, length, bytes.size()))
    return builder_.refuse(fmt::format("{}: bytes {} to {} of a buffer of {}", json.path(), offset,
                                       offset + length, bytes.size()),
                           k_gltf_remedy);
  out.bytes = bytes.subspan(offset, length);
  return true;
}

bool GltfDocument::compressed_view(const JsonValue& json, std::uint32_t index, View& out) {
  auto it = decoded_views_.find(index);
  if (!json["byteStride"].read(out.stride, builder_)) return false;
  if (it == decoded_views_.end()) {
    View packed;
    MeshoptView wanted;
    if (!plain_view(json, packed) || !json["count"].read(wanted.count, builder_) ||
        !json["mode"].read(wanted.mode, builder_) || !json["filter"].read(wanted.filter, builder_))
      return false;
    wanted.stride = out.stride;
    std::vector<std::uint8_t> bytes;
    if (const std::string reason = decode_meshopt(packed.bytes, wanted, bytes); !reason.empty())
      return builder_.refuse(fmt::format("{}: {}", json.path(), reason), k_gltf_remedy);
    decoded_bytes_ += bytes.size();
    if (decoded_bytes_ > k_meshopt_ratio * stored_bytes() + k_meshopt_floor)
      return builder_.refuse(fmt::format("{}: its views inflate to more than {} bytes", json.path(),
                                         k_meshopt_ratio * stored_bytes() + k_meshopt_floor),
                             k_gltf_remedy);
    it = decoded_views_.emplace(index, std::move(bytes)).first;
  }
  out.bytes = it->second;
  return true;
}

}  // namespace copse
