// Warnings of a reader: one line a kind, with the first place and the count.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace copse {

class Notes {
 public:
  // Counts one more of `kind`, a short plural noun such as "faces dropped". Returns true for the first one:
  // only then is its description wanted, by first().
  bool count(std::string_view kind, std::uint64_t by = 1);
  void first(std::string_view kind, std::string description);

  // Both at once, where speed does not matter.
  void add(std::string_view kind, const std::string& description) {
    if (count(kind)) first(kind, description);
  }

  // "line 7: texture coordinate 298 of 8 does not exist (texture coordinates dropped: 30394)"
  std::vector<std::string> lines() const;

 private:
  struct Note {
    std::string kind, description;
    std::uint64_t count = 0;
  };
  std::vector<Note> notes_;  // in order of the first occurrence; a dozen at most
};

}  // namespace copse
