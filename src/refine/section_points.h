// Points on the planes that are to cut a mesh.
#pragma once

#include "mesh/monitor.h"
#include "mesh/parallel.h"
#include "refine/cuts.h"
#include "refine/volume_data.h"
#include "size/size_function.h"

namespace holdfast {

/// Puts field points on the cuts, until the empty spheres of the mesh meet the planes in
/// circles no larger than the size there. Then changes on one side of a plane hardly reach the other.
/// Near facets much larger than the size this is not possible everywhere: returns the share of the volume of
/// the tetrahedra across the planes where a circle is huge in the end.
[[nodiscard]] double add_section_points(const VolumeData& volume, const Cuts& cuts, const SizeFunction& sizes,
                                        const Threads& threads, Monitor& monitor);

}  // namespace holdfast
