// A polyhedron of tetrahedra of the mesh, cut out as a complex of its own.
#pragma once

#include <optional>
#include <set>
#include <vector>

#include "mesh/keys.h"
#include "mesh/tet_mesh.h"
#include "optimise/optimise.h"

namespace holdfast {

class Search;

/// Tetrahedra of one region round some of them, breadth first, none across a facet. Facets and segments among
/// them are constraints of the complex, and vertices that stand are its vertices; free ones inside are not.
class Polyhedron {
 public:
  /// Of at most so many tetrahedra that the search is about, or as many as it begins with.
  Polyhedron(Search& search, std::vector<Tet> from, std::size_t most);

  [[nodiscard]] const std::vector<Tet>& tets() const { return tets_; }
  /// How many vertices are free and inside.
  [[nodiscard]] std::size_t points() const { return points_; }
  /// Its facets look outwards.
  [[nodiscard]] Complex surface() const { return surface_.view(); }
  [[nodiscard]] ToFill with(PointsOfFilling points) const { return {surface_, points}; }
  /// Whether without further points each of its faces may have a tetrahedron whose Q is below the limit.
  [[nodiscard]] bool may_be_filled_below(double limit) const;
  /// The worst Q of its tetrahedra, and that of other ones.
  [[nodiscard]] double worst() const;
  [[nodiscard]] double worst(const Filling& filling) const;
  /// Whether a filling has the faces of the polyhedron, and its vertices.
  [[nodiscard]] bool is_filled_by(const Filling& filling) const;
  /// Replaces the polyhedron by a filling and returns the new points. Nothing, with the mesh unchanged, if
  /// rounding to the mesh's doubles inverts a tetrahedron.
  [[nodiscard]] std::optional<std::vector<Vertex>> replace(const Filling& filling) const;

 private:
  void gather(const Search& search, std::size_t most);
  void cut_out(Vertex first_free);
  void cut_out_faces(Tet t, std::set<FaceKey>& walls);
  [[nodiscard]] Index local(Vertex v) const;

  TetMesh& mesh_;
  std::vector<Tet> tets_;
  std::vector<Vertex> vertices_;               // of the surface, in ascending order
  std::vector<std::array<Vertex, 3>> facets_;  // of the surface
  std::vector<Vertex> apexes_;                 // by facet: of the tetrahedron behind it
  std::set<FaceKey> faces_;                    // between the polyhedron and the rest of the mesh
  std::size_t points_ = 0;
  Surface surface_;
};

}  // namespace holdfast
