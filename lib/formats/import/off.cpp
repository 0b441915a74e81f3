#include "lib/formats/import/off.h"

#include "lib/formats/import/lines.h"
#include "lib/formats/import/text.h"

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace copse {
namespace {

constexpr const char* k_remedy = "export the mesh again";
constexpr std::size_t k_most_numbers = 32;  // of a vertex line; 3 + 3 + 4 + 2 are known

class OffReader {
 public:
  OffReader(std::string_view text, MeshBuilder& builder)
      : size_(text.size()), lines_(text, false), builder_(builder), mesh_(builder.mesh) {}

  bool read() {
    if (!next()) return cut_off();
    if (!header() || !counts()) return false;
    mesh_.positions.reserve(vertices_);
    for (std::uint64_t i = 0; i < vertices_; ++i) {
      if (!next()) return cut_off();
      if (!vertex(i)) return false;
    }
    builder_.reserve(faces_);
    part_ = builder_.part("", "", k_none);
    for (std::uint64_t i = 0; i < faces_; ++i) {
      if (!next()) return cut_off();
      if (!face()) return false;
    }
    if (next()) builder_.notes.add("lines after the end", fmt::format("line {}: not read", lines_.number()));
    return true;
  }

 private:
  // The next line that holds something, without its comment.
  bool next() {
    for (std::string_view line; lines_.next(line);) {
      line = line.substr(0, line.find('#'));
      p_ = line.data();
      end_ = p_ + line.size();
      skip_blanks(p_, end_);
      if (p_ != end_) return true;
    }
    return false;
  }

  Place place() const { return {"line", lines_.number()}; }
  bool refuse(const std::string& what) { return builder_.refuse_at(place(), what, k_remedy); }
  bool cut_off() {
    return builder_.refuse(fmt::format("ends after {} of {} vertices and {} of {} faces",
                                       mesh_.positions.size(), vertices_, faces_read_, faces_),
                           "copy the file again: its end is missing");
  }

  // "[ST][C][N][4][n]OFF [BINARY]"; the keyword may be missing, and the counts may follow it on its line.
  bool header() {
    const char* start = p_;
    const std::string_view word = next_word(p_, end_);
    if (!word.ends_with("OFF")) {
      p_ = start;
      return true;
    }
    std::string_view prefix = word.substr(0, word.size() - 3);
    const auto take = [&](std::string_view letters) {
      if (!prefix.starts_with(letters)) return false;
      prefix.remove_prefix(letters.size());
      return true;
    };
    texcoords_ = take("ST");
    take("C");
    normals_ = take("N");
    if (!prefix.empty())
      return refuse(fmt::format("{} is not read: only points in space are", in_quotes(word)));
    const char* after = p_;
    if (next_word(p_, end_) == "BINARY")
      return builder_.refuse("is a binary OFF", "store it as a text OFF, or as a PLY");
    p_ = after;
    skip_blanks(p_, end_);
    return p_ != end_ || next() || cut_off();
  }

  bool counts() {
    std::int64_t vertices = 0, faces = 0;
    if (scan_integer(p_, end_, vertices) != Scan::good || scan_integer(p_, end_, faces) != Scan::good ||
        vertices < 0 || faces < 0)
      return refuse("the counts of vertices and faces cannot be read");
    vertices_ = static_cast<std::uint64_t>(vertices);
    faces_ = static_cast<std::uint64_t>(faces);
    // "0 0 0" and a line end; "3 0 1 2" and a line end, though "1 0" is read too.
    if (vertices_ > size_ / 6 || faces_ > size_ / 2 || vertices_ > k_most_elements)
      return refuse(
          fmt::format("{} vertices and {} faces do not fit into {} bytes", vertices_, faces_, size_));
    return true;
  }

  bool vertex(std::uint64_t index) {
    std::array<double, k_most_numbers> numbers{};
    std::array<bool, k_most_numbers> finite{};
    std::size_t count = 0;
    for (skip_blanks(p_, end_); p_ != end_ && count < k_most_numbers; skip_blanks(p_, end_), ++count) {
      const Scan scan = scan_double(p_, end_, numbers[count]);
      if (scan == Scan::bad)
        return refuse(
            fmt::format("vertex {} holds {}, which is not a number", index, in_quotes(next_word(p_, end_))));
      finite[count] = scan == Scan::good;
      if (scan == Scan::not_finite) next_word(p_, end_);
    }
    const std::size_t needed = 3 + (normals_ ? 3u : 0u) + (texcoords_ ? 2u : 0u);
    if (count < needed) return refuse(fmt::format("vertex {} has {} of {} numbers", index, count, needed));
    if (!finite[0] || !finite[1] || !finite[2]) return refuse(fmt::format("vertex {} is not finite", index));
    mesh_.positions.push_back({numbers[0], numbers[1], numbers[2]});
    const auto at = static_cast<std::uint32_t>(index);
    if (normals_) {
      const Float3 n = to_float({numbers[3], numbers[4], numbers[5]});
      const bool good = finite[3] && finite[4] && finite[5] && is_finite(n);
      mesh_.normals.push_back(good ? n : Float3{});
      if (!good && !builder_.spoil_normal(at, place())) return false;
    }
    if (texcoords_) {  // the last two, behind a colour of any length
      const Float2 uv{static_cast<float>(numbers[count - 2]), static_cast<float>(numbers[count - 1])};
      const bool good = finite[count - 2] && finite[count - 1] && std::isfinite(uv.x) && std::isfinite(uv.y);
      mesh_.texcoords.push_back(good ? uv : Float2{});
      if (!good && !builder_.spoil_texcoord(at, place())) return false;
    }
    return true;
  }

  bool face() {
    ++faces_read_;
    std::int64_t corners = 0;
    if (scan_integer(p_, end_, corners) != Scan::good || corners < 0)
      return refuse("the face's count of corners cannot be read");
    ring_.clear();
    std::int64_t missing = 0;
    bool complete = true;
    for (std::int64_t i = 0; i < corners; ++i) {
      std::int64_t index = 0;
      const Scan scan = scan_integer(p_, end_, index);
      if (scan == Scan::none) return refuse(fmt::format("the face has {} of {} corners", i, corners));
      if (scan == Scan::bad)
        return refuse(fmt::format("{} is not a vertex's number", in_quotes(next_word(p_, end_))));
      if (index < 0 || static_cast<std::uint64_t>(index) >= vertices_) {
        if (complete) missing = index;
        complete = false;
        continue;
      }
      const auto v = static_cast<std::uint32_t>(index);
      ring_.push_back({v, texcoords_ ? v : k_none, normals_ ? v : k_none});
    }
    if (complete) return builder_.face(ring_, part_, place());
    return builder_.drop_face(
        place(), [&] { return fmt::format("the face names vertex {} of {}", missing, vertices_); });
  }

  std::uint64_t size_;
  Lines lines_;
  MeshBuilder& builder_;
  Mesh& mesh_;
  const char* p_ = nullptr;
  const char* end_ = nullptr;
  bool normals_ = false, texcoords_ = false;
  std::uint64_t vertices_ = 0, faces_ = 0, faces_read_ = 0;
  std::uint32_t part_ = k_none;
  std::vector<Corner> ring_;
};

}  // namespace

bool read_off(std::string_view text, MeshBuilder& builder) {
  return OffReader(text, builder).read();
}

}  // namespace copse
