#include "lib/formats/printable.h"

namespace copse {
namespace {

void add_escaped(unsigned char c, std::string& out) {
  static constexpr const char* k_hex = "0123456789abcdef";
  if (c == '\n') {
    out += "\\n";
  } else {
    out += {'\\', 'x', k_hex[c >> 4], k_hex[c & 15]};
  }
}

std::string escaped(std::string_view text, bool lines) {
  std::string out;
  out.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    const auto next = i + 1 < text.size() ? static_cast<unsigned char>(text[i + 1]) : 0;
    if (c == 0xc2 && next >= 0x80 && next < 0xa0) {
      add_escaped(next, out), ++i;
    } else if ((c < 0x20 || c == 0x7f) && !(lines && (c == '\n' || c == '\t'))) {
      add_escaped(c, out);
    } else {
      out += text[i];
    }
  }
  return out;
}

}  // namespace

std::string printable(std::string_view text) {
  return escaped(text, false);
}

std::string printable_lines(std::string_view text) {
  return escaped(text, true);
}

}  // namespace copse
