#include "tools/bvfit/volumes_json.h"

#include "lib/analysis/volumes/certify.h"
#include "tools/common/document.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace copse::bvfit {
namespace {

using Json = nlohmann::ordered_json;

Json list(const Double3& v) {
  return {v.x, v.y, v.z};
}
Json list(const std::array<Double3, 3>& axes) {
  return {list(axes[0]), list(axes[1]), list(axes[2])};
}

void put_numbers(Json& j, const Volume<double>& volume) {
  struct Put {
    Json& j;
    void operator()(const DoubleBox& v) const { j["min"] = list(v.min), j["max"] = list(v.max); }
    void operator()(const BoundingSphere<double>& v) const {
      j["center"] = list(v.centre), j["radius"] = v.radius;
    }
    void operator()(const OrientedBox<double>& v) const {
      j["center"] = list(v.centre), j["axes"] = list(v.axes), j["half_extents"] = list(v.half_extents);
    }
    void operator()(const Capsule<double>& v) const {
      j["a"] = list(v.a), j["b"] = list(v.b), j["radius"] = v.radius;
    }
    void operator()(const Cylinder<double>& v) const {
      j["a"] = list(v.a), j["b"] = list(v.b), j["radius"] = v.radius;
    }
    void operator()(const Lozenge<double>& v) const {
      j["origin"] = list(v.origin), j["edge0"] = list(v.edge0), j["edge1"] = list(v.edge1),
      j["radius"] = v.radius;
    }
    void operator()(const Ellipsoid<double>& v) const {
      j["center"] = list(v.centre), j["axes"] = list(v.axes), j["semi_axes"] = list(v.semi_axes);
    }
    void operator()(const Kdop<double>& v) const {
      Json normals = Json::array();
      for (const Double3& n : v.normals) normals.push_back(list(n));
      j["normals"] = std::move(normals), j["min"] = v.min, j["max"] = v.max;
    }
  };
  std::visit(Put{j}, volume);
}

Json volume_json(const FittedVolume& v, bool times) {
  Json j;
  j["type"] = name_of(v.method.kind);
  j["method"] = v.method.name;
  j["volume"] = v.measures.volume;
  if (v.lower_bound > 0 || v.measures.volume == 0) {
    j["lower_bound"] = v.lower_bound;
  } else {
    j["lower_bound"] = nullptr;
  }
  j["fitted"] = v.fitted;
  j["certified"] = v.certified;
  put_numbers(j, to_double(v.volume));
  j["surface"] = v.measures.surface;
  j["mean_width"] = v.measures.mean_width;
  if (!v.support.empty()) {
    Json points = Json::array();
    for (const Double3& p : v.support) points.push_back(list(p));
    j["support"] = std::move(points);
  }
  if (times) j["seconds"] = v.seconds;
  return j;
}

const char* criterion_name(Criterion c) {
  switch (c) {
    case Criterion::volume:
      return "volume";
    case Criterion::weighted:
      return "weighted";
    case Criterion::aspect:
      return "aspect";
    case Criterion::expected:
      break;
  }
  return "expected";
}

std::string motion_json(const SetFit& set) {
  if (set.motion == VolumeMotion::rest) return "";
  return fmt::format("\"motion\":\"envelope\",\"sway\":{},", set.sway);
}

// --- reading
// -------------------------------------------------------------------------------------------------

// Takes members out of a volume; the first that is missing or of the wrong shape is remembered.
class Members {
 public:
  explicit Members(const Json& j) : j_(j) {}

  double number(const char* name) {
    const auto at = j_.find(name);
    if (at == j_.end() || !at->is_number()) return miss(name), 0;
    return at->get<double>();
  }
  Double3 vector(const char* name) { return vector_of(j_.contains(name) ? j_[name] : Json(), name); }
  std::vector<Double3> vectors(const char* name) {
    std::vector<Double3> out;
    if (!j_.contains(name) || !j_[name].is_array()) return miss(name), out;
    for (const auto& v : j_[name]) out.push_back(vector_of(v, name));
    return out;
  }
  std::array<Double3, 3> axes(const char* name) {
    const auto v = vectors(name);
    if (v.size() != 3) return miss(name), std::array<Double3, 3>{};
    return {v[0], v[1], v[2]};
  }
  std::vector<double> numbers(const char* name) {
    std::vector<double> out;
    if (!j_.contains(name) || !j_[name].is_array()) return miss(name), out;
    for (const auto& v : j_[name]) {
      if (!v.is_number()) return miss(name), out;
      out.push_back(v.get<double>());
    }
    return out;
  }
  const std::string& missing() const { return missing_; }

