// What a tool says on stderr: lines, and a progress bar that never mixes with them.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace copse {

// Columns of the terminal behind `file`, else of COLUMNS, else 80.
int terminal_width(int file);

// What the bar shows of a stage that is running.
struct RunningStage {
  std::string name;
  std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
  std::atomic<double> fraction{-1};  // 0 to 1, negative while unknown
};

// One line of at most `width` columns: "treeprep: rings [#####     ]  50 %  3 s".
std::string bar_line(std::string_view tool, std::string_view stage, double fraction, double seconds,
                     int width);

class Console {
 public:
  explicit Console(std::string tool) : tool_(std::move(tool)) {}
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;
  ~Console();

  // From now on a stage that runs for more than about a second shows a bar, redrawn ten times a second.
  void enable_bar();
  void line(std::string_view text);  // one whole line, without its line break

  // Stages may nest; the bar shows the innermost. A stage must outlive its time between begin and end.
  void begin(const RunningStage& stage);
  void end(const RunningStage& stage);

 private:
  void run_bar();
  void draw(const RunningStage& stage);
  void erase();

  std::string tool_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::vector<const RunningStage*> running_;
  bool stop_ = false;
  bool drawn_ = false;
  std::thread bar_;
};

}  // namespace copse
