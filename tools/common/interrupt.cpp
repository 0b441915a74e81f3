#include "tools/common/interrupt.h"

#include <cerrno>
#include <cstdint>

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/signalfd.h>
#include <unistd.h>

namespace copse {
namespace {

bool is_ignored(int signal) {
  struct sigaction action {};
  return ::sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

}  // namespace

InterruptGuard::InterruptGuard(std::function<void()> clean_up) : clean_up_(std::move(clean_up)) {
  ::sigemptyset(&watched_);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    if (!is_ignored(signal)) ::sigaddset(&watched_, signal);
  }
  signal_file_ = ::signalfd(-1, &watched_, SFD_CLOEXEC);
  stop_file_ = ::eventfd(0, EFD_CLOEXEC);
  if (signal_file_ < 0 || stop_file_ < 0) return;  // no descriptors left: the signals just end the process
  ::pthread_sigmask(SIG_BLOCK, &watched_, &previous_);
  thread_ = std::thread([this] { wait(); });
}

InterruptGuard::~InterruptGuard() {
  if (thread_.joinable()) {
    ::eventfd_write(stop_file_, 1);
    thread_.join();
    ::pthread_sigmask(SIG_SETMASK, &previous_, nullptr);
  }
  if (signal_file_ >= 0) ::close(signal_file_);
  if (stop_file_ >= 0) ::close(stop_file_);
}

void InterruptGuard::wait() {
  pollfd files[] = {{signal_file_, POLLIN, 0}, {stop_file_, POLLIN, 0}};
  for (;;) {
    if (::poll(files, 2, -1) < 0 && errno != EINTR) return;
    if (files[1].revents != 0) return;
    signalfd_siginfo info{};
    if (files[0].revents == 0 || ::read(signal_file_, &info, sizeof info) != sizeof info) continue;
    clean_up_();
    const int signal = static_cast<int>(info.ssi_signo);
    ::signal(signal, SIG_DFL);
    sigset_t one;
    ::sigemptyset(&one);
    ::sigaddset(&one, signal);
    ::pthread_sigmask(SIG_UNBLOCK, &one, nullptr);
    ::raise(signal);
  }
}

}  // namespace copse
