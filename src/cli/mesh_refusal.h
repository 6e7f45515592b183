// The messages of `holdfast mesh` for a surface that it does not fill.
#pragma once

#include "holdfast/holdfast.h"
#include "mesh_options.h"

namespace holdfast::cli {

/// Of a surface that is not valid, or valid and nothing to fill: why, and what the user can do.
void print_refusal(const MeshArguments& arguments, const Surface& surface, const Result& result);

}  // namespace holdfast::cli
