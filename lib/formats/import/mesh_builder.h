// Collects what a reader finds into a Mesh: checks faces, cuts polygons, counts what is dropped.
#pragma once

#include "lib/formats/import/import.h"
#include "lib/formats/import/notes.h"
#include "lib/formats/import/polygon.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

namespace copse {

// A place in a file, for messages: {"line", 12}.
struct Place {
  const char* unit = "line";
  std::uint64_t number = 0;
};
std::string to_text(const Place& place);

// Indices of one corner, all in range, or k_none where the corner has none.
struct Corner {
  std::uint32_t position = k_none;
  std::uint32_t texcoord = k_none;
  std::uint32_t normal = k_none;
};

// Of one kind, in a mesh: indices are 32 bits wide, and the top values mean "none".
inline constexpr std::uint64_t k_most_elements = 0xfffffff0u;
// The names of all parts together may take as many bytes as this, or 4 times the file if that is more: a file
// cannot make each of a million parts repeat one long name.
inline constexpr std::uint64_t k_part_names_floor = std::uint64_t{16} << 20;
// Of an object or a group, in bytes.
inline constexpr std::uint64_t k_name_length = 4096;

class MeshBuilder {
 public:
  // `bytes` is the size of the (inflated) file.
  MeshBuilder(std::string file, std::uint64_t bytes, bool strict);

  // Readers fill positions, normals, texcoords, materials (and which are not defined) and textures
  // themselves.
  Mesh mesh;
  std::vector<std::uint32_t> undefined_materials;
  ImportCounts counts;
  Notes notes;
  std::vector<std::filesystem::path> files;

  const std::string& file() const { return file_; }
  std::uint64_t bytes() const { return bytes_; }
  bool strict() const { return strict_; }

  // The part of that name and material, a new one if need be. k_none when the names' budget is spent (see
  // error()).
  std::uint32_t part(const std::string& object, const std::string& group, std::uint32_t material);

  // A new group of the source; `parent`: an earlier one, or k_none.
  std::uint32_t group(std::string name, std::uint32_t parent);
  // The triangles that no group was told for yet are in this one (k_none: in none).
  void close_group(std::uint32_t group);

  // Room for so many triangles.
  void reserve(std::uint64_t triangles);

  // One face of the file, all of whose corners are in range. False: refused, see error().
  bool face(std::span<const Corner> corners, std::uint32_t part, const Place& place);
  // A face, or a corner's index, that cannot be used; the reason is asked for when it is printed. False:
  // refused.
  using Reason = std::function<std::string()>;
  bool drop_face(const Place& place, const Reason& reason);
  bool drop_texcoord(const Place& place, const Reason& reason);
  bool drop_normal(const Place& place, const Reason& reason);
  // Makes corners that name this normal or texture coordinate lose it (it is not finite).
  bool spoil_normal(std::uint32_t index, const Place& place);
  bool spoil_texcoord(std::uint32_t index, const Place& place);

  // Refuses the file. Always false, so that a reader can `return builder.refuse(...)`.
  bool refuse(std::string what, std::string remedy);
  bool refuse_at(const Place& place, const std::string& what, std::string remedy);
  const Error& error() const { return *error_; }
  bool refused() const { return error_.has_value(); }

  // The result; the builder is empty afterwards.
  Result<Import> finish(MeshFormat format);

 private:
  void triangle(const Corner& a, const Corner& b, const Corner& c, std::uint32_t part);
  bool polygon(std::span<const Corner> corners, std::uint32_t part, const Place& place);
  void cut_ring(std::uint32_t part);
  void number_faces();
  bool drop(std::string_view kind, std::uint64_t& count, const Place& place, const Reason& reason);
  void drop_spoilt(std::vector<std::uint32_t>& spoilt, std::vector<Triangle>& corners, std::uint64_t& count);

  std::string file_;
  std::uint64_t bytes_ = 0;
  bool strict_ = false;
  std::optional<Error> error_;
  std::map<std::tuple<std::string, std::string, std::uint32_t>, std::uint32_t> parts_;
  std::uint64_t part_name_bytes_ = 0;
  std::vector<SourceGroup> groups_;
  std::vector<std::uint32_t> group_of_;
  std::uint64_t faces_ = 0;  // of the file, dropped ones too
  bool numbered_ = false;    // face_of is kept
  bool with_normals_ = false;
  bool with_texcoords_ = false;
  PolygonCutter cutter_;
  std::vector<Corner> ring_;
  std::vector<Double3> outline_;
  std::vector<std::uint32_t> spoilt_normals_, spoilt_texcoords_;
};

}  // namespace copse