 private:
  Double3 vector_of(const Json& v, const char* name) {
    if (!v.is_array() || v.size() != 3 || !v[0].is_number() || !v[1].is_number() || !v[2].is_number()) {
      return miss(name), Double3{};
    }
    return {v[0].get<double>(), v[1].get<double>(), v[2].get<double>()};
  }
  void miss(const char* name) {
    if (missing_.empty()) missing_ = name;
  }
  const Json& j_;
  std::string missing_;
};

Volume<double> take_volume(VolumeKind kind, Members& m) {
  switch (kind) {
    case VolumeKind::aabb:
      return DoubleBox{m.vector("min"), m.vector("max")};
    case VolumeKind::sphere:
      return BoundingSphere<double>{m.vector("center"), m.number("radius")};
    case VolumeKind::obb:
      return OrientedBox<double>{m.vector("center"), m.axes("axes"), m.vector("half_extents")};
    case VolumeKind::capsule:
      return Capsule<double>{m.vector("a"), m.vector("b"), m.number("radius")};
    case VolumeKind::cylinder:
      return Cylinder<double>{m.vector("a"), m.vector("b"), m.number("radius")};
    case VolumeKind::lozenge:
      return Lozenge<double>{m.vector("origin"), m.vector("edge0"), m.vector("edge1"), m.number("radius")};
    case VolumeKind::ellipsoid:
      return Ellipsoid<double>{m.vector("center"), m.axes("axes"), m.vector("semi_axes")};
    case VolumeKind::kdop:
      break;
  }
  return Kdop<double>{m.vectors("normals"), m.numbers("min"), m.numbers("max")};
}

std::string text_of(const Json& j, const char* name) {
  return j.is_object() && j.contains(name) && j[name].is_string() ? j[name].get<std::string>() : "";
}

constexpr std::string_view k_envelope = " envelope";

Result<ReadSet> read_set(const Json& j, std::size_t index, const std::string& file) {
  ReadSet set;
  if (j.contains("name") && !j["name"].is_string())
    return refuse(file, fmt::format("set {}: its \"name\" is no text", index),
                  "write one, or none for the whole");
  set.name = text_of(j, "name").empty() ? "whole" : text_of(j, "name");
  if (text_of(j, "motion") == "envelope") set.motion = VolumeMotion::envelope;
  if (j.contains("sway") && j["sway"].is_number()) set.sway = j["sway"].get<float>();
  if (set.motion == VolumeMotion::envelope && set.name.ends_with(k_envelope))
    set.name.resize(set.name.size() - k_envelope.size());
  if (!(set.sway >= 0 && set.sway <= 180))
    return refuse(file, fmt::format("set {}: \"sway\" is out of range", index), "write 0 to 180 degrees");
  if (!j.contains("volumes") || !j["volumes"].is_array())
    return refuse(file, fmt::format("set {} has no \"volumes\"", index), "write it as bvfit does");
  return set;
}

// Indices that JSON may hold; k_none for what is none.
std::uint32_t index_of(const Json& j, const char* name) {
  if (!j.is_object() || !j.contains(name) || !j[name].is_number_unsigned()) return k_none;
  return static_cast<std::uint32_t>(std::min<std::uint64_t>(j[name].get<std::uint64_t>(), k_none));
}

std::optional<double> number_of(const Json& j, const char* name) {
  if (!j.contains(name) || !j[name].is_number()) return std::nullopt;
  return j[name].get<double>();
}

Result<ReadVolume> read_volume(const Json& j, const std::string& file, const std::string& place) {
  ReadVolume v;
  v.type = text_of(j, "type"), v.method = text_of(j, "method");
  const auto kind = volume_kind(v.type);
  if (!kind) {
    return refuse(file, fmt::format("{}: type '{}' is unknown", place, v.type),
                  fmt::format("use one of {}", fmt::join(k_volume_names, ", ")));
  }
  Members members(j);
  v.volume = take_volume(*kind, members);
  if (!members.missing().empty()) {
    return refuse(
        file,
        fmt::format("{}: '{}' of this {} is missing or of the wrong shape", place, members.missing(), v.type),
        "write it as bvfit does");
  }
  v.says_volume = number_of(j, "volume"), v.says_bound = number_of(j, "lower_bound");
  return v;
}

}  // namespace

