// The exact tiers behind the predicates, one by one, so that tests can name the tier that decides and
// compare tiers with each other. Users of the predicates include exact/predicates.h.
//
// Integers first: most coordinates of one call span few binary orders of magnitude, so that they are
// integers of 61 or 125 bits in a common unit, and fixed-width integer determinants cost less than
// expansions. Expansions take what spans more, unbounded integers what would over- or underflow.
#pragma once

#include <cstddef>
#include <optional>

#include "exact/point.h"

namespace holdfast::exact::detail {

/// What decided a sign, cheapest first. integerN: fixed-width integers, coordinates of N bits.
enum class Tier { filter, integer64, integer128, integer192, integer256, expansion, big_integer };

struct Decision {
  int sign;
  Tier tier;
};

// The tiers after the filter, in order, until one decides.
[[nodiscard]] Decision decide_orient3d(const double* a, const double* b, const double* c, const double* d);
[[nodiscard]] Decision decide_orient3d(PointRef a, PointRef b, PointRef c, PointRef d);
[[nodiscard]] Decision decide_orient2d(const double* a, const double* b, const double* c);
[[nodiscard]] Decision decide_orient2d(PointRef a, PointRef b, PointRef c, int axis);
[[nodiscard]] Decision decide_insphere(const double* a, const double* b, const double* c, const double* d,
                                       const double* e);
[[nodiscard]] Decision decide_incircle(const double* a, const double* b, const double* c, const double* d);

/// Bits of a coordinate in N limbs. The headroom of three bits lets all sums in the determinants fit:
/// differences stay below 2^(64 N - 2), a sum of three squares below 3 * 2^(128 N - 4), and so on.
template <std::size_t N>
inline constexpr int kFixedWidth = 64 * static_cast<int>(N) - 3;

// Fixed-width integers of N limbs (N = 1, 2 for doubles, 1 to 4 for exact points); none where the
// coordinates span more than kFixedWidth<N> bits.
template <std::size_t N>
[[nodiscard]] std::optional<int> integer_orient3d(const double* a, const double* b, const double* c,
                                                  const double* d);
template <std::size_t N>
[[nodiscard]] std::optional<int> integer_orient3d(PointRef a, PointRef b, PointRef c, PointRef d);
template <std::size_t N>
[[nodiscard]] std::optional<int> integer_orient2d(const double* a, const double* b, const double* c);
template <std::size_t N>
[[nodiscard]] std::optional<int> integer_orient2d(PointRef a, PointRef b, PointRef c, int axis);
template <std::size_t N>
[[nodiscard]] std::optional<int> integer_insphere(const double* a, const double* b, const double* c,
                                                  const double* d, const double* e);
template <std::size_t N>
[[nodiscard]] std::optional<int> integer_incircle(const double* a, const double* b, const double* c,
                                                  const double* d);

// Expansion arithmetic; none where it could over- or underflow. insphere: none, too, where a difference
// of coordinates is no double, since its expansions would be thousands of components long.
[[nodiscard]] std::optional<int> expansion_orient3d(const double* a, const double* b, const double* c,
                                                    const double* d);
[[nodiscard]] std::optional<int> expansion_orient2d(const double* a, const double* b, const double* c);
[[nodiscard]] std::optional<int> expansion_insphere(const double* a, const double* b, const double* c,
                                                    const double* d, const double* e);

// Unbounded integers; always decide.
[[nodiscard]] int big_orient3d(PointRef a, PointRef b, PointRef c, PointRef d);
[[nodiscard]] int big_orient2d(PointRef a, PointRef b, PointRef c, int axis);
[[nodiscard]] int big_insphere(const double* a, const double* b, const double* c, const double* d,
                               const double* e);
[[nodiscard]] int big_incircle(const double* a, const double* b, const double* c, const double* d);

}  // namespace holdfast::exact::detail
