// Levels of vertices, which count elements from one side of a wall or a gap to the other.
//
// For each of 13 directions, the floors of a region are its facets whose inward normal is within kCone of the
// direction, and the ceilings those of the opposite direction. Vertices of floors have level
// 0, those of ceilings level n, and the others something between. If no edge joins vertices whose levels
// differ by more than 1, each path of edges from a floor to a ceiling has at least n of them, whatever its
// route: this depends only on connections, not on positions.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/tet_mesh.h"
#include "numbers/vector.h"

namespace holdfast {

class Levels {
 public:
  /// Up to sign, to the faces, edges and corners of a cube: each direction is within 28 degrees of one.
  static constexpr std::size_t kDirections = 13;
  /// Cosine of 43.9 degrees: less than 45, so that a floor and a ceiling never meet at a right angle; and two
  /// facets that face each other at up to 30 degrees are a floor and a ceiling of some direction.
  static constexpr double kCone = 0.72;
  /// The level of vertices for which a direction has no demand.
  static constexpr std::uint8_t kFree = 255;

  using OfVertex = std::array<std::uint8_t, kDirections>;

  [[nodiscard]] static Vector direction(std::size_t k);

  /// Vertices without an entry are free.
  [[nodiscard]] const OfVertex& of(Vertex v) const { return v < levels_.size() ? levels_[v] : all_free(); }
  OfVertex& operator[](Vertex v) {
    if (v >= levels_.size()) levels_.resize(v + std::size_t{1}, all_free());
    return levels_[v];
  }
  void clear() { levels_.clear(); }

  [[nodiscard]] static bool differ_too_much(std::uint8_t x, std::uint8_t y) {
    return x != kFree && y != kFree && (x < y ? y - x : x - y) > 1;
  }
  /// Whether an edge between them jumps over no level.
  [[nodiscard]] bool may_join(Vertex v, Vertex w) const;
  /// Whether each edge of the new tetrahedra jumps over no level, or is one of an old tetrahedron.
  [[nodiscard]] bool allow(const TetMesh& mesh, std::span<const Tet> old_tets,
                           std::span<const TetMesh::Corners> fresh) const;

 private:
  static const OfVertex& all_free();

  std::vector<OfVertex> levels_;  // by vertex
};

}  // namespace holdfast
