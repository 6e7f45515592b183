// The obstacles to a missing constraint: the faces and edges that a segment pierces, and the edges that
// pierce a facet (paper §4).
//
// Both searches are for a mesh of the constraints' own vertices. In valid input no vertex lies inside a
// segment or facet, so a missing segment pierces something in each tetrahedron that it meets.
#pragma once

#include <optional>
#include <random>
#include <span>
#include <vector>

#include "mesh/tet_mesh.h"

namespace holdfast {

/// A face or edge (3 or 2 corners) whose inside a segment crosses.
struct Crossing {
  Tet tet = kNone;  ///< a tetrahedron that holds it
  std::array<Vertex, 3> corners{};
  int count = 0;
};

/// An edge that pierces a facet.
struct PiercingEdge {
  Vertex above, below;  ///< orient(facet, above) > 0 > orient(facet, below)
  Tet tet;              ///< one of its shell
};

using Random = std::mt19937_64;

/// Finds crossings; keeps scratch between calls.
class Piercing {
 public:
  Piercing(TetMesh& mesh, Random& random) : mesh_(mesh), random_(random) {}

  /// A tetrahedron that holds edge ab, or kNone. Walks round a instead of visiting its whole ball.
  [[nodiscard]] Tet find_edge(Vertex a, Vertex b);

  /// The face abc (one of its two codes), or kNone.
  [[nodiscard]] Face find_face(Vertex a, Vertex b, Vertex c);

  /// The faces and edges that segment ab crosses, from a to b, at most `most`; none where ab is an edge.
  /// Returns the last tetrahedron on the way; if ab is an edge, a tetrahedron of ab. Nothing if a vertex or
  /// the hull is in the way.
  std::optional<Tet> by_segment(Vertex a, Vertex b, std::vector<Crossing>& out, std::size_t most);

  /// The edges that pierce a facet, each once, at most about `most`. Returns the facet's own face (one of its
  /// two codes) if the facet stands, else kNone; nothing if a side is not an edge.
  std::optional<Face> of_facet(const std::array<Vertex, 3>& facet, std::vector<PiercingEdge>& out,
                               std::size_t most);

  /// The tetrahedra of such edges, each once. The same return value.
  std::optional<Face> tets_across(const std::array<Vertex, 3>& facet, std::vector<Tet>& out);

 private:
  // What a ray meets next: 3, 2 or 1 corners of `tet`, which lies before a face.
  using Exit = Crossing;

  [[nodiscard]] Exit leave_vertex(Vertex a, Vertex b);
  [[nodiscard]] std::array<int, 3> cone_signs(const std::array<Vertex, 3>& f, Vertex a, Vertex b) const;
  [[nodiscard]] std::array<int, 3> cone_signs_beyond(const std::array<Vertex, 3>& f, Vertex d, Vertex a,
                                                     Vertex b) const;
  [[nodiscard]] Exit leave_by_face(Tet t, Vertex a, const std::array<int, 3>& signs) const;
  [[nodiscard]] Exit pass_face(const Exit& in, Vertex a, Vertex b) const;
  [[nodiscard]] Exit pass_edge(const Exit& in, Vertex a, Vertex b) const;
  // The start of a facet at its first side: its own face, or else a tetrahedron whose inside the facet
  // crosses, if there is one.
  struct Start {
    Face face = kNone;
    Tet across = kNone;
  };
  [[nodiscard]] std::optional<Start> start_of(const std::array<Vertex, 3>& facet);
  template <typename Visit>
  std::optional<Face> flood(const std::array<Vertex, 3>& facet, Visit visit);

  TetMesh& mesh_;
  Random& random_;
  std::vector<Tet> tets_;
};

}  // namespace holdfast
