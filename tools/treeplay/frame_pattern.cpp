#include "tools/treeplay/frame_pattern.h"

namespace copse::treeplay {

Result<FramePattern> FramePattern::parse(const std::string& text) {
  const auto refuse_at = [&](std::size_t at) {
    return fail(Fault::usage, "",
                "--frames '" + text + "': the % at position " + std::to_string(at + 1) + " is not understood",
                "write one %d or %04d for the frame's number, and %% for a percent sign");
  };
  FramePattern pattern;
  for (std::size_t i = 0; i < text.size(); ++i) {
    std::string& out = pattern.numbered_ ? pattern.after_ : pattern.before_;
    if (text[i] != '%') {
      out += text[i];
      continue;
    }
    const std::size_t start = i++;
    if (i < text.size() && text[i] == '%') {
      out += '%';
      continue;
    }
    if (pattern.numbered_) return refuse_at(start);
    if (i < text.size() && text[i] == '0') pattern.pad_ = '0', ++i;
    if (i < text.size() && text[i] >= '1' && text[i] <= '9')
      pattern.width_ = static_cast<std::size_t>(text[i++] - '0');
    if (i >= text.size() || text[i] != 'd') return refuse_at(start);
    pattern.numbered_ = true;
  }
  return pattern;
}

std::filesystem::path FramePattern::name(std::uint64_t frame) const {
  if (!numbered_) return before_;
  std::string number = std::to_string(frame);
  if (number.size() < width_) number.insert(0, width_ - number.size(), pad_);
  return before_ + number + after_;
}

}  // namespace copse::treeplay
