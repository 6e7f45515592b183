// Recovers a missing facet in one step: the tetrahedra that cross the facet are removed, and the two cavities
// above and below it are filled again, each bounded by the facet and by faces of the mesh (Shewchuk 2003,
// "Updating and constructing constrained Delaunay and constrained regular triangulations by flips"; Si,
// Gaertner 2005).
//
// Flips remove piercing edges one by one, and the partition would need a point for each. Here thousands of
// them cost about as much as a triangulation of their vertices. A cavity is itself a surface to fill without
// new points: by Delaunay tetrahedra of its vertices, then flips for missing faces. If the flips fail, the
// cavity takes in the tetrahedra behind its missing faces and tries again.
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
  /// Completes a mesh in which some constraints are missing. It may add vertices, which are those from
  /// `first_free` on.
  using Finish = std::function<void(TetMesh& mesh, const ConstraintSet& constraints, Vertex first_free)>;

  FacetCavities(TetMesh& mesh, std::uint64_t seed) : mesh_(mesh), random_(seed), piercing_(mesh, random_) {}

  /// Returns whether the facet is now a mesh face, with its bit set; if not, the mesh is unchanged. `tell` is
  /// called from time to time, and may throw.
  ///
  /// The facet's sides must be mesh edges.
  /// `finish`, if set, makes everything stand in a cavity in which flips left something missing. It may add
  /// points there.
  bool recover(const std::array<Vertex, 3>& facet, const std::function<void()>& tell,
               const Finish& finish = {});
  /// The number of tetrahedra that cross a facet.
  [[nodiscard]] std::size_t crossing(const std::array<Vertex, 3>& facet);
  /// Points that the last call added.
  [[nodiscard]] const std::vector<Vertex>& added() const { return added_; }
  /// Vertices in the facet's plane that made the last call give up.
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
