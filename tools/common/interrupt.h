// SIGINT, SIGTERM and SIGHUP end a tool only after it has cleaned up.
#pragma once

#include <csignal>
#include <functional>
#include <thread>

namespace copse {

// While it lives these signals run `clean_up` on a thread of its own and then end the process as they always
// do. A signal that was ignored when the guard was made (nohup) stays ignored. Make it before any other
// thread: threads inherit the signal mask.
class InterruptGuard {
 public:
  explicit InterruptGuard(std::function<void()> clean_up);
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;
  ~InterruptGuard();

 private:
  void wait();

  std::function<void()> clean_up_;
  sigset_t watched_{};
  sigset_t previous_{};
  int signal_file_ = -1;
  int stop_file_ = -1;
  std::thread thread_;
};

}  // namespace copse
