#include "optimise/badness.h"

#include "mesh/quality.h"

namespace holdfast {

double quality_of(const TetMesh& mesh, const TetMesh::Corners& c) {
  return quality(mesh.position(c[0]), mesh.position(c[1]), mesh.position(c[2]), mesh.position(c[3]));
}

std::vector<int> wide_edges(const TetMesh& mesh, Tet t) {
  constexpr double kWide = 90;  // degrees
  const TetMesh::Corners& c = mesh.corners(t);
  const std::array<double, 6> angles =
      dihedral_angles(mesh.position(c[0]), mesh.position(c[1]), mesh.position(c[2]), mesh.position(c[3]));
  std::vector<int> edges;
  for (int edge = 0; edge < 6; ++edge)
    if (!(angles[static_cast<std::size_t>(edge)] < kWide) && !mesh.is_segment(t, edge)) edges.push_back(edge);
  return edges;
}

Badness badness_of(const TetMesh& mesh, std::span<const Tet> tets, const BadFrom& from) {
  Badness badness;
  for (const Tet t : tets) badness.add(quality_of(mesh, mesh.corners(t)), from);
  return badness;
}

}  // namespace holdfast
