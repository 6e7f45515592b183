// Constants of this stage that were found by experiment. docs/tuning.md says what is known about each.
#pragma once

#include <cstddef>

namespace holdfast::tuning {

/// Tetrahedra of a shell that is exchanged to make the mesh Delaunay: time grows with its cube.
inline constexpr std::size_t kMostShellForDelaunay = 8;

// The front. Lengths are in the sizes that are wanted there.
/// Circumradius of a tetrahedron to be refined; 0.61 is regular.
inline constexpr double kLargeRadius = 0.85;
/// The same where the surface's own sizes jump, and nobody asks for others: fewer points, which the
/// improvement adds where they help.
inline constexpr double kLargeRadiusOfSteep = 1;
inline constexpr double kLevel = 1.3;  ///< a size over the mean of those round it, if sizes do not grow
inline constexpr double kLongestPart = 0.65;  ///< of an edge that is to be split: the size over its length
inline constexpr double kNearest = 0.7;       ///< least distance of a new point from others
inline constexpr double kLeastHeight = 0.4;   ///< least height of a new point over a facet
/// Half of the height of a regular tetrahedron: new edges get the mean of the sizes at their ends.
inline constexpr double kHalfHeight = 0.4;
/// A face whose circle has a larger squared radius, in squared lengths, is large: its point is put over its
/// middle; 0.33 is regular.
inline constexpr double kLargestRound = 0.6;
inline constexpr double kHeightOverLarge = 0.75;   ///< of a point over the middle of a large face, in lengths
inline constexpr double kLeastSphereHeight = 0.3;  ///< of a sphere's centre, in heights of the point: no room
/// The thinnest wall that gets points in its middle, in heights over a large facet.
inline constexpr double kThinnestWall = 0.6;
/// Tetrahedra that a function of sizes is asked for at a time.
inline constexpr std::size_t kFieldBlock = 1'000;
inline constexpr std::size_t kFrontBlock = 10'000;                 ///< tetrahedra that are shuffled together
inline constexpr std::size_t kPrefetchFar = 8, kPrefetchNear = 4;  ///< tetrahedra ahead in the front
/// Tetrahedra examined in vain: as many for each that there is, and at least these.
inline constexpr std::size_t kPatience = 60, kLeastPatience = 1'000'000;
inline constexpr std::size_t kMostInTable = 512;  ///< vertices of a cavity's ring that are linked by a table
/// Tetrahedra that take milliseconds to go through: limits are looked at in between.
inline constexpr std::size_t kLargeCavity = 10'000;

// Cuts into parts.
inline constexpr double kWorthCutting = 60'000;       ///< tetrahedra; four times as many for each level more
inline constexpr int kMostLevels = 4;                 ///< of cuts: 16 parts
inline constexpr std::size_t kCutSamples = 1u << 13;  ///< tetrahedra that determine the cuts
inline constexpr double kShareStep = 0.05;            ///< between the shares below a plane that are compared
inline constexpr double kCloseToPlane = 0.02;         ///< of the longest extent: what counts as near a plane
inline constexpr double kMostAtCuts = 0.25;  ///< share of tetrahedra with a vertex on a cut: more is not cut
inline constexpr double kMostAtFirstCuts = 0.8;  ///< the same before there are points inside
/// Radii of triangles of a plane that are refined, in sizes; 0.58 is regular.
inline constexpr double kLargestOnCut = 0.9, kHugeOnCut = 2;
inline constexpr double kMostHugeOnCuts = 0.7;  ///< share of the volume at cuts: more is not cut
inline constexpr double kWorkOnCuts = 0.1;      ///< share of the stage's work, for its progress

// Room for what is expected.
inline constexpr std::size_t kTetsAVertexInside = 5;
inline constexpr double kMostRoom = 1 << 26;  ///< tetrahedra: 5 GB of addresses

// Cuts again, of what lies near those before.
inline constexpr int kRings = 2;                      ///< rings of tetrahedra round a cut: cavities need room
inline constexpr double kWorthCuttingAgain = 20'000;  ///< tetrahedra, at least
inline constexpr double kShareWorthCuttingAgain = 1.0 / 12;  ///< of the mesh
inline constexpr double kMostLeft = 0.5;     ///< share of what was cut before, so that it ends
inline constexpr double kLeastShare = 0.25;  ///< below a plane: one in the middle would be the plane before

}  // namespace holdfast::tuning
