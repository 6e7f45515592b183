// Ctrl-C and termination requests.
#pragma once

namespace holdfast::cli {

/// From now on SIGINT and SIGTERM only set the flag that `cancel_requested` reads; a second one of them
/// ends the program at once.
void cancel_by_flag();

/// From now on SIGINT and SIGTERM end the program with the exit code of a cancellation. For work that
/// cannot be asked to stop and has no file open.
void cancel_at_once();

[[nodiscard]] bool cancel_requested();

}  // namespace holdfast::cli
