// Failed trials at vertices and edges where nothing has changed since: they would fail again. Elements share
// vertices and edges, so without these notes the same trial would be repeated for each bad element of a
// group.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "mesh/anatomy.h"
#include "mesh/edge_removal.h"
#include "mesh/tet_mesh.h"

namespace holdfast {

class InVain {
 public:
  enum class AtVertex : std::uint8_t { smoothing = 1, contraction = 2, going = 4 };
  enum class AtEdge : std::uint8_t { point, point_with_patience };

  void make_room(std::size_t slots, std::size_t vertices) {
    at_edges_.resize(slots, 0);
    at_vertices_.resize(vertices, 0);
  }
  /// t is new, or one of its corners was moved.
  void forget(Tet t, const TetMesh::Corners& corners) {
    at_edges_[t] = 0;
    for (const Vertex v : corners) at_vertices_[v] = 0;
  }

  [[nodiscard]] bool has(Vertex v, AtVertex way) const {
    return (at_vertices_[v] & static_cast<unsigned>(way)) != 0;
  }
  void add(Vertex v, AtVertex way) {
    at_vertices_[v] = static_cast<std::uint8_t>(at_vertices_[v] | static_cast<unsigned>(way));
  }
  /// With no tetrahedron in the shell that is new.
  [[nodiscard]] bool has(const TetMesh& mesh, const EdgeShell& shell, AtEdge way) const {
    return std::all_of(shell.tets.begin(), shell.tets.end(),
                       [&](Tet t) { return (at_edges_[t] & bit(mesh, t, shell, way)) != 0; });
  }
  void add(const TetMesh& mesh, const EdgeShell& shell, AtEdge way) {
    for (const Tet t : shell.tets)
      at_edges_[t] = static_cast<std::uint16_t>(at_edges_[t] | bit(mesh, t, shell, way));
  }

 private:
  static unsigned bit(const TetMesh& mesh, Tet t, const EdgeShell& shell, AtEdge way) {
    const int edge = edge_between(mesh.index_of(t, shell.a), mesh.index_of(t, shell.b));
    return 1U << (edge + 6 * static_cast<int>(way));
  }

  std::vector<std::uint16_t> at_edges_;  // by slot: six bits a way
  std::vector<std::uint8_t> at_vertices_;
};

}  // namespace holdfast
