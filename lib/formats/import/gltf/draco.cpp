#include "lib/formats/import/gltf/draco.h"

#include <algorithm>
#include <optional>
#include <utility>

#include <draco/compression/decode.h>
#include <fmt/format.h>

namespace copse {
namespace {

// Reads just enough of a bitstream to know how large its mesh is before the decoder takes memory for it.
class Peek {
 public:
  explicit Peek(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  std::uint8_t byte() {
    if (at_ >= bytes_.size()) return good_ = false, std::uint8_t{0};
    return bytes_[at_++];
  }
  void skip(std::uint64_t count) {
    good_ = good_ && count <= bytes_.size() - at_;
    if (good_) at_ += count;
  }
  std::uint64_t varint() {
    std::uint64_t value = 0;
    for (int shift = 0; shift < 35; shift += 7) {
      const std::uint8_t b = byte();
      value |= std::uint64_t{b & 0x7fu} << shift;
      if (b < 0x80) return value;
    }
    good_ = false;
    return 0;
  }
  // Metadata lie in preorder, so counting those still to come is enough.
  void skip_metadata() {
    for (std::uint64_t attributes = varint(); good_ && attributes > 0; --attributes) {
      varint();
      skip_one_metadata();
    }
    skip_one_metadata();
  }
  bool good() const { return good_; }

 private:
  void skip_one_metadata() {
    for (std::uint64_t pending = 1, first = 1; good_ && pending > 0; --pending, first = 0) {
      if (first == 0) skip(byte());  // its name
      for (std::uint64_t entries = varint(); good_ && entries > 0; --entries) {
        skip(byte());
        skip(varint());
      }
      pending += varint();
    }
  }

  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
  bool good_ = true;
};

// What is wrong with the header, or nothing.
std::string check_header(std::span<const std::uint8_t> bytes) {
  constexpr std::size_t k_fixed = 11;
  if (bytes.size() < k_fixed || !std::equal(bytes.begin(), bytes.begin() + 5, "DRACO"))
    return "is no Draco bitstream";
  if (bytes[5] != 2 || bytes[6] != 2)
    return fmt::format("is a Draco bitstream of version {}.{}, and glTF allows 2.2 only", bytes[5], bytes[6]);
  if (bytes[7] != 1) return "is a Draco point cloud, no mesh";
  Peek peek(bytes.subspan(k_fixed));
  if ((bytes[10] & 0x80) != 0) peek.skip_metadata();
  const bool edgebreaker = bytes[8] == 1;
  if (edgebreaker) peek.byte();  // kind of traversal
  const std::uint64_t first = peek.varint();
  const std::uint64_t second = peek.varint();
  if (!peek.good()) return "ends in the middle of its header";
  const std::uint64_t points = edgebreaker ? first : second;
  const std::uint64_t faces = edgebreaker ? second : first;
  const std::uint64_t most = std::max<std::uint64_t>(k_draco_floor, k_draco_ratio * bytes.size());
  if (points > most || faces > most)
    return fmt::format("claims {} points and {} faces in {} bytes", points, faces, bytes.size());
  return {};
}

}  // namespace

struct DracoMesh::Impl {
  std::unique_ptr<draco::Mesh> mesh;

  template <class Number>
  bool numbers(std::uint32_t id, std::uint32_t components, std::span<Number> out) const {
    const draco::PointAttribute* attribute = mesh->GetAttributeByUniqueId(id);
    if (attribute == nullptr || attribute->num_components() < static_cast<int>(components)) return false;
    const std::uint32_t points = mesh->num_points();
    for (std::uint32_t i = 0; i < points; ++i) {
      const draco::AttributeValueIndex value = attribute->mapped_index(draco::PointIndex(i));
      if (value.value() >= attribute->size() ||
          !attribute->ConvertValue(value, static_cast<std::int8_t>(components),
                                   out.data() + std::size_t{i} * components))
        return false;
    }
    return true;
  }
};

DracoMesh::DracoMesh() : impl_(std::make_unique<Impl>()) {}
DracoMesh::~DracoMesh() = default;

std::string DracoMesh::decode(std::span<const std::uint8_t> bytes) {
  if (std::string reason = check_header(bytes); !reason.empty()) return reason;
  try {
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    draco::Decoder decoder;
    auto mesh = decoder.DecodeMeshFromBuffer(&buffer);
    if (!mesh.ok()) return fmt::format("cannot be decoded: {}", mesh.status().error_msg_string());
    impl_->mesh = std::move(mesh).value();
  } catch (const std::exception& e) {
    return fmt::format("cannot be decoded: {}", e.what());
  }
  return {};
}

std::uint32_t DracoMesh::points() const {
  return impl_->mesh->num_points();
}

void DracoMesh::indices(std::vector<std::uint32_t>& out) const {
  const std::uint32_t faces = impl_->mesh->num_faces();
  out.clear();
  out.reserve(std::size_t{faces} * 3);
  for (std::uint32_t i = 0; i < faces; ++i) {
    for (const draco::PointIndex& point : impl_->mesh->face(draco::FaceIndex(i)))
      out.push_back(point.value());
  }
}

bool DracoMesh::numbers(std::uint32_t id, std::uint32_t components, std::span<double> out) const {
  return impl_->numbers(id, components, out);
}

bool DracoMesh::numbers(std::uint32_t id, std::uint32_t components, std::span<float> out) const {
  return impl_->numbers(id, components, out);
}

}  // namespace copse
