// Constants of this stage that were found by experiment. docs/tuning.md says what is known about each.
#pragma once

#include <cstddef>

#include "recover/recover.h"
#include "suppress/small_polyhedron.h"

namespace holdfast::tuning {

// Flips that are tried again before a constraint is cut. Sign tests, roughly, at a crossing.
inline constexpr FlipRecovery::Effort kRetry{.depth = Flipper::kDeep, .budget = 2000, .thorough = true};
/// Tetrahedra across a facet: from there on its cavities cost less than flips.
inline constexpr std::size_t kManyCrossing = 300;
inline constexpr int kCavityTries = 3;  ///< after the first, each with the points in the facet's plane moved

// Steiner points that are suppressed or recentred between one constraint and the next.
inline constexpr std::size_t kSettleEvery = 4;     ///< points of a segment's chain
inline constexpr int kSettleRounds = 2;            ///< a point may go once those round it went or moved
inline constexpr int kDegreeDepth = 8;             ///< levels of flips that lower a point's degree
inline constexpr std::size_t kDegreeBudget = 200;  ///< sign tests, roughly, for an edge of it
inline constexpr PolyhedronOptions kQuickSearch{.most_vertices = 13, .most_nodes = 40};
inline constexpr PolyhedronOptions kThoroughSearch{.most_vertices = 18, .most_nodes = 200};
// All of them are settled again when there are half as many more as the last time, and these.
inline constexpr std::size_t kSettleAllSlack = 64, kSettleAllTimes = 3, kSettleAllPerTimes = 2;

// Positions of partition points and of fictitious cuts.
inline constexpr int kFirstBits = 26;         ///< of a facet point's parameters; doubled until they suit
inline constexpr std::size_t kMostGaps = 12;  ///< widest gaps between directions that are tried for a cut

}  // namespace holdfast::tuning
