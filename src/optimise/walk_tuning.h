// Constants of walks from the worst element. docs/tuning.md says what is known about each.
#pragma once

#include <cstddef>

namespace holdfast::tuning {

inline constexpr double kWorthWalking = 10, kWorthWalkingForTarget = 3;  ///< from such a worst Q on
/// An element stays where every vertex makes one on its facet that is at least so many times as bad.
inline constexpr double kForcedFrom = 0.8;
inline constexpr int kMostWalks = 40, kWalksInVain = 4;                ///< a mesh
inline constexpr int kWalkSteps = 150;                                 ///< exchanges tried
inline constexpr int kWalkStepsARemoval = 25, kWalkStepsASearch = 16;  ///< exchanges made
inline constexpr unsigned kPercentAtEdges = 70;                        ///< the others are at corners
/// Steps from the edge, or corner, to the exchange, fewer than these.
inline constexpr std::size_t kMostSteppedFromEdge = 3, kMostSteppedFromCorner = 4;
inline constexpr std::size_t kMostWalkedBall = 500;  ///< tetrahedra at a corner: gathering takes time

}  // namespace holdfast::tuning
