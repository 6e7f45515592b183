// Constants of this stage that were found by experiment. docs/tuning.md says what is known about each.
#pragma once

#include <cstddef>

#include "suppress/refill.h"
#include "suppress/small_polyhedron.h"

namespace holdfast::tuning {

// Rounds over all points, and rounds in a row without a gain.
inline constexpr int kShrinkRounds = 30;
inline constexpr int kShrinkIdle = 3;  ///< recentring may open a way only later
inline constexpr int kInsistRounds = 20, kInsistIdle = 8;
inline constexpr int kRoundingRounds = 6;  ///< over points without doubles: each shakes what it cannot round
// One point of so many gone is worth another go; where some have no doubles, one gone or rounded of more.
inline constexpr std::size_t kWorthwhile = 10, kWorthwhileWithoutDoubles = 100;

// Flips that take edges at a point away, in sign tests roughly. A point that no double holds is worth more.
inline constexpr std::size_t kQuickBudget = 2000, kPatientBudget = 20000;  ///< for an edge
inline constexpr std::size_t kMostEdges = 20;  ///< as many edges' budgets are spent on a point

// Balls that grow and are filled again without their point.
inline constexpr Growth kQuickGrowth{
    .attempts = 2, .steps = 5, .search = {.most_vertices = 18, .most_nodes = 60}};
inline constexpr Growth kPatientGrowth{
    .attempts = 20, .steps = 12, .search = {.most_vertices = 22, .most_nodes = 1000}};
inline constexpr int kMergeSteps = 4;  ///< tetrahedra by which the balls of two points grow
inline constexpr PolyhedronOptions kMergeSearch{.most_vertices = 20, .most_nodes = 200};
inline constexpr std::size_t kMostMerged = 200;  ///< tetrahedra of a ball: a cavity's growth is quadratic

// Positions in doubles.
inline constexpr int kMostSteps = 30;        ///< tetrahedra by which a ball grows until its kernel holds one
inline constexpr int kMostRandomSteps = 12;  ///< the same at random: each takes a complete search
inline constexpr int kRandomTries = 4;

// Random flips round a point.
inline constexpr int kShakenEdgesOfPoint = 40;  ///< a shake
/// Shakes of a mesh: in proportion to the rest of the work, within limits.
inline constexpr std::size_t kFewShakes = 16, kTetsAShake = 100, kMostPointShakes = 200;
inline constexpr std::size_t kShakenBudget = 800;  ///< as kQuickBudget, after a shake
inline constexpr std::size_t kMostWander = 4;      ///< steps from the ball to the edge, fewer than this
inline constexpr int kShakeDepth = 1;              ///< levels of flips for an edge
inline constexpr std::size_t kShakeBudget = 200;   ///< for an edge
/// Tetrahedra of the ball of a corner: gathering takes time.
inline constexpr std::size_t kMostShakenBall = 500;

// The proof that a point has to stay, for components that may be searched completely.
inline constexpr std::size_t kMostTetsOfProof = 60;
inline constexpr PolyhedronOptions kProofSearch{.most_vertices = 20, .most_nodes = 1000};

}  // namespace holdfast::tuning
