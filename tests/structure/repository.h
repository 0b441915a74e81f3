// Reads the repository's own sources, for the tests of its rules.
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace copse {

inline const std::filesystem::path k_root = COPSE_SOURCE_DIR;

inline std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

// All files below `folder` (relative to the repository) with one of the extensions, sorted.
inline std::vector<std::filesystem::path> files_below(const std::string& folder,
                                                      const std::vector<std::string>& extensions) {
  std::vector<std::filesystem::path> files;
  if (!std::filesystem::exists(k_root / folder)) return files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(k_root / folder)) {
    const std::string extension = entry.path().extension().string();
    if (entry.is_regular_file() &&
        std::find(extensions.begin(), extensions.end(), extension) != extensions.end()) {
      files.push_back(std::filesystem::relative(entry.path(), k_root));
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

// The paths of `#include "..."` and `#include <...>` lines, with their brackets.
inline std::vector<std::string> includes_of(const std::filesystem::path& path) {
  std::istringstream lines(text_of(k_root / path));
  std::vector<std::string> includes;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t start = line.find_first_not_of(" \t");
    if (start == std::string::npos || line.compare(start, 8, "#include") != 0) continue;
    const std::size_t open = line.find_first_of("\"<", start + 8);
    if (open == std::string::npos) continue;
    const std::size_t close = line.find_first_of("\">", open + 1);
    if (close != std::string::npos) includes.push_back(line.substr(open, close - open + 1));
  }
  return includes;
}

}  // namespace copse
