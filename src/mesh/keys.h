// Names of edges and faces by their vertices, the same for any order of these.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "mesh/anatomy.h"
#include "numbers/sorted.h"

namespace holdfast {

/// Both ends in one number, which orders edges by their lower ends and then by the others.
using EdgeKey = std::uint64_t;
[[nodiscard]] inline EdgeKey edge_key(Vertex a, Vertex b) {
  return EdgeKey{std::min(a, b)} << 32 | std::max(a, b);
}
/// Of edge k of a tetrahedron.
[[nodiscard]] inline EdgeKey edge_key(const std::array<Vertex, 4>& corners, int k) {
  const auto [a, b] = ends_of_edge(corners, k);
  return edge_key(a, b);
}

/// Corners in ascending order.
using FaceKey = std::array<Vertex, 3>;
[[nodiscard]] inline FaceKey face_key(const std::array<Vertex, 3>& corners) { return ascending(corners); }
/// Of face i of a tetrahedron.
[[nodiscard]] inline FaceKey face_key(const std::array<Vertex, 4>& corners, int i) {
  return face_key(corners_of_face(corners, i));
}

}  // namespace holdfast
