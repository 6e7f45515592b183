// Field points: points inside the regions so that edges get the length that a size function asks for
// (design §2.8; paper §8).
#pragma once

#include <vector>

#include "classify/regions.h"
#include "mesh/monitor.h"
#include "mesh/tet_mesh.h"
#include "size/size_function.h"

namespace holdfast {

/// What field points work on: the mesh, the region of each tetrahedron, which regions get points.
struct FieldMesh {
  TetMesh& mesh;
  std::vector<RegionId>& region_of;  ///< by slot; kept up to date
  const std::vector<bool>& kept;     ///< by region
};

/// Adds field points to the kept regions; all vertices of their tetrahedra are explicit. Facets, segments and
/// vertices stand. Returns the size at each vertex of the mesh.
std::vector<double> add_field_points(const FieldMesh& field, const SizeFunction& sizes, Monitor& monitor);

}  // namespace holdfast
