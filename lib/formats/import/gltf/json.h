// A parsed JSON text, read with types checked: what has the wrong type refuses the file, naming its path.
#pragma once

#include "lib/formats/import/mesh_builder.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace copse {

// Deeper nesting is refused; glTF itself needs 8 levels.
inline constexpr std::uint32_t k_json_depth = 128;

// A value in a JSON text, or a missing one. Cheap to copy; lives as long as its JsonText.
class JsonValue {
 public:
  JsonValue() = default;

  bool exists() const { return value_ != nullptr; }
  bool is_object() const;
  bool is_array() const;
  const std::string& path() const { return path_; }  // "meshes[0].primitives[1]"

  // The member of an object; missing when there is none, or when this is missing or no object.
  JsonValue operator[](const char* key) const;
  // The elements of an array; 0 when this is missing or no array.
  std::size_t size() const;
  JsonValue at(std::size_t index) const;
  // The members of an object, sorted by name.
  std::vector<std::pair<std::string, JsonValue>> members() const;

  // A missing value leaves `out` as it is and is true. A value of the wrong type, or out of range, refuses
  // the file and is false.
  bool read(std::string& out, MeshBuilder& builder) const;
  bool read(bool& out, MeshBuilder& builder) const;
  bool read(double& out, MeshBuilder& builder) const;
  bool read(float& out, MeshBuilder& builder) const;
  bool read(std::uint64_t& out, MeshBuilder& builder) const;
  // Exactly as many numbers as `out` has room for.
  bool read(std::span<double> out, MeshBuilder& builder) const;
  // An index below `count`; leaves k_none when missing.
  bool read_index(std::uint32_t& out, std::size_t count, MeshBuilder& builder) const;

  // A text, or nothing: for names, which no file is refused for.
  std::string text() const;

 private:
  friend class JsonText;
  JsonValue(const void* value, std::string path) : value_(value), path_(std::move(path)) {}
  bool wrong(const char* expected, MeshBuilder& builder) const;

  const void* value_ = nullptr;
  std::string path_;
};

class JsonText {
 public:
  JsonText();
  JsonText(const JsonText&) = delete;
  JsonText& operator=(const JsonText&) = delete;
  ~JsonText();
  // False: refused, with the byte at which the text is wrong.
  bool parse(std::string_view text, MeshBuilder& builder);
  JsonValue root() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace copse
