// The front that places field points.
//
// Points are placed as by an advancing front, but in a mesh that is complete at any time (Rebay 1993; Marcum,
// Weatherill 1995; Engwirda 2016): a tetrahedron much larger than the size is to be refined, and it is on the
// front where its neighbour is not, or where a facet bounds it. There the best place for a point is over the
// centre of that face, so high that the new edges have the right length. So layers of good tetrahedra grow
// inward from the surface. A point too near to a vertex that it would be joined to is not inserted: the
// nearest vertex that it sees is always one of those, so that the mesh itself is the spatial index.
#pragma once

#include "mesh/monitor.h"
#include "mesh/parallel.h"
#include "refine/volume_data.h"
#include "size/size_function.h"

namespace holdfast {

/// Sets the size at each vertex of the mesh: that of the surface, and for others the one that the surrounding
/// vertices allow; and the metric, if there is one.
void set_sizes_at_vertices(const VolumeData& volume, const SizeFunction& sizes, const Threads& threads,
                           Monitor& monitor);

/// Adds field points wherever tetrahedra are too large. Progress is reported as that of `stage`. Returns
/// whether it stopped before all tetrahedra that are too large were tried, because too many attempts failed.
bool advance_front(const VolumeData& volume, const SizeFunction& sizes, Stage stage, Monitor& monitor);

}  // namespace holdfast
