#include "tools/treegrow/join_faces.h"

#include <cstring>
#include <string_view>

namespace copse::grow {

std::string join_faces(std::string obj, const Mesh& mesh) {
  // In place: the text only becomes shorter.
  std::size_t from = 0, to = 0, triangle = 0;
  const auto move = [&](std::size_t begin, std::size_t count) {
    std::memmove(obj.data() + to, obj.data() + begin, count);
    to += count;
  };
  while (from < obj.size()) {
    const std::size_t end = std::min(obj.find('\n', from), obj.size() - 1) + 1;
    const std::string_view line = std::string_view(obj).substr(from, end - from);
    if (!line.starts_with("f ")) {
      move(from, line.size());
    } else if (triangle > 0 && triangle < mesh.face_of.size() &&
               mesh.face_of[triangle] == mesh.face_of[triangle - 1]) {
      // A further triangle of a fan adds its last corner to the line before.
      const std::size_t corner = line.rfind(' ');
      --to;  // that line's end
      move(from + corner, line.size() - corner);
      ++triangle;
    } else {
      move(from, line.size());
      ++triangle;
    }
    from = end;
  }
  obj.resize(to);
  return obj;
}

}  // namespace copse::grow
