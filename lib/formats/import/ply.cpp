#include "lib/formats/import/ply.h"

#include "lib/formats/import/companions.h"
#include "lib/formats/import/ply_cursor.h"
#include "lib/formats/import/ply_header.h"
#include "lib/formats/import/text.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <vector>

#include <fmt/format.h>

namespace copse {
namespace {

enum Role : std::size_t { x, y, z, nx, ny, nz, u, v, nothing };

Role role_of(const std::string& name) {
  static constexpr std::array<std::pair<std::string_view, Role>, 16> k_roles{{{"x", x},
                                                                              {"y", y},
                                                                              {"z", z},
                                                                              {"nx", nx},
                                                                              {"ny", ny},
                                                                              {"nz", nz},
                                                                              {"u", u},
                                                                              {"v", v},
                                                                              {"s", u},
                                                                              {"t", v},
                                                                              {"texture_u", u},
                                                                              {"texture_v", v},
                                                                              {"texcoord_u", u},
                                                                              {"texcoord_v", v},
                                                                              {"tu", u},
                                                                              {"tv", v}}};
  for (const auto& [known, role] : k_roles) {
    if (known == name) return role;
  }
  return nothing;
}

constexpr const char* k_remedy = "export the mesh again";

template <class Cursor>
class BodyReader {
 public:
  BodyReader(std::string_view text, const PlyHeader& header, MeshBuilder& builder)
      : cursor_(text, header), header_(header), builder_(builder), mesh_(builder.mesh) {}

  bool read() {
    add_materials();
    std::vector<std::pair<const PlyElement*, Cursor>> early;  // faces that come before their vertices
    bool has_vertices = false;
    for (const PlyElement& element : header_.elements) {
      if (!plausible(element)) return false;
      const bool faces = element.name == "face" || element.name == "tristrips";
      if (element.name == "vertex") {
        if (has_vertices) return builder_.refuse("has two elements 'vertex'", k_remedy);
        has_vertices = true;
        if (!vertices(element)) return false;
      } else if (faces && has_vertices) {
        if (!polygons(element)) return false;
      } else {
        if (faces) early.emplace_back(&element, cursor_);
        if (!skip(element)) return false;
      }
    }
    if (!has_vertices) return builder_.refuse("has no element 'vertex'", k_remedy);
    if (!cursor_.at_end()) builder_.notes.add("bytes after the end", "data follow the last element");
    for (auto& [element, start] : early) {
      cursor_ = start;
      if (!polygons(*element)) return false;
    }
    return true;
  }

 private:
  Place place(const char* unit) const {
    return Cursor::k_lines ? Place{"line", cursor_.line()} : Place{unit, row_};
  }
  bool refuse(const PlyElement& element, const std::string& what) {
    return builder_.refuse_at(place(element.name.c_str()), what, k_remedy);
  }

  // Before memory is taken for a count, the file must be long enough for it.
  bool plausible(const PlyElement& element) {
    const std::uint64_t row = element.least_row(header_.format);
    if (row == 0 || element.count <= cursor_.left() / row) return true;
    return builder_.refuse(fmt::format("claims {} of element {}, but only {} bytes are left for them",
                                       element.count, in_quotes(element.name), cursor_.left()),
                           "copy the file again: its end is missing");
  }

  bool number(const PlyElement& element, PlyType type, double& value, bool& finite) {
    const Scan scan = cursor_.number(type, value);
    finite = scan != Scan::not_finite;
    if (scan == Scan::good || !finite) return true;
    if (scan == Scan::none)
      return builder_.refuse(fmt::format("ends in {} {} of {}", element.name, row_, element.count),
                             "copy the file again: its end is missing");
    return refuse(element, fmt::format("{} {} holds what is not a number", element.name, row_));
  }

  bool count(const PlyElement& element, const PlyProperty& property, std::uint64_t& out) {
    double value = 0;
    bool finite = true;
    if (!number(element, property.count_type, value, finite)) return false;
    const std::uint64_t most =
        cursor_.left() / (header_.format == PlyFormat::ascii ? 2 : size_of(property.type));
    if (!finite || value < 0 || value != std::floor(value) || value > static_cast<double>(most))
      return refuse(element, fmt::format("{} {}: a list of {} does not fit into the rest of the file",
                                         element.name, row_, value));
    out = static_cast<std::uint64_t>(value);
    return true;
  }

