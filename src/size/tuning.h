// Constants of this stage that were found by experiment. docs/tuning.md says what is known about each.
#pragma once

namespace holdfast::tuning {

/// Times the shortest edge at a vertex, from which on the longest makes long ones count for more.
inline constexpr double kUnlike = 4;

inline constexpr double kGradation = 0.3;  ///< where none is asked for

// More than that, by the share of vertices from which sizes grow along an edge by more than its
// length.
inline constexpr double kFewSteep = 0.35, kManySteep = 0.5;
inline constexpr double kGradationOfSteep = 0.5;  ///< where many are

// What a facet needs for points next to it.
inline constexpr double kNeedOfFacet = 0.3;      ///< of its longest side, where the surface decides on sizes
inline constexpr double kNeedWhereAsked = 0.15;  ///< where the user does: small boxes must get their number
inline constexpr double kMostNeed = 2.5;  ///< times the size wanted: else large facets leave no room for it
/// The same where the user decides: small elements there are bad, and the number is made up for elsewhere.
inline constexpr double kMostNeedWhereAsked = 5;
inline constexpr double kFarBeyond = 1.5;       ///< times the size wanted there: what needs less can bear it
inline constexpr double kFallOfNeed = 1.2;      ///< a unit of length
inline constexpr double kLeastClearance = 0.4;  ///< of the size that a facet needs at a point: its distance
inline constexpr double kClearanceWhereAsked = 0.5;  ///< the same where the user decides

}  // namespace holdfast::tuning
