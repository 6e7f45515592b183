// Surface layer: whether the interiors of two simplices (vertex, segment, facet) meet, exactly.
//
// A set of simplices, closed under taking faces, is a complex if and only if the relative interiors of
// any two different ones are disjoint. So everything here is said in terms of relative interiors: of a
// segment without its ends, of a facet without its sides. What two simplices share need not be known.
//
// The signs come from exact/predicates.h; beside them only coordinates are compared. Two convex sets
// have disjoint relative interiors if and only if some line (plane) separates them weakly and does not
// hold both. For polygons of one plane the lines along their sides suffice; for two triangles in
// different planes the order of four points on the common line of the planes does (Guigue, Devillers
// 2003, "Fast and robust triangle-triangle overlap test using orientation predicates").
#pragma once

#include <array>
#include <cstdint>

#include "holdfast/types.h"

namespace holdfast {

/// A simplex as the tests take it; a view that owns nothing. The points are affinely independent.
struct Simplex {
  unsigned corners = 0;                  ///< 1: vertex, 2: segment, 3: facet
  std::array<Index, 3> vertex{};         ///< of each corner; equal index means equal point, and vice versa
  std::array<const double*, 3> point{};  ///< x, y, z of each corner
  unsigned axis = 0;                     ///< facets: a coordinate axis that their plane does not hold
  int turn = 0;                          ///< facets: sign of the area in the projection along `axis`
};

/// Dimension of the common part of two interiors.
enum class Meet : std::uint8_t { none, point, length, area };

/// Finds a projection for a facet whose points are set; false if it has zero area.
[[nodiscard]] bool set_projection(Simplex& t);

/// Whether `p` lies strictly between `a` and `b`.
[[nodiscard]] bool in_segment(const double* p, const double* a, const double* b);
/// Whether `p` lies in the interior of facet `t`.
[[nodiscard]] bool in_facet(const double* p, const Simplex& t);
/// Interiors of the segments ab and cd.
[[nodiscard]] Meet segments_meet(const double* a, const double* b, const double* c, const double* d);
/// Interior of the segment ab with that of facet `t`.
[[nodiscard]] Meet segment_meets_facet(const double* a, const double* b, const Simplex& t);
/// Interiors of two facets.
[[nodiscard]] Meet facets_meet(const Simplex& t, const Simplex& u);

/// The last three for callers that know on which side of the facet's plane each end or corner lies
/// (+1, 0, -1; see signs.h).
[[nodiscard]] bool in_facet(const double* p, int side_p, const Simplex& t);
[[nodiscard]] Meet segment_meets_facet(const double* a, int side_a, const double* b, int side_b,
                                       const Simplex& t);
[[nodiscard]] Meet facets_meet(const Simplex& t, const std::array<int, 3>& sides_t, const Simplex& u,
                               const std::array<int, 3>& sides_u);

}  // namespace holdfast
