// Check: the faces of all tetrahedra, grouped by their three vertices.
//
// Each of the four sides of a tetrahedron is listed under the smallest vertex of the side. The lists are
// sorted, so that the tetrahedra at one face are adjacent. Nothing of the mesher's adjacency is used.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "check/pulse.h"
#include "holdfast/types.h"

namespace holdfast::checking {

/// Side i of a tetrahedron is opposite its corner i. Seen from outside a positive tetrahedron these
/// corners turn counterclockwise: (b-a) x (c-a) points away from corner i.
inline constexpr std::array<std::array<std::uint8_t, 3>, 4> side_corners{
    {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

/// One side of one tetrahedron, without its smallest vertex.
struct HalfFace {
  Index middle, largest;
  std::uint32_t code;  ///< 8 * tetrahedron + 2 * side + (the side's corners are an odd permutation)

  [[nodiscard]] Index tetrahedron() const { return code >> 3; }
  [[nodiscard]] unsigned side() const { return (code >> 1) & 3U; }
  [[nodiscard]] bool odd() const { return (code & 1U) != 0; }
};

class FaceTable {
 public:
  static constexpr std::size_t none = SIZE_MAX;
  /// The codes have room for at most this many tetrahedra.
  static constexpr std::size_t most_tetrahedra = std::size_t{1} << 29;

  FaceTable() = default;
  /// All indices must be below `vertex_count` and distinct within a tetrahedron.
  FaceTable(std::span<const Tetrahedron> tetrahedra, std::size_t vertex_count, Pulse& pulse);

  /// Where the half-faces of the face with these vertices begin, or `none`. All indices are accepted.
  [[nodiscard]] std::size_t find(Triangle face) const;
  /// The half-faces, from `begin` on, that have the same vertices as the one at `begin`.
  [[nodiscard]] std::span<const HalfFace> group(std::size_t begin) const;
  [[nodiscard]] std::size_t size() const { return half_faces_.size(); }

  /// Calls `visit(begin, sorted vertices, half-faces)` for each face.
  template <class Visit>
  void for_each(Visit&& visit) const {
    for (std::size_t vertex = 0; vertex + 1 < start_.size(); ++vertex)
      for (std::size_t begin = start_[vertex]; begin < start_[vertex + 1];) {
        const std::size_t end = group_end(begin, start_[vertex + 1]);
        const HalfFace& half = half_faces_[begin];
        visit(begin, Triangle{static_cast<Index>(vertex), half.middle, half.largest},
              std::span<const HalfFace>(half_faces_).subspan(begin, end - begin));
        begin = end;
      }
  }

 private:
  [[nodiscard]] std::size_t group_end(std::size_t begin, std::size_t limit) const;

  std::vector<std::size_t> start_;  ///< start of each vertex's list, and the end of the last
  std::vector<HalfFace> half_faces_;
};

/// The corners of a tetrahedron's side, in the order of `side_corners`.
[[nodiscard]] inline Triangle side_of(const Tetrahedron& tetrahedron, unsigned side) {
  const auto& corner = side_corners[side];
  return {tetrahedron[corner[0]], tetrahedron[corner[1]], tetrahedron[corner[2]]};
}

/// Sorts three vertices. Returns true if the permutation is odd.
bool sort_corners(Triangle& face);

}  // namespace holdfast::checking
