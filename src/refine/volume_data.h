// A mesh with what is known of its tetrahedra and vertices while a volume is filled and improved.
#pragma once

#include <vector>

#include "classify/regions.h"
#include "mesh/tet_mesh.h"

namespace holdfast {

class Part;

struct VolumeData {
  TetMesh& mesh;
  std::vector<RegionId>& region_of;  ///< by slot
  std::vector<double>& sizes;        ///< by vertex: the wanted length of edges
  const std::vector<bool>& kept;     ///< by region: whether it is worked on
  Vertex first_free;                 ///< vertices from here on lie on no constraint
  const Part* part = nullptr;        ///< that this is, unless the mesh is whole

  [[nodiscard]] bool is_inside(Tet t) const {
    return mesh.alive(t) && !mesh.is_ghost(t) && kept[region_of[t]];
  }
};

}  // namespace holdfast
