// Ctrl-C, termination requests, and signals that indicate errors.
#pragma once

#include "holdfast/limits.h"

namespace holdfast::cli {

/// Turns writing to a closed pipe, or beyond the file size limit, into an error of that call with its exit
/// code, which otherwise would kill the program.
void fail_rather_than_die();

/// Makes SIGINT, SIGTERM and SIGHUP only set the flag that `cancel_requested` reads; a second one, of the
/// same kind or another, ends the program at once.
void cancel_by_flag();

[[nodiscard]] bool cancel_requested();

/// A token cancelled together with the flag, for calls that only take limits.
[[nodiscard]] const CancelToken& cancel_token();

}  // namespace holdfast::cli
