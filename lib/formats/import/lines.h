// The logical lines of a text: a backslash at the end joins a line with the next one. Lines end in LF, CR LF,
// or, where a text has no LF at all, CR.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

namespace copse {

class Lines {
 public:
  // `joined`: whether backslashes join lines.
  Lines(std::string_view text, bool joined)
      : p_(text.data()), end_(text.data() + text.size()), joined_(joined) {
    if (text.starts_with("\xef\xbb\xbf")) p_ += 3;
    if (text.find('\n') == std::string_view::npos && text.find('\r') != std::string_view::npos)
      newline_ = '\r';
  }

  // The next line without its end; false when there is none. A joined line lives until the next call.
  bool next(std::string_view& line) {
    if (p_ == end_) return false;
    line = take();
    number_ = ++read_;
    if (joined_ && line.ends_with('\\')) line = join(line);
    return true;
  }

  // Of the line that next() gave, 1-based; the first one of joined lines.
  std::uint64_t number() const { return number_; }

 private:
  std::string_view take() {
    const auto* stop =
        static_cast<const char*>(std::memchr(p_, newline_, static_cast<std::size_t>(end_ - p_)));
    const char* line_end = stop != nullptr ? stop : end_;
    std::string_view line(p_, static_cast<std::size_t>(line_end - p_));
    if (line.ends_with('\r')) line.remove_suffix(1);
    p_ = stop != nullptr ? stop + 1 : end_;
    return line;
  }

  std::string_view join(std::string_view line) {
    if (line.starts_with('#')) return line;
    scratch_.clear();
    while (line.ends_with('\\')) {
      scratch_.append(line.substr(0, line.size() - 1)) += ' ';
      if (p_ == end_) return scratch_;
      line = take();
      ++read_;
    }
    return scratch_.append(line);
  }

  const char* p_;
  const char* end_;
  bool joined_;
  char newline_ = '\n';
  std::uint64_t number_ = 0, read_ = 0;
  std::string scratch_;
};

}  // namespace copse
