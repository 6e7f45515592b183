// Options that have no effect together with others. They are wrong usage, because the user expects an effect.
#pragma once

#include "holdfast/holdfast.h"
#include "mesh_options.h"

namespace holdfast::cli {

/// Throws UsageError for the first option that another one makes idle.
void refuse_idle_options(const MeshArguments& arguments);

/// The same after files are read: a size field may be a metric, and surfaces may have holes.
void refuse_idle_options(const MeshArguments& arguments, const Options& options, const Surface& surface);

}  // namespace holdfast::cli
