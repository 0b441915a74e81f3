#include "lib/analysis/leaves/glob.h"

#include <cstddef>

namespace copse {
namespace {

char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

// Bytes of the code point at the front of `s`, which is not empty; 1 where `s` is not UTF-8.
std::size_t code_point(std::string_view s) {
  const auto lead = static_cast<unsigned char>(s[0]);
  std::size_t n = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : lead >= 0xc0 ? 2 : 1;
  for (std::size_t i = 1; i < n; ++i) {
    if (i >= s.size() || (static_cast<unsigned char>(s[i]) & 0xc0) != 0x80) return 1;
  }
  return n;
}

// What one element of a pattern (a character, `?`, a set) takes of the pattern and of the name.
struct Step {
  bool matches = false;
  std::size_t pattern = 0, name = 0;
};

Step match_set(std::string_view pattern, std::string_view name, std::size_t close) {
  const bool negated = pattern[1] == '!' || pattern[1] == '^';
  const char c = lower(name[0]);
  bool found = false;
  for (std::size_t i = negated ? 2 : 1; i < close; ++i) {
    const char low = lower(pattern[i]);
    if (i + 2 < close && pattern[i + 1] == '-') {
      found |= low <= c && c <= lower(pattern[i + 2]);
      i += 2;
    } else {
      found |= low == c;
    }
  }
  return {found != negated, close + 1, negated ? code_point(name) : 1};
}

// `pattern` is not empty and does not start with `*`.
Step match_one(std::string_view pattern, std::string_view name) {
  if (name.empty()) return {};
  if (pattern[0] == '?') return {true, 1, code_point(name)};
  if (pattern[0] == '[') {
    // A `]` right after the bracket (or its negation) is a member of the set.
    const std::size_t first = pattern.size() > 1 && (pattern[1] == '!' || pattern[1] == '^') ? 3 : 2;
    const std::size_t close = pattern.find(']', first);
    if (close != std::string_view::npos) return match_set(pattern, name, close);
  }
  const std::size_t escaped = pattern[0] == '\\' && pattern.size() > 1 ? 1 : 0;
  return {lower(pattern[escaped]) == lower(name[0]), escaped + 1, 1};
}

}  // namespace

bool glob_match(std::string_view pattern, std::string_view name) {
  // Only the last star needs to be retried: a longer match of an earlier one can gain nothing.
  constexpr std::size_t none = std::string_view::npos;
  std::size_t p = 0, n = 0, star = none, star_name = 0;
  while (n < name.size() || p < pattern.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      star_name = n;
      continue;
    }
    if (p < pattern.size()) {
      const Step step = match_one(pattern.substr(p), name.substr(n));
      if (step.matches) {
        p += step.pattern;
        n += step.name;
        continue;
      }
    }
    if (star == none || star_name >= name.size()) return false;
    p = star + 1;
    n = star_name += code_point(name.substr(star_name));
  }
  return true;
}

}  // namespace copse
