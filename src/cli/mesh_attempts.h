// What `holdfast mesh` fills, and once more where a repair left what has no mesh in doubles.
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

/// A surface that was repaired without a tolerance, and then had no mesh in doubles, is repaired once more
/// with the least that may help. If it has one then, this takes the place of all three.
void mesh_joined(const MeshArguments& arguments, const Surface& given, const Options& options,
                 ProgressView& progress, MeshInput& input, RepairOptions& repairing, RepairResult& repaired,
                 Result& result);

}  // namespace holdfast::cli