  bool skip_property(const PlyElement& element, const PlyProperty& property) {
    std::uint64_t items = 1;
    if (property.list && !count(element, property, items)) return false;
    double value = 0;
    bool finite = true;
    while (items-- > 0) {
      if (!number(element, property.type, value, finite)) return false;
    }
    return true;
  }

  bool skip(const PlyElement& element) {
    if (element.properties.empty()) return true;
    for (row_ = 0; row_ < element.count; ++row_) {
      for (const PlyProperty& property : element.properties) {
        if (!skip_property(element, property)) return false;
      }
    }
    return true;
  }

  bool vertices(const PlyElement& element) {
    std::array<bool, 9> has{};
    std::vector<Role> roles;
    for (const PlyProperty& property : element.properties) {
      roles.push_back(property.list ? nothing : role_of(property.name));
      has[roles.back()] = true;
    }
    if (!has[x] || !has[y] || !has[z]) return builder_.refuse("its vertices lack x, y or z", k_remedy);
    with_normals_ = has[nx] && has[ny] && has[nz];
    with_texcoords_ = has[u] && has[v];
    mesh_.positions.reserve(element.count);
    if (with_normals_) mesh_.normals.reserve(element.count);
    if (with_texcoords_) mesh_.texcoords.reserve(element.count);
    for (row_ = 0; row_ < element.count; ++row_) {
      std::array<double, 9> value{};
      std::array<bool, 9> finite;
      finite.fill(true);
      for (std::size_t i = 0; i < roles.size(); ++i) {
        const PlyProperty& property = element.properties[i];
        const bool good = property.list ? skip_property(element, property)
                                        : number(element, property.type, value[roles[i]], finite[roles[i]]);
        if (!good) return false;
      }
      if (!finite[x] || !finite[y] || !finite[z])
        return refuse(element, fmt::format("vertex {} is not finite", row_));
      mesh_.positions.push_back({value[x], value[y], value[z]});
      if (with_normals_ &&
          !normal(to_float({value[nx], value[ny], value[nz]}), finite[nx] && finite[ny] && finite[nz]))
        return false;
      if (with_texcoords_ && !texcoord(value[u], value[v], finite[u] && finite[v])) return false;
    }
    return true;
  }

  bool normal(const Float3& n, bool finite) {
    finite = finite && is_finite(n);
    mesh_.normals.push_back(finite ? n : Float3{});
    return finite ||
           builder_.spoil_normal(static_cast<std::uint32_t>(mesh_.normals.size() - 1), place("vertex"));
  }

  bool texcoord(double s, double t, bool finite) {
    const Float2 uv{static_cast<float>(s), static_cast<float>(t)};
    finite = finite && std::isfinite(uv.x) && std::isfinite(uv.y);
    mesh_.texcoords.push_back(finite ? uv : Float2{});
    return finite ||
           builder_.spoil_texcoord(static_cast<std::uint32_t>(mesh_.texcoords.size() - 1), place("vertex"));
  }

  // Faces and triangle strips.
  bool polygons(const PlyElement& element) {
    const bool strips = element.name == "tristrips";
    const auto named = [&](std::string_view a, std::string_view b, bool list) -> const PlyProperty* {
      const auto it =
          std::find_if(element.properties.begin(), element.properties.end(),
                       [&](const PlyProperty& p) { return p.list == list && (p.name == a || p.name == b); });
      return it == element.properties.end() ? nullptr : &*it;
    };
    const PlyProperty* indices = named("vertex_indices", "vertex_index", true);
    const PlyProperty* uvs = named("texcoord", "texcoords", true);
    const PlyProperty* texture = named("texnumber", "material_index", false);
    if (indices == nullptr || !is_integer(indices->type)) {
      if (element.count > 0)
        return builder_.refuse(
            fmt::format("its element '{}' has no list vertex_indices of whole numbers", element.name),
            k_remedy);
      return true;
    }
    if (!strips) builder_.reserve(builder_.mesh.triangles.size() + element.count);
    for (row_ = 0; row_ < element.count; ++row_) {
      corners_.clear();
      uvs_.clear();
      double material = 0;
      bool finite = true;
      for (const PlyProperty& property : element.properties) {
        const bool good = &property == indices   ? list(element, property, corners_)
                          : &property == uvs     ? list(element, property, uvs_)
                          : &property == texture ? number(element, property.type, material, finite)
                                                 : skip_property(element, property);
        if (!good) return false;
      }
      const std::uint32_t part = part_of(finite ? material : -1);
      if (part == k_none || !(strips ? strip(part) : face(part))) return false;
    }
    return true;
  }

