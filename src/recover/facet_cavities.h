// A missing facet in one go: the tetrahedra that cross it go, and the two cavities that they leave, above and
// below, are filled again, each bounded by the facet and by faces of the mesh (Shewchuk 2003, "Updating and
// constructing constrained Delaunay and constrained regular triangulations by flips"; Si, Gaertner 2005).
//
// Flips take such edges one by one, and a point for each would be the partition's way; here thousands of them
// cost about as much as their triangulation. A cavity is itself a surface that is to be filled without new
// points: Delaunay tetrahedra of its vertices, then flips for the faces that are missing. Where these fail,
// the cavity takes in the tetrahedra behind its missing faces and tries again.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "mesh/tet_mesh.h"
#include "recover/pierce.h"
#include "recover/standing.h"

namespace holdfast {

class FacetCavities {
 public:
  /// Of a mesh in which some facets or segments of a complex are missing; vertices from the last argument on
  /// may be added.
  using Finish =
      std::function<void(TetMesh&, const SegmentTable&, std::span<const Triangle>, Standing&, Vertex)>;

  FacetCavities(TetMesh& mesh, std::uint64_t seed) : mesh_(mesh), random_(seed), piercing_(mesh, random_) {}

  /// Whether the facet is a mesh face now, with its bit set; if not, the mesh is as it was. `tell` is called
  /// now and then, and may throw.
  ///
  /// The facet's sides must be mesh edges.
  /// `finish`, if any, is asked to make everything stand in a cavity where flips left something missing; it
  /// may add points there.
  bool recover(const std::array<Vertex, 3>& facet, const std::function<void()>& tell,
               const Finish& finish = {});
  /// The number of tetrahedra that cross a facet.
  [[nodiscard]] std::size_t crossing(const std::array<Vertex, 3>& facet);
  /// Points that the last call added.
  [[nodiscard]] const std::vector<Vertex>& added() const { return added_; }
  /// Vertices in the facet's plane, for which the last call gave up.
  [[nodiscard]] const std::vector<Vertex>& in_the_way() const { return in_the_way_; }

 private:
  bool list_coplanar(const std::array<Vertex, 3>& facet);

  TetMesh& mesh_;
  Random random_;
  Piercing piercing_;
  std::vector<Tet> tets_;
  std::vector<Vertex> added_, in_the_way_;
};

}  // namespace holdfast
