// The names of a sequence of frames: 'out/%04d.png'.
#pragma once

#include "lib/formats/result.h"

#include <cstdint>
#include <filesystem>
#include <string>

namespace copse::treeplay {

class FramePattern {
 public:
  // At most one of %d, %Nd, %0Nd (N up to 9); %% is a percent sign. Anything else with a % is refused:
  // nothing of it ever reaches printf.
  static Result<FramePattern> parse(const std::string& text);

  bool numbered() const { return numbered_; }
  std::filesystem::path name(std::uint64_t frame) const;

 private:
  std::string before_, after_;
  std::size_t width_ = 0;
  char pad_ = ' ';
  bool numbered_ = false;
};

}  // namespace copse::treeplay
