#include "lib/formats/import/obj.h"

#include "lib/formats/import/lines.h"
#include "lib/formats/import/mtl.h"
#include "lib/formats/import/text.h"

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace copse {
namespace {

enum class Statement { position, texcoord, normal, face, other };

// Tells the four frequent statements apart by their first letters and steps over the keyword.
Statement classify(const char*& p, const char* end) {
  skip_blanks(p, end);
  const auto left = end - p;
  if (left >= 2 && is_blank(p[1])) {
    if (*p == 'v' || *p == 'f') return ++p, p[-1] == 'v' ? Statement::position : Statement::face;
  } else if (left >= 3 && *p == 'v' && is_blank(p[2])) {
    if (p[1] == 't' || p[1] == 'n') return p += 2, p[-1] == 't' ? Statement::texcoord : Statement::normal;
  }
  return Statement::other;
}

// A face index as written: "12", "-3", and where there is none, 0 (which is no index of an OBJ).
bool scan_index(const char*& p, const char* end, std::int64_t& value) {
  const bool negative = p != end && *p == '-';
  if (negative) ++p;
  const char* start = p;
  std::uint64_t magnitude = 0;
  for (; p != end && *p >= '0' && *p <= '9'; ++p)
    magnitude =
        std::min<std::uint64_t>(magnitude * 10 + static_cast<unsigned>(*p - '0'), std::uint64_t{1} << 40);
  value = negative ? -static_cast<std::int64_t>(magnitude) : static_cast<std::int64_t>(magnitude);
  return p != start;
}

// Counts the words of a line.
std::uint64_t count_words(const char* p, const char* end) {
  std::uint64_t words = 0;
  for (bool blank = true; p != end; ++p) {
    const bool now = is_blank(*p);
    words += blank && !now;
    blank = now;
  }
  return words;
}

// The second column of an index: how many elements there are in all, and how many stand above this line.
struct Count {
  std::uint64_t all = 0, above = 0;
  const char* name;
  // 0-based, or k_none.
  std::uint32_t resolve(std::int64_t written) const {
    const std::int64_t index = written > 0 ? written - 1 : static_cast<std::int64_t>(above) + written;
    const bool exists = written != 0 && index >= 0 && static_cast<std::uint64_t>(index) < all;
    return exists ? static_cast<std::uint32_t>(index) : k_none;
  }
  std::string missing(std::int64_t written) const {
    return fmt::format("the face names {} {} of {}", name, written, all);
  }
};

class ObjReader {
 public:
  ObjReader(std::string_view text, const Companions& companions, MeshBuilder& builder)
      : text_(text), companions_(companions), builder_(builder), mesh_(builder.mesh), table_(builder.mesh) {}

  bool read() {
    const bool good = read_vertices() && read_faces();
    builder_.undefined_materials = table_.undefined();
    return good;
  }

 private:
  // visit(statement, the rest of its line, its end) for every line, until one is not good.
  template <class Visit>
  bool each_statement(Visit&& visit) {
    Lines lines(text_, true);
    for (std::string_view line; lines.next(line);) {
      const char* p = line.data();
      const char* end = p + line.size();
      place_.number = lines.number();
      const Statement statement = classify(p, end);
      if (!visit(statement, p, end)) return false;
    }
    return true;
  }

  // First pass: all that faces may refer to, so that a face may come before its vertices.
  bool read_vertices() {
    std::uint64_t triangles = 0;
    const bool good = each_statement([&](Statement statement, const char* p, const char* end) {
      switch (statement) {
        case Statement::position:
          return position(p, end);
        case Statement::texcoord:
          return texcoord(p, end);
        case Statement::normal:
          return normal(p, end);
        case Statement::face:
          triangles += std::max<std::uint64_t>(count_words(p, end), 3) - 2;
          break;
        case Statement::other:
          break;
      }
      return true;
    });
    if (!good) return false;
    positions_.all = mesh_.positions.size();
    texcoords_.all = mesh_.texcoords.size();
    normals_.all = mesh_.normals.size();
    const std::uint64_t most = std::max({positions_.all, texcoords_.all, normals_.all, triangles});
    if (most > k_most_elements)
      return builder_.refuse(fmt::format("has {} elements of one kind", most), "split it into several files");
    builder_.reserve(triangles);
    return true;
  }

  // Second pass: faces and what they belong to.
  bool read_faces() {
    const bool good = each_statement([&](Statement statement, const char* p, const char* end) {
      switch (statement) {
        case Statement::position:
          ++positions_.above;
          break;
        case Statement::texcoord:
          ++texcoords_.above;
          break;
        case Statement::normal:
          ++normals_.above;
          break;
        case Statement::face:
          return face(p, end);
        case Statement::other:
          return other(p, end);
      }
      return true;
    });
    if (!good) return false;
    builder_.close_group(group_id_);
    if (!known_ && mesh_.positions.empty() && unknown_line_ != 0)
      return builder_.refuse_at({"line", unknown_line_}, unknown_ + " is not a statement of an OBJ file",
                                "give the file the extension of its true format");
    return true;
  }

  // Reads `count` numbers. `finite` tells whether all of them are; a number that is none refuses the file.
  bool numbers(const char*& p, const char* end, std::span<double> out, const char* what, bool& finite) {
    finite = true;
    for (double& value : out) {
      skip_blanks(p, end);
      const char* start = p;
      const Scan scan = scan_double(p, end, value);
      if (scan == Scan::good) continue;
      if (scan == Scan::none)
        return builder_.refuse_at(place_, fmt::format("the {} has too few numbers", what), k_export_again);
      const std::string_view word = next_word(p, end);
      if (scan == Scan::bad)
        return builder_.refuse_at(place_, fmt::format("the {}'s {} is not a number", what, in_quotes(word)),
                                  k_export_again);
      p = start + word.size();
      value = 0;
      finite = false;
    }
    return true;
  }

  bool position(const char* p, const char* end) {
    std::array<double, 3> v;
    bool finite = true;
    const char* start = p;
    if (!numbers(p, end, v, "vertex", finite)) return false;
    if (!finite)
      return builder_.refuse_at(place_,
                                fmt::format("vertex {} is not finite: {}", mesh_.positions.size() + 1,
                                            in_quotes(rest_of_line(start, end))),
                                k_export_again);
    mesh_.positions.push_back({v[0], v[1], v[2]});
    return true;
  }

  bool texcoord(const char* p, const char* end) {
    std::array<double, 2> v{};
    bool finite = true;
    if (!numbers(p, end, {v.data(), 1}, "texture coordinate", finite)) return false;
    bool finite_v = true;
    skip_blanks(p, end);
    if (p != end && !numbers(p, end, {v.data() + 1, 1}, "texture coordinate", finite_v)) return false;
    const Float2 uv{static_cast<float>(v[0]), static_cast<float>(v[1])};
    const bool good = finite && finite_v && std::isfinite(uv.x) && std::isfinite(uv.y);
    mesh_.texcoords.push_back(good ? uv : Float2{});
    return good || builder_.spoil_texcoord(static_cast<std::uint32_t>(mesh_.texcoords.size() - 1), place_);
  }

  bool normal(const char* p, const char* end) {
    std::array<double, 3> v{};
    bool finite = true;
    if (!numbers(p, end, v, "normal", finite)) return false;
    const Float3 n = to_float({v[0], v[1], v[2]});
    const bool good = finite && is_finite(n);
    mesh_.normals.push_back(good ? n : Float3{});
    return good || builder_.spoil_normal(static_cast<std::uint32_t>(mesh_.normals.size() - 1), place_);
  }

  bool face(const char* p, const char* end) {
    corners_.clear();
    std::int64_t missing = 0;
    bool complete = true;
    for (skip_blanks(p, end); p != end; skip_blanks(p, end)) {
      const char* start = p;
      std::int64_t v = 0, vt = 0, vn = 0;
      bool has_vt = false, has_vn = false;
      bool good = scan_index(p, end, v);
      if (p != end && *p == '/') has_vt = scan_index(++p, end, vt);
      if (p != end && *p == '/') has_vn = scan_index(++p, end, vn);
      good = good && (p == end || is_blank(*p));
      if (!good) {
        p = start;
        return builder_.refuse_at(place_,
                                  fmt::format("{} is not a corner of a face", in_quotes(next_word(p, end))),
                                  k_export_again);
      }
      Corner corner{positions_.resolve(v), k_none, k_none};
      if (corner.position == k_none && complete) {
        complete = false;
        missing = v;
      }
      if (has_vt && (corner.texcoord = texcoords_.resolve(vt)) == k_none &&
          !builder_.drop_texcoord(place_, [&] { return texcoords_.missing(vt); }))
        return false;
      if (has_vn && (corner.normal = normals_.resolve(vn)) == k_none &&
          !builder_.drop_normal(place_, [&] { return normals_.missing(vn); }))
        return false;
      corners_.push_back(corner);
    }
    if (!complete) return builder_.drop_face(place_, [&] { return positions_.missing(missing); });
    return (part_ != k_none || find_part()) && builder_.face(corners_, part_, place_);
  }

  // Of the current object, group and material.
  bool find_part() {
    if ((part_ = builder_.part(object_, group_, material_)) == k_none) return false;
    if (const std::uint32_t group = source_group(); group != group_id_) {
      builder_.close_group(group_id_);
      group_id_ = group;
    }
    return true;
  }

  // Every `o` begins an object of its own; in it, one name is one group.
  std::uint32_t source_group() {
    if (object_begins_) {
      object_id_ = object_.empty() ? k_none : builder_.group(object_, k_none);
      groups_.clear();
      object_begins_ = false;
    }
    if (group_.empty()) return object_id_;
    const auto [at, is_new] = groups_.try_emplace(group_, k_none);
    if (is_new) at->second = builder_.group(group_, object_id_);
    return at->second;
  }

  bool other(const char* p, const char* end) {
    const std::string_view word = next_word(p, end);
    if (word.empty() || word.starts_with('#')) return true;
    const bool was_known = known_;
    known_ = true;
    if (word == "o") {
      object_ = to_utf8(rest_of_line(p, end));
      object_begins_ = true;
      part_ = k_none;
    } else if (word == "g") {
      group_ = to_utf8(rest_of_line(p, end));
      part_ = k_none;
    } else if (word == "usemtl") {
      const std::string name = to_utf8(rest_of_line(p, end));
      material_ = name.empty() ? k_none : table_.find_or_add(name);
      part_ = k_none;
    } else if (word == "mtllib") {
      return libraries(p, end);
    } else if (word == "l" || word == "p") {
      builder_.notes.add("lines and points skipped", to_text(place_) + ": not a face");
    } else if (is_free_form(word)) {
      builder_.notes.add("statements of free-form geometry skipped",
                         fmt::format("{}: {} is not read; convert curves and surfaces to a mesh",
                                     to_text(place_), in_quotes(word)));
    } else if (word == "v" || word == "f" || word == "vt" || word == "vn") {
      return builder_.refuse_at(place_, fmt::format("{} stands alone", in_quotes(word)), k_export_again);
    } else if (!is_ignored(word)) {
      known_ = was_known;
      if (unknown_line_ == 0) {
        unknown_line_ = place_.number;
        unknown_ = in_quotes(word);  // the line may not outlive this call
      }
      builder_.notes.add("unknown statements skipped",
                         fmt::format("{}: {}", to_text(place_), in_quotes(word)));
    }
    return true;
  }

  static bool is_ignored(std::string_view word) {
    static constexpr std::array<std::string_view, 11> k_words{"s",          "lod",       "mg",    "bevel",
                                                              "c_interp",   "d_interp",  "bmat",  "usemap",
                                                              "shadow_obj", "trace_obj", "maplib"};
    return std::find(k_words.begin(), k_words.end(), word) != k_words.end();
  }
  static bool is_free_form(std::string_view word) {
    static constexpr std::array<std::string_view, 16> k_words{
        "vp",   "cstype", "deg",  "step", "curv", "curv2", "surf", "parm",
        "trim", "hole",   "scrv", "sp",   "end",  "con",   "call", "csh"};
    return std::find(k_words.begin(), k_words.end(), word) != k_words.end();
  }

  // "mtllib a.mtl b.mtl"; a single name may hold blanks, so the whole line is tried first.
  bool libraries(const char* p, const char* end) {
    const std::string_view rest = rest_of_line(p, end);
    if (!companions_.folder) {
      builder_.notes.add("material libraries not read", to_text(place_) + ": a mesh in memory has no folder");
      return true;
    }
    if (rest.find_first_of(" \t") != std::string_view::npos) {
      if (const auto bytes = companions_.open(std::string(rest), builder_)) return library(*bytes, rest);
    }
    while (true) {
      const std::string_view name = next_word(p, end);
      if (name.empty()) return true;
      const auto bytes = companions_.open(std::string(name), builder_);
      if (bytes) {
        library(*bytes, name);
      } else if (builder_.strict()) {
        return builder_.refuse_at(
            place_, fmt::format("the material library {} {}", in_quotes(name), bytes.error().what),
            "put it beside the mesh, or drop --strict to do without");
      } else {
        builder_.notes.add("material libraries missing",
                           fmt::format("{}: {} {}", to_text(place_), in_quotes(name), bytes.error().what));
      }
    }
  }

  bool library(const Bytes& bytes, std::string_view name) {
    read_mtl({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, to_utf8(name), table_, builder_);
    return true;
  }

  static constexpr const char* k_export_again = "export the mesh again";

  std::string_view text_;
  const Companions& companions_;
  MeshBuilder& builder_;
  Mesh& mesh_;
  MaterialTable table_;
  Place place_{"line", 0};
  Count positions_{.name = "vertex"}, texcoords_{.name = "texture coordinate"}, normals_{.name = "normal"};
  std::string object_, group_;
  std::uint32_t material_ = k_none;
  std::uint32_t part_ = k_none;  // of the current object, group and material; k_none: not looked up yet
  bool object_begins_ = false;
  std::map<std::string, std::uint32_t> groups_;           // of the source, in the current object
  std::uint32_t object_id_ = k_none, group_id_ = k_none;  // of the source
  std::vector<Corner> corners_;
  bool known_ = false;
  std::string unknown_;
  std::uint64_t unknown_line_ = 0;
};

}  // namespace

bool read_obj(std::string_view text, const Companions& companions, MeshBuilder& builder) {
  return ObjReader(text, companions, builder).read();
}

}  // namespace copse
