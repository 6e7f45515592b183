// Extraction of a volume from the mesh: selected tetrahedra, renumbered vertices, exact positions.
#pragma once

#include <functional>
#include <vector>

#include "classify/keep.h"
#include "holdfast/holdfast.h"
#include "mesh/parallel.h"
#include "mesh/tet_mesh.h"
#include "recover/standing.h"
#include "surface/complex.h"

namespace holdfast {

/// A volume and its vertices that no double represents; `volume` has the nearest doubles for them.
struct Extract {
  Volume volume;
  std::vector<FacetRegions> facet_regions;  ///< one per facet of the volume; empty without regions
  std::vector<ExactVertex> exact_vertices;
  std::vector<Index> number;       ///< by mesh vertex, its number in the volume; not for extract_kept
  std::size_t steiner_points = 0;  ///< vertices that are neither the complex's nor the box's
};

/// The input of extraction. The mesh is the complex times 2^scale; its vertices 0 .. n-1 are the complex's,
/// and those up to first_free-1 are corners of the box.
struct Source {
  const TetMesh& mesh;
  const Complex& complex;
  const SegmentTable& table;
  int scale;
  Vertex first_free;
};

/// The tetrahedra of the kept regions, with the facets and segments on them. The vertices are the complex's,
/// bit for bit, then all other vertices in use in ascending order.
[[nodiscard]] Extract extract_kept(const Source& source, const Regions& regions, const Kept& kept,
                                   const Threads& threads);

/// Every tetrahedron of the box as region 0, with the facets and segments that exist: the state before
/// classification, for `stop_after`.
[[nodiscard]] Extract extract_all(const Source& source, const Standing& standing);

}  // namespace holdfast
