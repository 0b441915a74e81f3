#include "tools/common/console.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace copse {
namespace {

constexpr std::chrono::milliseconds k_patience{1000};  // a stage that takes less shows no bar
constexpr std::chrono::milliseconds k_redraw{100};
constexpr std::string_view k_erase_line = "\r\x1b[K";

// A full or closed stderr is nobody's to report to.
void write_stderr(std::string_view text) {
  while (!text.empty()) {
    const ssize_t n = ::write(STDERR_FILENO, text.data(), text.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return;
    text.remove_prefix(static_cast<std::size_t>(n));
  }
}

}  // namespace

int terminal_width(int file) {
  winsize size{};
  if (::ioctl(file, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) return size.ws_col;
  if (const char* columns = std::getenv("COLUMNS")) {
    int value = 0;
    const char* end = columns + std::strlen(columns);
    if (std::from_chars(columns, end, value).ptr == end && value > 0) return value;
  }
  return 80;
}

std::string bar_line(std::string_view tool, std::string_view stage, double fraction, double seconds,
                     int width) {
  std::string head = fmt::format("{}: {} ", tool, stage);
  const bool known = fraction >= 0;
  const double share = std::clamp(fraction, 0.0, 1.0);
  const std::string tail = known ? fmt::format(" {:3.0f} % {:4.0f} s", std::floor(share * 100), seconds)
                                 : fmt::format("{:.0f} s", seconds);
  const int room = width - static_cast<int>(head.size() + tail.size()) - 3;  // brackets, and the last column
  if (known && room >= 5) {
    const int cells = std::min(room, 40);
    const int full = static_cast<int>(share * cells);
    head += fmt::format("[{}{}]", std::string(static_cast<std::size_t>(full), '#'),
                        std::string(static_cast<std::size_t>(cells - full), ' '));
  }
  return (head + tail).substr(0, static_cast<std::size_t>(std::max(width - 1, 1)));
}

Console::~Console() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
    erase();
  }
  wake_.notify_all();
  if (bar_.joinable()) bar_.join();
}

void Console::enable_bar() {
  if (!bar_.joinable()) bar_ = std::thread([this] { run_bar(); });
}

void Console::line(std::string_view text) {
  const std::lock_guard lock(mutex_);
  erase();
  write_stderr(std::string(text) + "\n");
}

void Console::begin(const RunningStage& stage) {
  const std::lock_guard lock(mutex_);
  running_.push_back(&stage);
}

void Console::end(const RunningStage& stage) {
  const std::lock_guard lock(mutex_);
  running_.erase(std::remove(running_.begin(), running_.end(), &stage), running_.end());
  erase();
}

void Console::run_bar() {
  std::unique_lock lock(mutex_);
  while (!stop_) {
    wake_.wait_for(lock, k_redraw);
    if (stop_ || running_.empty()) continue;
    const RunningStage& stage = *running_.back();
    if (std::chrono::steady_clock::now() - stage.start >= k_patience) draw(stage);
  }
}

void Console::draw(const RunningStage& stage) {
  const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - stage.start;
  write_stderr(std::string(k_erase_line) +
               bar_line(tool_, stage.name, stage.fraction, passed.count(), terminal_width(STDERR_FILENO)));
  drawn_ = true;
}

void Console::erase() {
  if (drawn_) write_stderr(k_erase_line);
  drawn_ = false;
}

}  // namespace copse
