// A point inserted by a cavity that also takes in tetrahedra which do not break the Delaunay criterion, but
// whose faces the point sees (paper §6.2, Fig. 10).
#pragma once

#include <vector>

#include "mesh/tet_mesh.h"

namespace holdfast::literal {

struct InsertionCounts {
  std::size_t points = 0;
  std::size_t split = 0;     ///< tetrahedra of the local cavities: two at a face, the shell at an edge
  std::size_t delaunay = 0;  ///< tetrahedra added since the spheres round them hold the point
  std::size_t visible = 0;   ///< tetrahedra added since the point sees their other faces
};

/// The cavity of one insertion, by the places of corners, for a picture.
struct InsertionPicture {
  using Shape = std::array<Point, 4>;
  Point point{};
  std::vector<Shape> split, delaunay, visible, star;
};

/// P lies in the mesh already, by a local split: its ball is the star of that cavity. Grows it. Facets stop
/// it, and no segment and no vertex is lost. What P sees is decided exactly; the criterion, which only
/// chooses, in doubles.
void grow_star(TetMesh& mesh, Vertex p, InsertionCounts& counts, InsertionPicture* picture = nullptr);

}  // namespace holdfast::literal
