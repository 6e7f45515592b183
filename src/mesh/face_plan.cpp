#include "mesh/face_plan.h"

namespace holdfast {
namespace {

// What remains of one of the two tetrahedra, by k: the face at f_k, f_k+1 and the apex; the edge from f_k to
// the apex; the edge from f_k to f_k+1.
struct Side {
  std::array<Face, 3> across{};
  std::array<bool, 3> is_facet{}, is_spoke_segment{}, is_rim_segment{};
};

Side side_of_face(const TetMesh& mesh, Face f, const std::array<Vertex, 3>& corners) {
  const Tet t = tet_of(f);
  const auto apex = static_cast<std::size_t>(side_of(f));
  std::array<std::size_t, 3> local{};
  for (std::size_t k = 0; k < 3; ++k) local[k] = static_cast<std::size_t>(mesh.index_of(t, corners[k]));
  Side side;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto opposite = static_cast<int>(local[(k + 2) % 3]);
    side.across[k] = mesh.neighbour(t, opposite);
    side.is_facet[k] = mesh.is_facet(face_code(t, opposite));
    side.is_spoke_segment[k] = mesh.is_segment(t, kEdgeOf[local[k]][apex]);
    side.is_rim_segment[k] = mesh.is_segment(t, kEdgeOf[local[k]][local[(k + 1) % 3]]);
  }
  return side;
}

Flags bits_of(const Side& of_d, const Side& of_e, std::size_t k) {
  unsigned bits = 0;
  const auto set = [&](bool is, Flags bit) { bits |= is ? bit : 0u; };
  const auto segment = [](std::size_t u, std::size_t v) { return segment_bit(kEdgeOf[u][v]); };
  const std::size_t next = (k + 1) % 3;
  set(of_e.is_facet[k], facet_bit(3));
  set(of_d.is_facet[k], facet_bit(2));
  set(of_d.is_rim_segment[k], segment(0, 1));
  set(of_e.is_spoke_segment[k], segment(0, 2));
  set(of_e.is_spoke_segment[next], segment(1, 2));
  set(of_d.is_spoke_segment[k], segment(0, 3));
  set(of_d.is_spoke_segment[next], segment(1, 3));
  return static_cast<Flags>(bits);
}

}  // namespace

FacePlan::FacePlan(const TetMesh& mesh, Face f) : old_tets_{tet_of(f), tet_of(mesh.neighbour(f))} {
  const Face g = mesh.neighbour(f);
  const auto corners = mesh.face_vertices(f);
  const Vertex d = mesh.apex(f), e = mesh.apex(g);
  const Side of_d = side_of_face(mesh, f, corners), of_e = side_of_face(mesh, g, corners);
  for (std::size_t k = 0; k < 3; ++k)
    new_tets_[k] = {{corners[k], corners[(k + 1) % 3], e, d},
                    {new_face((k + 1) % 3, 1), new_face((k + 2) % 3, 0), of_d.across[k], of_e.across[k]},
                    bits_of(of_d, of_e, k)};
}

}  // namespace holdfast
