// A glTF asset: its JSON, its buffers and its buffer views, checked before anything is read from them.
#pragma once

#include "lib/formats/import/companions.h"
#include "lib/formats/import/gltf/json.h"

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace copse {

class GltfDocument {
 public:
  GltfDocument(const Companions& companions, MeshBuilder& builder)
      : companions_(companions), builder_(builder) {}

  // Takes a .gltf or .glb apart, checks its version and the extensions that it requires.
  bool open(std::span<const std::uint8_t> bytes);

  JsonValue root() const { return json_.root(); }
  MeshBuilder& builder() const { return builder_; }

  // The bytes of a buffer view, decompressed when it is compressed; stride 0 means tightly packed.
  struct View {
    std::span<const std::uint8_t> bytes;
    std::uint64_t stride = 0;
  };
  bool view(std::uint32_t index, View& out);

  // The bytes of a data URI; nullopt when `uri` is none or is damaged.
  static bool is_data_uri(std::string_view uri) { return uri.starts_with("data:"); }
  static std::optional<std::vector<std::uint8_t>> decode_data_uri(std::string_view uri);
  // "%20" and its kin undone.
  static std::string decode_percent(std::string_view uri);

  // The size of the file and of the buffers that were opened: what memory may be in proportion to.
  std::uint64_t stored_bytes() const { return builder_.bytes() + buffer_bytes_; }

 private:
  bool open_glb(std::span<const std::uint8_t> bytes, std::string_view& json);
  bool check_version();
  bool check_extensions();
  bool buffer(std::uint32_t index, std::span<const std::uint8_t>& out);
  bool load_buffer(std::uint32_t index, Bytes& out);
  bool plain_view(const JsonValue& json, View& out);
  bool compressed_view(const JsonValue& json, std::uint32_t index, View& out);

  const Companions& companions_;
  MeshBuilder& builder_;
  JsonText json_;
  std::optional<std::span<const std::uint8_t>> bin_;  // of a GLB
  std::map<std::uint32_t, Bytes> buffers_;
  std::map<std::uint32_t, std::vector<std::uint8_t>> decoded_views_;
  std::uint64_t buffer_bytes_ = 0;
  std::uint64_t decoded_bytes_ = 0;
};

// The place of a buffer's bytes within it, checked: offset + length <= available.
bool fits(std::uint64_t offset, std::uint64_t length, std::uint64_t available);

inline constexpr const char* k_gltf_remedy = "export the mesh again, or check it with the glTF validator";

}  // namespace copse
