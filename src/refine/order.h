// Numbers that follow a space-filling curve, so that what is near in space is near in memory: most of the
// time of work on a large mesh is waiting for memory otherwise.
#pragma once

#include <cstdint>
#include <vector>

#include "refine/volume_data.h"

namespace holdfast {

/// Places along a Morton curve through all vertices of a mesh.
class CurveKeys {
 public:
  explicit CurveKeys(const TetMesh& mesh);
  void sort(std::vector<Tet>& tets) const;
  void sort_vertices(std::vector<Vertex>& vertices) const;

 private:
  const TetMesh& mesh_;
  std::vector<std::uint32_t> keys_;  // by vertex
};

/// All living tetrahedra, and the vertices from `first` on, as they come along the curve.
struct CurveOrder {
  std::vector<Tet> tets;
  std::vector<Vertex> vertices;
};
[[nodiscard]] CurveOrder order_of(const TetMesh& mesh, Vertex first);

/// Renumbers tetrahedra, and the vertices from `first` on. `region_of`, by slot, and by vertex `sizes`,
/// unless empty, and `metrics`, if there are any, follow.
void renumber(TetMesh& mesh, const CurveOrder& order, Vertex first, std::vector<RegionId>& region_of,
              std::vector<double>& sizes, std::vector<Metric>* metrics);
/// Along the curve: tetrahedra, and the vertices that lie on no constraint.
void order_along_curve(const VolumeData& volume);

}  // namespace holdfast
