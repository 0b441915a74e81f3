#include "lib/formats/import/gltf/primitive.h"

#include "lib/formats/import/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include <fmt/format.h>

namespace copse {
namespace {

constexpr std::uint64_t k_list = 4, k_strip = 5, k_fan = 6;

}  // namespace

bool PrimitiveReader::read(std::uint32_t mesh, const Affine& transform, const GltfSkin& skin,
                           const std::string& object) {
  if (mesh != mesh_) decoded_.clear();
  mesh_ = mesh;
  transform_ = skin.joints.empty() ? transform : skin.joints[0];
  skin_ = &skin;
  positions_.clear();
  normals_.clear();
  texcoords_.clear();
  const JsonValue json = document_.root()["meshes"].at(mesh);
  const std::string group = to_utf8(json["name"].text());
  const JsonValue primitives = json["primitives"];
  for (std::size_t i = 0; i < primitives.size(); ++i) {
    if (!primitive(primitives.at(i), object.empty() ? group : object, group)) return false;
  }
  return true;
}

bool PrimitiveReader::primitive(const JsonValue& json, const std::string& object, const std::string& group) {
  std::uint64_t mode = k_list;
  std::uint32_t material = k_none;
  if (!json["mode"].read(mode, builder_) ||
      !json["material"].read_index(material, materials_.uv.size(), builder_))
    return false;
  if (mode > k_fan) return builder_.refuse(fmt::format("{}.mode is {}", json.path(), mode), k_gltf_remedy);
  if (mode < k_list) {
    builder_.notes.add("primitives of lines and points skipped", json.path() + " has no triangles");
    return true;
  }
  const JsonValue attributes = json["attributes"];
  if (!attributes["POSITION"].exists()) {
    builder_.notes.add("primitives without positions skipped", json.path() + " has no POSITION");
    return true;
  }
  if (json["targets"].size() > 0)
    builder_.notes.add("morph targets left out", json.path() + " is read without its morph targets");
  if (attributes["COLOR_0"].exists())
    builder_.notes.add("vertex colours left out", json.path() + " is read without COLOR_0");
  Source source;
  Corner base;
  std::vector<std::uint32_t> order;
  if (!open(json, source) || !joints(source) || !positions(source, base.position) ||
      !normals(source, base.normal) || !texcoords(source, material, base.texcoord) ||
      !vertex_order(json, source, order))
    return false;
  const std::uint32_t part = builder_.part(object, group, material);
  return part != k_none && triangles(order, source.draco ? k_list : mode, source, base, part);
}

bool PrimitiveReader::open(const JsonValue& json, Source& source) {
  source.path = json.path();
  source.attributes = json["attributes"];
  const JsonValue extension = json["extensions"]["KHR_draco_mesh_compression"];
  if (extension.exists()) return open_draco(extension, source);
  std::uint32_t index = k_none;
  GltfAccessor accessor;
  if (!source.attributes["POSITION"].read_index(index, document_.root()["accessors"].size(), builder_) ||
      !open_accessor(document_, index, accessor, true))
    return false;
  source.vertices = static_cast<std::uint32_t>(accessor.count);
  return true;
}

bool PrimitiveReader::open_draco(const JsonValue& json, Source& source) {
  for (const auto& [name, value] : json["attributes"].members()) {
    std::uint64_t id = 0;
    if (!value.read(id, builder_)) return false;
    source.draco_ids[name] = static_cast<std::uint32_t>(std::min<std::uint64_t>(id, k_none));
  }
  const std::size_t views = document_.root()["bufferViews"].size();
  if (!json["bufferView"].read_index(source.draco_view, views, builder_)) return false;
  if (source.draco_view == k_none)
    return builder_.refuse(json.path() + ".bufferView is missing", k_gltf_remedy);
  if (!draco_mesh(source.draco_view, source.draco)) return false;
  source.vertices = source.draco->points();
  return true;
}

bool PrimitiveReader::draco_mesh(std::uint32_t view_index, std::shared_ptr<const DracoMesh>& out) {
  if (const auto it = decoded_.find(view_index); it != decoded_.end()) {
    out = it->second;
    return true;
  }
  GltfDocument::View view;
  if (!document_.view(view_index, view)) return false;
  auto mesh = std::make_shared<DracoMesh>();
  if (const std::string reason = mesh->decode(view.bytes); !reason.empty())
    return builder_.refuse(fmt::format("bufferViews[{}] {}", view_index, reason), k_gltf_remedy);
  out = decoded_[view_index] = std::move(mesh);
  return true;
}

// Fills `out` with an attribute that the primitive has.
template <class Number>
bool PrimitiveReader::numbers(const Source& source, const std::string& name, std::uint32_t components,
                              std::span<Number> out) {
  std::uint32_t index = k_none;
  GltfAccessor accessor;
  const auto id = source.draco_ids.find(name);
  const bool compressed = id != source.draco_ids.end();
  if (!source.attributes[name.c_str()].read_index(index, document_.root()["accessors"].size(), builder_) ||
      !open_accessor(document_, index, accessor, compressed))
    return false;
  const auto refuse = [&](const std::string& what) {
    return builder_.refuse(fmt::format("{}: {}: {}", source.path, name, what), k_gltf_remedy);
  };
  if (accessor.components < components) return refuse(accessor.path + " has too few components");
  if (compressed)
    return source.draco->numbers(id->second, components, out) ||
           refuse(fmt::format("its Draco mesh has no such attribute {}", id->second));
  if (accessor.count != source.vertices)
    return refuse(
        fmt::format("{} has {} elements for {} vertices", accessor.path, accessor.count, source.vertices));
  read_numbers(accessor, components, out);
  return true;
}

bool PrimitiveReader::place_attribute(const Source& source, const std::string& name, std::uint32_t variant,
                                      std::size_t next, Shared& known, std::uint32_t& base) {
  std::uint32_t index = k_none;
  if (!source.attributes[name.c_str()].read_index(index, document_.root()["accessors"].size(), builder_))
    return false;
  if (index == k_none) return true;
  if (!within_limit(next + source.vertices)) return false;
  const std::uint32_t view = source.draco_ids.contains(name) ? source.draco_view : k_none;
  base = known.try_emplace({view, index, variant}, static_cast<std::uint32_t>(next)).first->second;
  return true;
}

bool PrimitiveReader::within_limit(std::uint64_t total) {
  const std::uint64_t limit =
      std::min<std::uint64_t>(std::max(limit_, document_.stored_bytes()), k_most_elements);
  return total <= limit ||
         builder_.refuse(fmt::format("its scene has more than {} triangles or vertices", limit),
                         "instance fewer copies of its meshes");
}

bool PrimitiveReader::joints(const Source& source) {
  joints_.clear();
  weights_.clear();
  if (skin_->joints.empty() || !source.attributes["JOINTS_0"].exists() ||
      !source.attributes["WEIGHTS_0"].exists())
    return true;
  if (!within_limit(source.vertices)) return false;
  joints_.resize(std::size_t{source.vertices} * 4);
  weights_.resize(std::size_t{source.vertices} * 4);
  return numbers(source, "JOINTS_0", 4, std::span<double>(joints_)) &&
         numbers(source, "WEIGHTS_0", 4, std::span<double>(weights_));
}

Affine PrimitiveReader::place(std::size_t vertex) const {
  return joints_.empty() ? transform_ : skin_->blend(&joints_[4 * vertex], &weights_[4 * vertex]);
}

bool PrimitiveReader::positions(const Source& source, std::uint32_t& base) {
  std::vector<Double3>& out = builder_.mesh.positions;
  const std::size_t next = out.size();
  if (!place_attribute(source, "POSITION", 0, next, positions_, base)) return false;
  if (base != next || source.vertices == 0) return true;
  out.resize(next + source.vertices);
  if (!numbers(source, "POSITION", 3,
               std::span<double>(&out.data()[next].x, std::size_t{source.vertices} * 3)))
    return false;
  for (std::size_t i = 0; i < source.vertices; ++i) {
    Double3& p = out[next + i];
    if (!is_finite(p))
      return builder_.refuse(fmt::format("{}: vertex {} is not finite", source.path, i), k_gltf_remedy);
    if (!joints_.empty() || transform_ != Affine{}) p = place(i).point(p);
    if (!is_finite(p))
      return builder_.refuse(
          fmt::format("{}: vertex {} is not finite where its node puts it", source.path, i), k_gltf_remedy);
  }
  return true;
}

bool PrimitiveReader::normals(const Source& source, std::uint32_t& base) {
  std::vector<Float3>& out = builder_.mesh.normals;
  const std::size_t next = out.size();
  if (!place_attribute(source, "NORMAL", 0, next, normals_, base)) return false;
  if (base != next || source.vertices == 0) return true;
  out.resize(next + source.vertices);
  if (!numbers(source, "NORMAL", 3, std::span<float>(&out.data()[next].x, std::size_t{source.vertices} * 3)))
    return false;
  const std::string unit = source.path + ": normal";
  for (std::size_t i = 0; i < source.vertices; ++i) {
    Float3& n = out[next + i];
    if (!joints_.empty() || transform_ != Affine{}) {
      const Affine m = place(i);
      const double sign = m.determinant() < 0 ? -1 : 1;
      n = to_float(normalized(m.normal(to_double(n)) * sign, {}));
    }
    if (is_finite(n)) continue;
    n = {};
    if (!builder_.spoil_normal(static_cast<std::uint32_t>(next + i), {unit.c_str(), i})) return false;
  }
  return true;
}

bool PrimitiveReader::texcoords(const Source& source, std::uint32_t material, std::uint32_t& base) {
  const UvTransform uv = material == k_none ? UvTransform{} : materials_.uv[material];
  const std::uint32_t variant = uv == UvTransform{.set = uv.set} ? k_none : material;
  const std::string name = fmt::format("TEXCOORD_{}", uv.set);
  std::vector<Float2>& out = builder_.mesh.texcoords;
  const std::size_t next = out.size();
  if (!place_attribute(source, name, variant, next, texcoords_, base)) return false;
  if (base != next || source.vertices == 0) return true;
  out.resize(next + source.vertices);
  if (!numbers(source, name, 2, std::span<float>(&out.data()[next].x, std::size_t{source.vertices} * 2)))
    return false;
  const std::string unit = source.path + ": texture coordinate";
  for (std::size_t i = 0; i < source.vertices; ++i) {
    Float2& t = out[next + i];
    const double u = uv.m[0] * t.x + uv.m[1] * t.y + uv.m[2];
    const double v = uv.m[3] * t.x + uv.m[4] * t.y + uv.m[5];
    t = {static_cast<float>(u), static_cast<float>(1 - v)};  // v runs down in glTF
    if (std::isfinite(t.x) && std::isfinite(t.y)) continue;
    t = {};
    if (!builder_.spoil_texcoord(static_cast<std::uint32_t>(next + i), {unit.c_str(), i})) return false;
  }
  return true;
}

bool PrimitiveReader::vertex_order(const JsonValue& json, const Source& source,
                                   std::vector<std::uint32_t>& out) {
  if (source.draco) {
    source.draco->indices(out);
    return true;
  }
  std::uint32_t index = k_none;
  if (!json["indices"].read_index(index, document_.root()["accessors"].size(), builder_)) return false;
  if (index == k_none) {
    out.resize(source.vertices);
    std::iota(out.begin(), out.end(), 0u);
    return true;
  }
  GltfAccessor accessor;
  return open_accessor(document_, index, accessor) && within_limit(accessor.count / 3) &&
         read_indices(document_, accessor, out);
}

bool PrimitiveReader::triangles(std::span<const std::uint32_t> order, std::uint64_t mode,
                                const Source& source, const Corner& base, std::uint32_t part) {
  const std::size_t count = mode == k_list ? order.size() / 3 : order.size() < 3 ? 0 : order.size() - 2;
  if (mode == k_list && order.size() % 3 != 0)
    builder_.notes.add("incomplete triangles skipped",
                       fmt::format("{}: {} indices are no whole triangles", source.path, order.size()));
  if (!within_limit(builder_.mesh.triangles.size() + count)) return false;
  builder_.reserve(builder_.mesh.triangles.size() + count);
  const bool mirrored = transform_.determinant() < 0;
  const std::string unit = source.path + ": triangle";
  for (std::size_t i = 0; i < count; ++i) {
    std::array<std::uint32_t, 3> t{};
    if (mode == k_list) {
      t = {order[3 * i], order[3 * i + 1], order[3 * i + 2]};
    } else {
      // Strips and fans as the specification lists them; a strip turns its corners round every other time.
      t = mode == k_strip ? std::array{order[i], order[i + 1 + i % 2], order[i + 2 - i % 2]}
                          : std::array{order[0], order[i + 1], order[i + 2]};
      if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;  // strips are stitched with these
    }
    if (mirrored) std::swap(t[1], t[2]);
    const Place place{unit.c_str(), i};
    const std::uint32_t most = std::max({t[0], t[1], t[2]});
    if (most >= source.vertices) {
      if (!builder_.drop_face(place,
                              [&] { return fmt::format("names vertex {} of {}", most, source.vertices); }))
        return false;
      continue;
    }
    std::array<Corner, 3> corners;
    for (std::size_t c = 0; c < 3; ++c) {
      corners[c].position = base.position + t[c];
      if (base.normal != k_none) corners[c].normal = base.normal + t[c];
      if (base.texcoord != k_none) corners[c].texcoord = base.texcoord + t[c];
    }
    if (!builder_.face(corners, part, place)) return false;
  }
  return true;
}

}  // namespace copse
