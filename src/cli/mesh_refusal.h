// The messages of `holdfast mesh` for a surface that it cannot fill.
#pragma once

#include "holdfast/holdfast.h"
#include "mesh_options.h"

namespace holdfast::cli {

/// For a surface that is not valid, or has nothing to fill: why, and what the user can do.
void print_refusal(const MeshArguments& arguments, const Surface& surface, const Result& result);

}  // namespace holdfast::cli
