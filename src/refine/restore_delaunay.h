// Makes the volume Delaunay before it is filled, as far as exchanges of tetrahedra can.
//
// The cavity of a field point is found by spheres. Recovery leaves a mesh that is not Delaunay. There,
// tetrahedra that do not see the point are left out of cavities, and stay. Between distant points such
// tetrahedra are long, and each new point makes more of them, until a part of the volume is full of slivers.
#pragma once

#include <cstddef>

#include "mesh/monitor.h"
#include "mesh/parallel.h"
#include "refine/volume_data.h"

namespace holdfast {

/// Makes exchanges (mesh/exchange.h) until there is none that leaves, of what it changes, no vertex in the
/// sphere of a tetrahedron, where there was one (Lawson 1977; Joe 1989). Constraints stand. Returns how many.
std::size_t restore_delaunay(const VolumeData& volume, const Threads& threads, Monitor& monitor);

}  // namespace holdfast
