// What the tests of this room share: meshes as text, in memory or in a folder of their own.
#pragma once

#include "lib/formats/import/import.h"
#include "tests/import/soundness.h"

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>
#include <zlib.h>

namespace copse::testing {

inline std::span<const std::uint8_t> as_bytes(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

inline Result<Import> read(std::string_view text, MeshFormat format, bool strict = false) {
  return import_mesh(as_bytes(text), format, "tree", {.strict = strict});
}

// The mesh, or a failed test.
inline Import good(const Result<Import>& result) {
  EXPECT_TRUE(result.has_value()) << (result ? "" : to_line(result.error(), "import"));
  return result ? *result : Import{};
}

// The line that a tool would print.
inline std::string error_of(const Result<Import>& result) {
  return result ? "(no error)" : to_line(result.error(), "import");
}

inline std::string gzipped(std::string_view text) {
  z_stream stream{};
  deflateInit2(&stream, 9, Z_DEFLATED, 16 + MAX_WBITS, 9, Z_DEFAULT_STRATEGY);
  std::string out(deflateBound(&stream, text.size()) + 32, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  return out;
}

// A folder that goes away with the test.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "copse_import_XXXXXX").string();
    EXPECT_NE(::mkdtemp(name.data()), nullptr);
    path_ = name;
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  std::filesystem::path write(const std::string& name, std::string_view bytes) const {
    const std::filesystem::path path = path_ / name;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

inline void expect_sound(const Mesh& mesh) {
  EXPECT_EQ(broken_promise(mesh), nullptr) << broken_promise(mesh);
}

inline std::vector<Triangle> triangles(const Import& import) {
  return import.mesh.triangles;
}

}  // namespace copse::testing
