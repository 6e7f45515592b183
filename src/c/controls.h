// Limits and callbacks of the C interface as those of the library.
#pragma once

#include "holdfast/c.h"
#include "holdfast/holdfast.h"

namespace holdfast::c {

/// What the caller's headers know of `control`, else the defaults. Throws std::invalid_argument for a size
/// that no version has.
[[nodiscard]] holdfast_control known(const holdfast_control* control);

[[nodiscard]] Limits limits_of(const holdfast_control& control);

/// For calls without stages; empty without a callback.
[[nodiscard]] ProgressFunction progress_of(const holdfast_control& control);

[[nodiscard]] Options to_options(const holdfast_mesh_options* options, const holdfast_control& control,
                                 std::size_t vertices);

}  // namespace holdfast::c
