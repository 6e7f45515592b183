// Ctrl-C, termination requests, and signals that stand for errors.
#pragma once

#include "holdfast/limits.h"

namespace holdfast::cli {

/// From now on writing to a pipe that nobody reads, or beyond the largest size of a file, is an error of that
/// call, which has its exit code, and ends nothing else.
void fail_rather_than_die();

/// From now on SIGINT, SIGTERM and SIGHUP only set the flag that `cancel_requested` reads; a second one of
/// them ends the program at once.
void cancel_by_flag();

[[nodiscard]] bool cancel_requested();

/// Cancelled with the flag: for calls that are given limits alone.
[[nodiscard]] const CancelToken& cancel_token();

}  // namespace holdfast::cli
