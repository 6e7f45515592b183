// Constants of this stage that were found by experiment. docs/tuning.md says what is known about each.
#pragma once

#include <cstddef>

namespace holdfast::tuning {

// Passes of flips over all that is missing. The next one may reach what one attempt does not, from the mesh
// that the attempts for others have left meanwhile.
inline constexpr int kMostFlipPasses = 25;
inline constexpr int kMostIdlePasses = 3;        ///< in a row
inline constexpr std::size_t kIdlePass = 20;     ///< an idle pass recovers less than one in so many
inline constexpr std::size_t kPassBudget = 500;  ///< sign tests, roughly, of an attempt at a crossing
/// Constraints: what is close in number is close in memory.
inline constexpr std::size_t kShuffledBlock = 1000;

// Where flips give a constraint up.
inline constexpr std::size_t kMostCrossings = 2000;  ///< of a segment or facet
/// Edges through a facet: with more, its cavities cost less.
inline constexpr std::size_t kMostPiercing = 200;
inline constexpr std::size_t kMostFlipFailures = 100;  ///< crossings of one facet that could not be cleared
inline constexpr std::size_t kMostClipped = 1000;      ///< tetrahedra of a shell whose ears are clipped
inline constexpr int kMostWalk = 400;  ///< steps round a vertex; then its whole ball is looked at

// The two cavities of a facet.
inline constexpr int kCavityPasses = 8;        ///< of flips, in a cavity's own mesh
inline constexpr int kMostGrowth = 2;          ///< times that a cavity grows beyond its missing faces
inline constexpr double kCavityMargin = 0.5;   ///< of the box round a cavity, in extents
inline constexpr double kAboveFacet = 0x1p-6;  ///< extents, of the points round a facet inclined to its box
inline constexpr double kDeepest = 1e6;  ///< extents below the facet, of the point that makes it Delaunay

}  // namespace holdfast::tuning
