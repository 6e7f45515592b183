// Holdfast: elements of second order, with a node in the middle of each edge.
#pragma once

#include <functional>
#include <vector>

#include "holdfast/export.h"
#include "holdfast/limits.h"
#include "holdfast/types.h"

namespace holdfast {

/// Gives each edge of a volume's tetrahedra, facets and segments a node in its middle, rounded to doubles
/// (`Volume::mid_nodes`). Existing nodes are replaced. Nodes are numbered in the order of the edges in the
/// tetrahedra, then in the other elements of the volume. Throws std::out_of_range for indices of no vertex,
/// std::length_error if nodes exceed 32 bits, and Interrupted for its limits.
HOLDFAST_API void add_mid_nodes(Volume& volume, const Limits& limits = {});

/// The tetrahedra of a volume of second order whose Jacobian is not proven positive everywhere, ascending.
/// Those of straight edges are so flat that their nodes, rounded to doubles, turn them. The volume is sound,
/// and its numbers are finite. Throws Interrupted for its limits.
[[nodiscard]] HOLDFAST_API std::vector<Index> not_positive_elements(const Volume& volume,
                                                                    const Limits& limits = {});

struct CurveOptions : Limits {
  /// How far a node may move, in the surface's unit; 0: a tenth of its edge's length.
  double tolerance = 0;
};

struct CurveReport {
  std::size_t on_facets = 0;  ///< nodes on edges of facets
  std::size_t moved = 0;      ///< of these, those that now lie on the smooth surface
  /// Of these, those whose edge is farther from that surface than the tolerance.
  std::size_t beyond = 0;
  std::size_t straightened = 0;  ///< those that stay straight because an element would not be positive
  std::size_t not_positive = 0;  ///< tetrahedra not proven positive although all their edges are straight
  double farthest = 0;           ///< the largest distance that a node moved
};

/// Moves the nodes on edges of facets onto a smooth surface, given by triangles (finer ones, as a rule). Each
/// node moves to the nearest point if that is near enough. The Jacobian of every tetrahedron is then proven
/// positive everywhere; where this fails, nodes go back to the middle of their edges. Corners stay. Nodes are
/// added if the volume has none. Throws std::out_of_range for indices of no vertex, std::invalid_argument for
/// a tolerance or coordinates that are not finite, and Interrupted for its limits.
HOLDFAST_API CurveReport curve_mid_nodes(Volume& volume, const Complex& surface,
                                         const CurveOptions& options = {});

}  // namespace holdfast
