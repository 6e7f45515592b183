#include "signals.h"

#include <unistd.h>

#include <csignal>

#include "command.h"

namespace holdfast::cli {
namespace {

// A signal handler can reach nothing but globals.
volatile std::sig_atomic_t cancelled = 0;

// Made before a handler is.
const CancelToken& token() {
  static const CancelToken only;
  return only;
}

void set_flag(int signal) {
  cancelled = 1;
  token().cancel();
  std::signal(signal, SIG_DFL);
}

void leave(int) {
  static constexpr char message[] = "\nholdfast: cancelled, nothing was written\n";
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, message, sizeof message - 1);
  _exit(exit_limit);
}

/// Of the signals that ask a program to end, those that whoever started it did not have ignored, as `nohup`
/// does and shells for what runs in the background.
void on_cancel(void (*handler)(int)) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const auto before = std::signal(signal, handler);
    if (before == SIG_IGN) std::signal(signal, SIG_IGN);
  }
}

}  // namespace

void fail_rather_than_die() {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

void cancel_by_flag() {
  token();
  on_cancel(set_flag);
}

void cancel_at_once() { on_cancel(leave); }

bool cancel_requested() { return cancelled != 0; }

const CancelToken& cancel_token() { return token(); }

}  // namespace holdfast::cli
