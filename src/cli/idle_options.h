// Options that have no effect beside others. They are wrong usage, because their user expects an effect.
#pragma once

#include "holdfast/holdfast.h"
#include "mesh_options.h"

namespace holdfast::cli {

/// Throws UsageError for the first option that has no effect beside another one.
void refuse_idle_options(const MeshArguments& arguments);

/// The same, once files are read: a size field may be a metric, and surfaces may bring holes.
void refuse_idle_options(const MeshArguments& arguments, const Options& options, const Surface& surface);

}  // namespace holdfast::cli