  // A list whose numbers are not finite gets an infinity, which no index and no texture coordinate is.
  bool list(const PlyElement& element, const PlyProperty& property, std::vector<double>& out) {
    std::uint64_t items = 0;
    if (!count(element, property, items)) return false;
    out.resize(items);
    for (double& value : out) {
      bool finite = true;
      if (!number(element, property.type, value, finite)) return false;
      if (!finite) value = HUGE_VAL;
    }
    return true;
  }

  bool corner(double index, Corner& out) {
    if (!(index >= 0) || !(index < static_cast<double>(mesh_.positions.size())) || index != std::floor(index))
      return false;
    const auto i = static_cast<std::uint32_t>(index);
    out = {i, with_texcoords_ ? i : k_none, with_normals_ ? i : k_none};
    return true;
  }

  bool face(std::uint32_t part) {
    ring_.clear();
    for (const double index : corners_) {
      Corner out;
      if (!corner(index, out))
        return builder_.drop_face(place("face"), [&] {
          return fmt::format("the face names vertex {} of {}", index, mesh_.positions.size());
        });
      ring_.push_back(out);
    }
    if (uvs_.size() == 2 * ring_.size()) {
      for (std::size_t i = 0; i < ring_.size(); ++i) {
        if (!texcoord(uvs_[2 * i], uvs_[2 * i + 1], true)) return false;
        ring_[i].texcoord = static_cast<std::uint32_t>(mesh_.texcoords.size() - 1);
      }
    }
    return builder_.face(ring_, part, place("face"));
  }

  // A negative index starts the next strip.
  bool strip(std::uint32_t part) {
    std::size_t start = 0;
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      if (corners_[i] < 0) start = i + 1;
      if (corners_[i] < 0 || i < start + 2) continue;
      const bool odd = (i - start) % 2 != 0;
      const std::array<double, 3> named{corners_[i - 2], corners_[odd ? i : i - 1],
                                        corners_[odd ? i - 1 : i]};
      if (named[0] == named[1] || named[1] == named[2] || named[2] == named[0]) continue;
      std::array<Corner, 3> ring;
      const bool good = corner(named[0], ring[0]) && corner(named[1], ring[1]) && corner(named[2], ring[2]);
      if (good ? !builder_.face(ring, part, place("tristrips"))
               : !builder_.drop_face(place("tristrips"), [] { return "the strip names a missing vertex"; }))
        return false;
    }
    return true;
  }

  void add_materials() {
    for (const std::string& name : header_.textures) {
      const std::string uri = texture_uri(name, builder_);
      Material material{.name = to_utf8(name), .diffuse = {1, 1, 1}};
      if (!uri.empty()) {
        material.texture = static_cast<std::uint32_t>(mesh_.textures.size());
        mesh_.textures.push_back({.uri = uri, .mime = {}, .bytes = {}});
      }
      mesh_.materials.push_back(std::move(material));
    }
  }

  std::uint32_t part_of(double number) {
    const bool known = number >= 0 && number < static_cast<double>(mesh_.materials.size());
    const std::uint32_t material = known ? static_cast<std::uint32_t>(number) : k_none;
    if (part_ == k_none || material != part_material_) {
      part_ = builder_.part("", "", material);
      part_material_ = material;
    }
    return part_;
  }

  Cursor cursor_;
  const PlyHeader& header_;
  MeshBuilder& builder_;
  Mesh& mesh_;
  std::uint64_t row_ = 0;
  bool with_normals_ = false, with_texcoords_ = false;
  std::vector<double> corners_, uvs_;
  std::vector<Corner> ring_;
  std::uint32_t part_ = k_none, part_material_ = k_none;
};

}  // namespace

bool read_ply(std::string_view text, MeshBuilder& builder) {
  PlyHeader header;
  if (!read_ply_header(text, header, builder)) return false;
  for (const PlyElement& element : header.elements) {
    if (element.count > k_most_elements)
      return builder.refuse(fmt::format("claims {} of element {}", element.count, in_quotes(element.name)),
                            k_remedy);
  }
  switch (header.format) {
    case PlyFormat::ascii:
      return BodyReader<AsciiCursor>(text, header, builder).read();
    case PlyFormat::little:
      return BodyReader<BinaryCursor<std::endian::little>>(text, header, builder).read();
    case PlyFormat::big:
      return BodyReader<BinaryCursor<std::endian::big>>(text, header, builder).read();
  }
  return false;
}

}  // namespace copse
