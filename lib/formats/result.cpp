#include "lib/formats/result.h"

namespace copse {
namespace {

// A file name may hold a newline, and an error must stay one line.
std::string printable(const std::string& text) {
  static const char* k_hex = "0123456789abcdef";
  std::string out;
  out.reserve(text.size());
  for (const char c : text) {
    const auto u = static_cast<unsigned char>(c);
    if (u == '\n') {
      out += "\\n";
    } else if (u < 0x20 || u == 0x7f) {
      out += {'\\', 'x', k_hex[u >> 4], k_hex[u & 15]};
    } else {
      out += c;
    }
  }
  return out;
}

}  // namespace

std::string to_line(const Error& error, const std::string& tool) {
  std::string line = tool + ": error: ";
  if (!error.file.empty()) line += error.file + ": ";
  line += error.what;
  if (!error.remedy.empty()) line += "; " + error.remedy;
  return printable(line);
}

}  // namespace copse