bool find_node_sets(ReadVolumes& v) {
  for (std::uint32_t i = 0; i < v.nodes.size(); ++i) {
    const VolumeNode& n = v.nodes[i];
    if (n.set >= v.sets.size() || n.skip <= i || n.skip > v.nodes.size()) return false;
    if (n.skip == i + 1) continue;
    if (v.sets[n.set].node != k_none) return false;
    v.sets[n.set].node = i;
  }
  return true;
}

std::string volumes_json(const Input& input, std::span<const SetFit> sets, std::span<const VolumeNode> nodes,
                         const Options& options) {
  const auto hull_points = [](const SetFit& set) {
    return set.hull_points ? std::to_string(*set.hull_points) : "null";
  };
  const auto hull_loss = [](const SetFit& set) {
    return set.hull_points && std::isfinite(set.hull_loss) ? Json(set.hull_loss).dump() : "null";
  };
  std::string out =
      fmt::format("{{\"schema\":\"copse.volumes/1\",\"input\":{},\"points\":{},\"hull_points\":{},\n",
                  Json(input.name).dump(-1, ' ', false, Json::error_handler_t::replace), input.points.size(),
                  sets.empty() ? "null" : hull_points(sets.front()));
  if (input.file && input.tree.header.origin != Double3{})
    out += fmt::format(" \"origin\":{},\n", list(input.tree.header.origin).dump());
  out += " \"sets\":[\n";
  for (std::size_t s = 0; s < sets.size(); ++s) {
    const SetFit& set = sets[s];
    out += fmt::format(
        "  "
        "{{\"name\":{},{}\"points\":{},\"hull_points\":{},\"hull_loss\":{},\"chosen\":{},\"criterion\":\"{}"
        "\",\"volumes\":[\n",
        Json(set.name).dump(-1, ' ', false, Json::error_handler_t::replace), motion_json(set), set.points,
        hull_points(set), hull_loss(set), set.chosen, criterion_name(options.choose));
    for (std::size_t v = 0; v < set.volumes.size(); ++v) {
      out += "   " + volume_json(set.volumes[v], options.times).dump() +
             (v + 1 < set.volumes.size() ? ",\n" : "\n");
    }
    out += s + 1 < sets.size() ? "  ]},\n" : "  ]}\n";
  }
  out += nodes.empty() ? " ]" : " ],\n \"nodes\":[\n";
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    out += fmt::format("  {{\"skip\":{},\"set\":{}}}{}", nodes[i].skip, nodes[i].set,
                       i + 1 < nodes.size() ? ",\n" : "\n ]");
  }
  return out + "}\n";
}

Result<ReadVolumes> read_volumes_json(const std::string& text, const std::string& file) {
  const auto document = parse_document(text, file);
  if (!document) return std::unexpected(document.error());
  const Json& j = *document;
  if (!j.is_object())
    return refuse(file, "this is no JSON object", "name a volumes file (bvfit -o oak.volumes.json)");
  if (!j.contains("sets") || !j["sets"].is_array())
    return refuse(file, "it has no \"sets\"", "name a volumes file (schema copse.volumes/1)");
  ReadVolumes volumes;
  for (const auto& s : j["sets"]) {
    auto set = read_set(s, volumes.sets.size(), file);
    if (!set) return std::unexpected(set.error());
    for (const auto& v : s["volumes"]) {
      auto volume = read_volume(v, file, fmt::format("set '{}', volume {}", set->name, set->volumes.size()));
      if (!volume) return std::unexpected(volume.error());
      set->volumes.push_back(std::move(*volume));
    }
    volumes.sets.push_back(std::move(*set));
  }
  if (j.contains("nodes") && j["nodes"].is_array()) {
    for (const auto& n : j["nodes"])
      volumes.nodes.push_back({index_of(n, "skip"), k_none, index_of(n, "set")});
  }
  if (!find_node_sets(volumes))
    return refuse(file, "its \"nodes\" are no hierarchy over the sets", "write them as bvfit does");
  return volumes;
}

}  // namespace copse::bvfit
