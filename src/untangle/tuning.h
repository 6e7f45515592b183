// Constants of untangling that were found by experiment. docs/tuning.md says what is known about each.
#pragma once

#include <array>
#include <cstddef>

namespace holdfast::tuning {

// The order of the steps. Shares are of all tetrahedra: so many are not positive.
/// Rounds of swaps and moves; each has to lessen the deficit.
inline constexpr std::size_t kMostUntangleRounds = 10;
inline constexpr double kManyTangled = 0.02;  ///< from here on smoothing near by is time lost
inline constexpr double kMostTangled = 0.1;   ///< from here on moving vertices one by one is, too
/// Rings of tetrahedra round those that are not positive, in which vertices are smoothed: first few, since
/// most knots are local, and in the end all.
inline constexpr unsigned kEverywhere = 1u << 20;
inline constexpr std::array<unsigned, 3> kSmoothedRings{3, 12, kEverywhere};

// Swaps and moves, one by one.
inline constexpr std::size_t kSwapTriesATet = 20;  ///< for each tetrahedron that is not positive at first
inline constexpr std::size_t kLeastSwapTries = 1000;
inline constexpr int kMostVisits = 12;  ///< of a vertex: the gain of its moves may shrink for ever
inline constexpr std::size_t kMostFacesOfKernel = 400;  ///< of a ball: the linear programme takes long
/// Parts of the way from the paper's place P* back to where the vertex is (omega of equation 4).
inline constexpr std::array<double, 3> kOmegas{0, 0.5, 0.75};

// Relaxation: every vertex to the mean of its neighbours, over and over.
inline constexpr int kRelaxSweeps = 60;
inline constexpr double kOverRelaxation = 1.6;  ///< times the way to the mean

// Descent of the foldover energy. Each value of epsilon changes the goal, hence few iterations for each.
inline constexpr int kMostEpsilons = 100, kMostIdleEpsilons = 20;  ///< values, and those without a gain
inline constexpr int kIterationsAnEpsilon = 10;
/// Share of the energy: an iteration that gains less is the last of its epsilon.
inline constexpr double kLeastDescentOfEpsilon = 1e-4;
inline constexpr double kFirstEpsilon = 1;     ///< determinants of tetrahedra are of the order of 1
inline constexpr double kLeastEpsilon = 1e-9;  ///< below, chi is the determinant up to rounding
inline constexpr double kMostOfChi = 0.9;  ///< part of the worst chi that a smaller epsilon leaves at most
inline constexpr double kLambda = 0.05;    ///< weight of size: boundaries force sizes on a mesh

// The minimisation (Nocedal, Wright 2006: the usual values).
inline constexpr std::size_t kHistory = 7;           ///< steps that stand for the second derivatives
inline constexpr double kSufficientDecrease = 1e-4;  ///< Wolfe's first condition, of the slope
inline constexpr double kCurvature = 0.9;            ///< Wolfe's second condition, of the slope
inline constexpr int kMostStepTrials = 30;           ///< each halves or doubles the step
inline constexpr double kFirstMove = 0.1;            ///< length of the first trial, in mean edges of the mesh

// Cavities that the mesher fills.
inline constexpr int kMostTriesWithPoints = 3;  ///< each without the points the last named; then without any

}  // namespace holdfast::tuning
