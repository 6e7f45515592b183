// Whether a polytope holds an integer point (Lenstra, "Integer programming with a fixed number of variables",
// Math. of Operations Research 1983), in one to three dimensions.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "exact/lattice_reduction.h"
#include "exact/polytope.h"

namespace holdfast::exact {

struct IntegerPointSearch {
  std::optional<IntegerVector> point;
  bool is_complete = true;  ///< without a point: there is none
};

/// Of the points x with low <= x <= high and all half-spaces.
///
/// A polytope without integer points is thin: across some integer form, the shortest for its extent, lie
/// only a few lattice planes (Khinchin's flatness theorem; in the plane at most three, in space at most
/// five). That form is found by lattice reduction, and each of its planes is searched in turn, the middle
/// ones first; everything that decides is exact. `most_planes` bounds the work, and is reached by no polytope
/// known.
[[nodiscard]] IntegerPointSearch find_integer_point(int dimension, std::span<const BigInt> low,
                                                    std::span<const BigInt> high,
                                                    std::span<const IntegerHalfSpace> half_spaces,
                                                    std::size_t most_planes = 2000);

}  // namespace holdfast::exact
