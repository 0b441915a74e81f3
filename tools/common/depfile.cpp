#include "tools/common/depfile.h"

#include <algorithm>
#include <cstddef>

namespace copse {
namespace {

// Before a space, a tab or a '#' make also undoes backslashes that stand there already, so they are doubled.
Result<std::string> escaped(const std::filesystem::path& path) {
  if (auto fits = fits_depfile(path); !fits) return std::unexpected(std::move(fits.error()));
  std::string out;
  std::size_t backslashes = 0;
  for (const char c : path.string()) {
    if (c == ' ' || c == '\t' || c == '#') out.append(backslashes + 1, '\\');
    if (c == ':' || c == '%') out += '\\';
    if (c == '$') out += '$';
    out += c;
    backslashes = c == '\\' ? backslashes + 1 : 0;
  }
  return out;
}

Result<std::vector<std::string>> escaped(const std::vector<std::filesystem::path>& paths) {
  std::vector<std::string> out;
  for (const std::filesystem::path& path : paths) {
    auto text = escaped(path);
    if (!text) return std::unexpected(std::move(text.error()));
    if (std::find(out.begin(), out.end(), *text) == out.end()) out.push_back(std::move(*text));
  }
  return out;
}

}  // namespace

Result<void> fits_depfile(const std::filesystem::path& path) {
  if (path.string().find_first_of("\n\r") == std::string::npos) return {};
  return fail(Fault::usage, path.string(), "a dependency file cannot hold a name with a line break",
              "rename the file, or drop --depfile");
}

Result<std::string> make_depfile(const std::vector<std::filesystem::path>& targets,
                                 const std::vector<std::filesystem::path>& prerequisites) {
  const auto left = escaped(targets);
  if (!left) return std::unexpected(left.error());
  const auto right = escaped(prerequisites);
  if (!right) return std::unexpected(right.error());
  std::string text;
  for (const std::string& target : *left) text += (text.empty() ? "" : " ") + target;
  text += ":";
  for (const std::string& name : *right) text += " \\\n  " + name;
  text += "\n";
  for (const std::string& name : *right) {
    if (std::find(left->begin(), left->end(), name) == left->end()) text += "\n" + name + ":\n";
  }
  return text;
}

}  // namespace copse
