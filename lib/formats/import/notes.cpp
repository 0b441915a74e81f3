#include "lib/formats/import/notes.h"

#include <utility>

#include <fmt/format.h>

namespace copse {

bool Notes::count(std::string_view kind, std::uint64_t by) {
  for (Note& note : notes_) {
    if (note.kind == kind) {
      note.count += by;
      return false;
    }
  }
  notes_.push_back({std::string(kind), {}, by});
  return true;
}

void Notes::first(std::string_view kind, std::string description) {
  for (Note& note : notes_) {
    if (note.kind != kind || !note.description.empty()) continue;
    note.description = std::move(description);
    return;
  }
}

std::vector<std::string> Notes::lines() const {
  std::vector<std::string> out;
  out.reserve(notes_.size());
  for (const Note& note : notes_)
    out.push_back(fmt::format("{} ({}: {})", note.description, note.kind, note.count));
  return out;
}

}  // namespace copse
