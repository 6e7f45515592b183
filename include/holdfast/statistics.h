// Holdfast: figures of a surface or a volume.
#pragma once

#include "holdfast/export.h"
#include "holdfast/limits.h"
#include "holdfast/types.h"

namespace holdfast {

/// Counts and measures. Lengths, areas and volumes are sums in doubles; signs are exact.
struct Statistics {
  /// The elements of one id.
  struct Group {
    int id = 0;
    std::string name;       ///< empty: none
    std::size_t count = 0;  ///< of tetrahedra, facets, segments or vertices
    double measure = 0;     ///< volume, area or length; 0 for vertices
    double area = 0;        ///< of a region: its boundary, including interfaces with other regions
  };
  std::size_t vertices = 0;
  std::size_t unused_vertices = 0;  ///< on no tetrahedron, facet or segment
  std::size_t segments = 0, facets = 0, tetrahedra = 0;
  std::size_t mid_nodes = 0;  ///< of a volume of second order
  std::size_t edges = 0;      ///< distinct edges of tetrahedra, facets and segments
  Point low{}, high{};        ///< the box around the finite vertices
  double shortest_edge = 0, mean_edge = 0, longest_edge = 0;
  double area = 0;  ///< of the facets
  /// Volume of the tetrahedra. For a `closed` surface: the volume that it bounds, negative if it is turned
  /// inward.
  double volume = 0;
  bool closed = false;       ///< of a surface: each side of a facet is matched by an opposite side
  double boundary_area = 0;  ///< of the faces with a tetrahedron on one side only
  /// By id; one group of id 0 if there are no ids.
  std::vector<Group> regions, facet_markers, segment_markers;
  std::vector<Group> vertex_markers;   ///< without those of id 0
  std::size_t negative = 0, null = 0;  ///< tetrahedra of negative volume, and of none, exactly
  /// Shape of the tetrahedra: see `Report::Elements` and `Report::Shape`.
  double worst_quality = 0, min_dihedral_deg = 0, max_dihedral_deg = 0;
  std::array<std::size_t, 15> least_dihedral{};  ///< by their least angle, in bins of 5 degrees
  std::array<std::size_t, 10> quality{};         ///< by Q, in bins that end at `Report::quality_bins`
};

/// Throws std::out_of_range for indices of no vertex, std::invalid_argument if there are not as many ids as
/// entities, and Interrupted for its limits.
[[nodiscard]] HOLDFAST_API Statistics statistics(const Volume& volume, const Limits& limits = {});
/// Figures of a surface. Its regions are those that its seeds number, without counts.
[[nodiscard]] HOLDFAST_API Statistics statistics(const Surface& surface, const Limits& limits = {});

}  // namespace holdfast
