// Runs the mesher for `holdfast mesh`, and again after a further repair if the repaired surface has no mesh
// in doubles.
#pragma once

#include "holdfast/holdfast.h"
#include "holdfast/repair.h"
#include "mesh_input.h"
#include "mesh_options.h"
#include "progress.h"

namespace holdfast::cli {

/// Options that do not suit the surface (a hole on a facet, say) are wrong usage. The files' seeds join those
/// of the options.
[[nodiscard]] Result mesh_or_refuse(const MeshArguments& arguments, const MeshInput& input, Options& options);

/// Where a repaired surface has no mesh in doubles, joins sheets that are some last bits apart, as the
/// library does, and says so; `options` are those of the mesh there is none of.
void mesh_joined_sheets(const Surface& given, Options& options, ProgressView& progress, bool quiet,
                        MeshInput& input, RepairOptions& repairing, RepairResult& repaired, Result& result);

}  // namespace holdfast::cli
