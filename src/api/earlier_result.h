// The result of an earlier attempt, which stands unless a later attempt makes a better one.
#pragma once

#include <exception>

#include "holdfast/holdfast.h"

namespace holdfast {

/// The figures of a report that accumulate over all attempts.
[[nodiscard]] Report of_all_attempts(const Report& report);

/// Replaces the result of the last attempt by an earlier one, which takes over the figures of all attempts.
/// Allocates nothing, since memory may have run out.
void go_back_to(Result earlier, Result& result) noexcept;

/// Adds the warning that an error ended the last attempt, if there is memory for its words.
void warn_of(const std::exception_ptr& error, Result& result) noexcept;

}  // namespace holdfast
