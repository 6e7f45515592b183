// Runs the mesher for `holdfast mesh`, and again after a further repair if a repaired surface has no mesh in
// doubles.
#pragma once

#include "holdfast/holdfast.h"
#include "holdfast/repair.h"
#include "mesh_input.h"
#include "mesh_options.h"
#include "progress.h"

namespace holdfast::cli {

/// Reports options that do not suit the surface (such as a hole on a facet) as wrong usage. The files' seeds
/// are added to those of the options.
[[nodiscard]] Result mesh_or_refuse(const MeshArguments& arguments, const MeshInput& input, Options& options);

/// If a repaired surface has no mesh in doubles, joins sheets that are a few last bits apart, as the library
/// does, and says so; `options` are those of the failed mesh.
void mesh_joined_sheets(const Surface& given, Options& options, ProgressView& progress, bool quiet,
                        MeshInput& input, RepairOptions& repairing, RepairResult& repaired, Result& result);

}  // namespace holdfast::cli
