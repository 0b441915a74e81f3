// When a search or a proof has to come to an end. What is found by then depends on the machine; without one
// nothing does.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <limits>

namespace copse {

class Deadline {
 public:
  Deadline() = default;  // never
  static Deadline after(double seconds) {
    Deadline d;
    // Beyond a century the clock's number would overflow.
    if (seconds < 3e9) {
      d.at_ =
          Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
    }
    return d;
  }
  // The first of so many equal parts of the time that is left.
  Deadline share(std::size_t parts) const {
    if (!is_set()) return {};
    Deadline d;
    const auto now = Clock::now();
    d.at_ = now + (at_ > now ? at_ - now : Clock::duration(0)) / static_cast<Clock::rep>(parts);
    return d;
  }
  // Infinite without one, 0 when it has passed.
  double seconds_left() const {
    if (!is_set()) return std::numeric_limits<double>::infinity();
    return std::max(0.0, std::chrono::duration<double>(at_ - Clock::now()).count());
  }
  bool is_set() const { return at_ != Clock::time_point::max(); }
  bool has_passed() const { return is_set() && Clock::now() >= at_; }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point at_ = Clock::time_point::max();
};

}  // namespace copse
