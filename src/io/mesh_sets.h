// Shared by the writers for solvers: second-order nodes, and the tetrahedra at a facet.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "holdfast/types.h"

namespace holdfast::io {

[[nodiscard]] inline bool is_second_order(const Volume& volume) { return !volume.mid_nodes.empty(); }

/// The number of vertices and of mid-edge nodes, which are numbered after them.
[[nodiscard]] inline std::size_t node_count(const Volume& volume) {
  return volume.vertices.size() + volume.mid_nodes.points.size();
}
[[nodiscard]] inline const Point& node(const Volume& volume, std::size_t i) {
  return i < volume.vertices.size() ? volume.vertices[i]
                                    : volume.mid_nodes.points[i - volume.vertices.size()];
}

/// The nodes of an element in the order of a format.
struct Nodes {
  std::array<Index, 10> of{};
  std::size_t count = 0;
  [[nodiscard]] const Index* begin() const { return of.data(); }
  [[nodiscard]] const Index* end() const { return of.data() + count; }
};

/// The order of a format for the nodes on a tetrahedron's edges 01 12 02 03 13 23, which is the order of
/// Abaqus and VTK.
using EdgeOrder = std::array<std::size_t, 6>;
inline constexpr EdgeOrder kVtkEdges{0, 1, 2, 3, 4, 5};
inline constexpr EdgeOrder kGmshEdges{0, 1, 2, 3, 5, 4};
/// Netgen: 01 02 03 12 13 23.
inline constexpr EdgeOrder kNetgenEdges{0, 2, 3, 1, 4, 5};

[[nodiscard]] Nodes tetrahedron_nodes(const Volume& volume, std::size_t i, const EdgeOrder& order);
/// Corners, then the nodes on the edges 01 12 02.
[[nodiscard]] Nodes facet_nodes(const Volume& volume, std::size_t i);
/// Both ends, then the node between them.
[[nodiscard]] Nodes segment_nodes(const Volume& volume, std::size_t i);

/// A tetrahedron at a facet, and its face there: the one opposite corner `side`.
struct SideOfTet {
  Index tetrahedron;
  std::uint8_t side;
};

/// The tetrahedra behind and in front of a facet; its corners turn counter-clockwise as seen from the one
/// behind.
struct SidesOfFacet {
  std::optional<SideOfTet> behind, front;
};

/// One for each facet.
[[nodiscard]] std::vector<SidesOfFacet> sides_of_facets(const Volume& volume);

}  // namespace holdfast::io
