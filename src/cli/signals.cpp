#include "signals.h"

#include <unistd.h>

#include <csignal>

#include "command.h"

namespace holdfast::cli {
namespace {

// A signal handler can reach nothing but globals.
volatile std::sig_atomic_t cancelled = 0;

void set_flag(int signal) {
  cancelled = 1;
  std::signal(signal, SIG_DFL);
}

void leave(int) {
  static constexpr char message[] = "\nholdfast: cancelled, nothing was written\n";
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, message, sizeof message - 1);
  _exit(exit_limit);
}

}  // namespace

void cancel_by_flag() {
  std::signal(SIGINT, set_flag);
  std::signal(SIGTERM, set_flag);
}

void cancel_at_once() {
  std::signal(SIGINT, leave);
  std::signal(SIGTERM, leave);
}

bool cancel_requested() { return cancelled != 0; }

}  // namespace holdfast::cli
