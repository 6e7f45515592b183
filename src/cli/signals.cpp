#include "signals.h"

#include <csignal>

namespace holdfast::cli {
namespace {

// A signal handler can only use globals.
volatile std::sig_atomic_t cancelled = 0;

// Must be created before a handler is set.
const CancelToken& token() {
  static const CancelToken only;
  return only;
}

constexpr int kRequests[] = {SIGINT, SIGTERM, SIGHUP};

void set_flag(int) {
  cancelled = 1;
  token().cancel();
  // From now on any of them ends the program, but those that are ignored.
  for (const int signal : kRequests) {
    struct sigaction present {};
    if (sigaction(signal, nullptr, &present) == 0 && present.sa_handler == set_flag)
      std::signal(signal, SIG_DFL);
  }
}

}  // namespace

void fail_rather_than_die() {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

void cancel_by_flag() {
  token();
  for (const int signal : kRequests) {
    // The caller may have set signals to be ignored, as `nohup` does, and shells for background jobs.
    const auto before = std::signal(signal, set_flag);
    if (before == SIG_IGN) std::signal(signal, SIG_IGN);
  }
}

bool cancel_requested() { return cancelled != 0; }

const CancelToken& cancel_token() { return token(); }

}  // namespace holdfast::cli
