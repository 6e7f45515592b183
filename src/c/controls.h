// Converts limits and callbacks of the C interface to those of the library.
#pragma once

#include "holdfast/c.h"
#include "holdfast/holdfast.h"

namespace holdfast::c {

/// The fields of `control` that the caller's header version has, and defaults for the others. Throws
/// std::invalid_argument for a size that belongs to no version.
[[nodiscard]] holdfast_control known(const holdfast_control* control);

[[nodiscard]] Limits limits_of(const holdfast_control& control);

/// For calls without stages; empty if there is no callback.
[[nodiscard]] ProgressFunction progress_of(const holdfast_control& control);

[[nodiscard]] Options to_options(const holdfast_mesh_options* options, const holdfast_control& control,
                                 std::size_t vertices);

}  // namespace holdfast::c
