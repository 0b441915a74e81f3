#include "lib/formats/import/mesh_builder.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include <fmt/format.h>

namespace copse {
namespace {

constexpr const char* k_mend = "export the mesh again, or drop --strict to leave it out";

// Fills up to `count` triangles with corners that have nothing.
void pad(std::vector<Triangle>& corners, std::size_t count, std::size_t capacity) {
  corners.reserve(capacity);
  corners.resize(count, {k_none, k_none, k_none});
}

bool has_any(const std::vector<Triangle>& corners) {
  return std::any_of(corners.begin(), corners.end(),
                     [](const Triangle& t) { return t[0] != k_none || t[1] != k_none || t[2] != k_none; });
}

}  // namespace

std::string to_text(const Place& place) {
  return fmt::format("{} {}", place.unit, place.number);
}

MeshBuilder::MeshBuilder(std::string file, std::uint64_t bytes, bool strict)
    : file_(std::move(file)), bytes_(bytes), strict_(strict) {}

std::uint32_t MeshBuilder::part(const std::string& object, const std::string& group, std::uint32_t material) {
  if (std::max(object.size(), group.size()) > k_name_length) {
    refuse(fmt::format("the name of an object or group has {} bytes, {} are allowed",
                       std::max(object.size(), group.size()), k_name_length),
           "give objects and groups shorter names");
    return k_none;
  }
  const auto [it, is_new] = parts_.try_emplace({object, group, material}, mesh.parts.size());
  if (!is_new) return it->second;
  part_name_bytes_ += object.size() + group.size();
  if (part_name_bytes_ > std::max(k_part_names_floor, 4 * bytes_)) {
    refuse(fmt::format("the names of its parts take more than {} bytes", part_name_bytes_),
           "give objects and groups shorter names");
    return k_none;
  }
  mesh.parts.push_back({object, group, material});
  return it->second;
}

std::uint32_t MeshBuilder::group(std::string name, std::uint32_t parent) {
  groups_.push_back({std::move(name), parent});
  return static_cast<std::uint32_t>(groups_.size() - 1);
}

void MeshBuilder::close_group(std::uint32_t group) {
  if (!groups_.empty()) group_of_.resize(mesh.triangles.size(), group);
}

void MeshBuilder::reserve(std::uint64_t triangles) {
  // Exactly so at first, then in growing steps: a scene of many small meshes asks often.
  const std::uint64_t capacity = mesh.triangles.capacity();
  if (triangles <= capacity) return;
  mesh.triangles.reserve(std::max(triangles, 2 * capacity));
  mesh.part_of.reserve(mesh.triangles.capacity());
}

bool MeshBuilder::face(std::span<const Corner> corners, std::uint32_t part, const Place& place) {
  if (part == k_none) return false;
  if (corners.size() == 3) {
    const Corner &a = corners[0], &b = corners[1], &c = corners[2];
    if (a.position != b.position && b.position != c.position && c.position != a.position) {
      triangle(a, b, c, part);
      ++faces_;
      return true;
    }
  }
  return polygon(corners, part, place);
}

void MeshBuilder::triangle(const Corner& a, const Corner& b, const Corner& c, std::uint32_t part) {
  const std::size_t before = mesh.triangles.size();
  mesh.triangles.push_back({a.position, b.position, c.position});
  mesh.part_of.push_back(part);
  if ((a.normal & b.normal & c.normal) != k_none && !with_normals_) {
    with_normals_ = true;
    pad(mesh.normal_triangles, before, mesh.triangles.capacity());
  }
  if (with_normals_) mesh.normal_triangles.push_back({a.normal, b.normal, c.normal});
  if ((a.texcoord & b.texcoord & c.texcoord) != k_none && !with_texcoords_) {
    with_texcoords_ = true;
    pad(mesh.texcoord_triangles, before, mesh.triangles.capacity());
  }
  if (with_texcoords_) mesh.texcoord_triangles.push_back({a.texcoord, b.texcoord, c.texcoord});
  if (numbered_) mesh.face_of.push_back(static_cast<std::uint32_t>(faces_));
}

// From here on a triangle's number is no longer its face's.
void MeshBuilder::number_faces() {
  if (numbered_) return;
  numbered_ = true;
  mesh.face_of.reserve(mesh.triangles.capacity());
  mesh.face_of.resize(mesh.triangles.size());
  std::iota(mesh.face_of.begin(), mesh.face_of.end(), 0u);
}

bool MeshBuilder::polygon(std::span<const Corner> corners, std::uint32_t part, const Place& place) {
  ring_.clear();
  for (const Corner& corner : corners) {
    if (ring_.empty() || ring_.back().position != corner.position) ring_.push_back(corner);
  }
  while (ring_.size() > 1 && ring_.back().position == ring_.front().position) ring_.pop_back();
  number_faces();
  const std::size_t before = mesh.triangles.size();
  if (ring_.size() >= 3) cut_ring(part);
  if (mesh.triangles.size() == before)
    return drop_face(place, [&] {
      return fmt::format("the face has {} corners, fewer than 3 of them distinct", corners.size());
    });
  if (cutter_.gave_up())
    notes.add("polygons cut as fans",
              fmt::format("{}: the polygon's {} corners are too entangled to be cut well", to_text(place),
                          ring_.size()));
  if (ring_.size() > 3) ++counts.cut_polygons;
  ++faces_;
  return true;
}

void MeshBuilder::cut_ring(std::uint32_t part) {
  outline_.clear();
  for (const Corner& corner : ring_) outline_.push_back(mesh.positions[corner.position]);
  for (const auto& [a, b, c] : cutter_.cut(outline_)) {
    const Corner &p = ring_[a], &q = ring_[b], &r = ring_[c];
    if (p.position != q.position && q.position != r.position && r.position != p.position)
      triangle(p, q, r, part);
  }
}

bool MeshBuilder::drop(std::string_view kind, std::uint64_t& count, const Place& place,
                       const Reason& reason) {
  if (strict_) return refuse_at(place, reason(), k_mend);
  ++count;
  if (notes.count(kind)) notes.first(kind, fmt::format("{}: {}", to_text(place), reason()));
  return true;
}

bool MeshBuilder::drop_face(const Place& place, const Reason& reason) {
  number_faces();
  ++faces_;
  return drop("faces dropped", counts.dropped_faces, place, reason);
}

bool MeshBuilder::drop_texcoord(const Place& place, const Reason& reason) {
  return drop("texture coordinates dropped", counts.dropped_texcoords, place, reason);
}

bool MeshBuilder::drop_normal(const Place& place, const Reason& reason) {
  return drop("normals dropped", counts.dropped_normals, place, reason);
}

bool MeshBuilder::spoil_normal(std::uint32_t index, const Place& place) {
  if (strict_) return refuse_at(place, "the normal is not finite", k_mend);
  notes.add("normals that are not finite", fmt::format("{}: the normal is not finite", to_text(place)));
  spoilt_normals_.push_back(index);
  return true;
}

bool MeshBuilder::spoil_texcoord(std::uint32_t index, const Place& place) {
  if (strict_) return refuse_at(place, "the texture coordinate is not finite", k_mend);
  notes.add("texture coordinates that are not finite",
            fmt::format("{}: the texture coordinate is not finite", to_text(place)));
  spoilt_texcoords_.push_back(index);
  return true;
}

void MeshBuilder::drop_spoilt(std::vector<std::uint32_t>& spoilt, std::vector<Triangle>& corners,
                              std::uint64_t& count) {
  if (spoilt.empty()) return;
  std::sort(spoilt.begin(), spoilt.end());
  for (Triangle& triangle : corners) {
    for (std::uint32_t& index : triangle) {
      if (index == k_none || !std::binary_search(spoilt.begin(), spoilt.end(), index)) continue;
      index = k_none;
      ++count;
    }
  }
  spoilt.clear();
}

bool MeshBuilder::refuse(std::string what, std::string remedy) {
  if (!error_) error_ = Error{Fault::refused, file_, std::move(what), std::move(remedy)};
  return false;
}

bool MeshBuilder::refuse_at(const Place& place, const std::string& what, std::string remedy) {
  return refuse(fmt::format("{}: {}", to_text(place), what), std::move(remedy));
}

Result<Import> MeshBuilder::finish(MeshFormat format) {
  if (error_) return std::unexpected(*error_);
  drop_spoilt(spoilt_normals_, mesh.normal_triangles, counts.dropped_normals);
  drop_spoilt(spoilt_texcoords_, mesh.texcoord_triangles, counts.dropped_texcoords);
  if (!has_any(mesh.normal_triangles)) mesh.normal_triangles = {};
  if (!has_any(mesh.texcoord_triangles)) mesh.texcoord_triangles = {};
  close_group(k_none);
  Import import;
  import.mesh = std::move(mesh);
  import.undefined_materials = std::move(undefined_materials);
  import.groups = std::move(groups_);
  import.group_of = std::move(group_of_);
  import.format = format;
  import.counts = counts;
  import.warnings = notes.lines();
  import.files = std::move(files);
  return import;
}

}  // namespace copse
