#include "lib/formats/export/glb_geometry.h"

#include <algorithm>
#include <memory>
#include <utility>

#include <draco/compression/decode.h>
#include <draco/compression/encode.h>
#include <draco/mesh/mesh.h>
#include <fmt/format.h>

namespace copse {
namespace {

constexpr int k_normal_bits = 10, k_texcoord_bits = 12;

// Adds an attribute of `n` float32 components, one value a vertex; answers its id.
template <class T>
int add_attribute(draco::Mesh& mesh, draco::GeometryAttribute::Type type, const std::vector<T>& values) {
  constexpr auto k_components = static_cast<std::int8_t>(sizeof(T) / sizeof(float));
  draco::GeometryAttribute attribute;
  attribute.Init(type, nullptr, k_components, draco::DT_FLOAT32, false, sizeof(T), 0);
  const int id = mesh.AddAttribute(attribute, true, static_cast<std::uint32_t>(values.size()));
  for (std::uint32_t v = 0; v < values.size(); ++v) {
    mesh.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(v), &values[v]);
  }
  return id;
}

void fill_mesh(draco::Mesh& mesh, const UnifiedMesh& unified, const std::vector<Float3>& positions,
               const std::vector<Float2>& texcoords, DracoStream& ids) {
  mesh.set_num_points(static_cast<std::uint32_t>(positions.size()));
  mesh.SetNumFaces(unified.triangles.size());
  for (std::uint32_t t = 0; t < unified.triangles.size(); ++t) {
    const Triangle& corners = unified.triangles[t];
    mesh.SetFace(draco::FaceIndex(t), {draco::PointIndex(corners[0]), draco::PointIndex(corners[1]),
                                       draco::PointIndex(corners[2])});
  }
  ids.position = add_attribute(mesh, draco::GeometryAttribute::POSITION, positions);
  if (!unified.normal.empty())
    ids.normal = add_attribute(mesh, draco::GeometryAttribute::NORMAL, unified.normal);
  if (!texcoords.empty()) ids.texcoord = add_attribute(mesh, draco::GeometryAttribute::TEX_COORD, texcoords);
}

// glTF names attributes by their unique ids.
void use_unique_ids(const draco::Mesh& mesh, DracoStream& ids) {
  for (int* id : {&ids.position, &ids.normal, &ids.texcoord}) {
    if (*id >= 0) *id = static_cast<int>(mesh.attribute(*id)->unique_id());
  }
}

// What a reader will find: Draco reorders, merges and quantizes, and a glTF must tell the outcome.
bool look_back(DracoPrimitive& primitive) {
  draco::DecoderBuffer buffer;
  buffer.Init(primitive.bytes.data(), primitive.bytes.size());
  draco::Decoder decoder;
  auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
  if (!decoded.ok()) return false;
  const draco::Mesh& mesh = *decoded.value();
  primitive.vertices = mesh.num_points();
  primitive.triangles = mesh.num_faces();
  const draco::PointAttribute* positions = mesh.GetNamedAttribute(draco::GeometryAttribute::POSITION);
  FloatBox box;
  for (std::uint32_t p = 0; positions != nullptr && p < mesh.num_points(); ++p) {
    Float3 point;
    positions->GetMappedValue(draco::PointIndex(p), &point);
    box.grow(point);
  }
  primitive.bounds = {box.min, box.max};
  return !box.empty() && primitive.triangles > 0;
}

}  // namespace

Result<DracoPrimitive> encode_draco(const UnifiedMesh& unified, const std::vector<Float3>& positions,
                                    const std::vector<Float2>& texcoords, int position_bits) {
  DracoPrimitive primitive;
  draco::Mesh mesh;
  fill_mesh(mesh, unified, positions, texcoords, primitive.ids);
  use_unique_ids(mesh, primitive.ids);
  draco::Encoder encoder;
  encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, std::clamp(position_bits, 1, 30));
  encoder.SetAttributeQuantization(draco::GeometryAttribute::NORMAL, k_normal_bits);
  encoder.SetAttributeQuantization(draco::GeometryAttribute::TEX_COORD, k_texcoord_bits);
  draco::EncoderBuffer buffer;
  const draco::Status status = encoder.EncodeMeshToBuffer(mesh, &buffer);
  if (status.ok()) primitive.bytes.assign(buffer.data(), buffer.size());
  if (!status.ok() || !look_back(primitive)) {
    return refuse(
        "",
        fmt::format("Draco cannot encode a part of this mesh ({})",
                    status.ok() ? "all of its triangles are degenerate" : status.error_msg_string()),
        "export it without Draco");
  }
  return primitive;
}

}  // namespace copse
