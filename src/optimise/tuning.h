// Constants of this stage that were found by experiment. docs/tuning.md tells what is known of each.
#pragma once

#include <cstddef>

namespace holdfast::tuning {

// --- With --fill. Thresholds of the paper's Q (1 is regular).
inline constexpr double kGood = 2;  ///< what is better is left alone: users do not see the difference
inline constexpr double kBad = 30;  ///< from here on elements come first and alone may be shaken
inline constexpr double kFlat =
    100;  ///< from here on, and from kFlatForTarget targets on, an element is flat
inline constexpr double kFlatForTarget = 2;
inline constexpr double kWorthReconnecting = 200;  ///< from here on a search may fail more often
inline constexpr double kHopeless = 1000;          ///< from here on, and from kHopelessForTarget targets on,
inline constexpr double kHopelessForTarget = 30;   ///< an element is worth a point
inline constexpr double kNull = 1e10;              ///< from here on Q is rounding: four points of one plane
inline constexpr double kLeastGain = 0.98;     ///< part of the worst Q that a change worth its time leaves
inline constexpr double kLeastPointGain = 10;  ///< times by which points that stay better the worst Q
inline constexpr double kCuredByOnePoint = 2;  ///< hopeless elements that one point takes away, at most

// Work, in exchanges tried, some 10 microseconds each.
inline constexpr std::size_t kLeastWork = 1200;  ///< so that small meshes are done thoroughly
inline constexpr std::size_t kWorkPerTet = 4;    ///< so that the time stays proportional to the mesh
inline constexpr std::size_t kUsualShare = 4;    ///< one part of so many is for what is not worth a point
/// The most for that: millions of thin elements of a smooth surface would use up all in both searches.
inline constexpr std::size_t kMostUsual = 1'000'000, kMostUsualAgain = 200'000;
inline constexpr std::size_t kPromisingTimes = 10;  ///< as much for what would better the worst
inline constexpr std::size_t kIdle = 300;           ///< work without a gain after which nothing is promising
inline constexpr std::size_t kReconnectWork = 50;   ///< of a search, as timed
inline constexpr std::size_t kPatientWork = 200;    ///< of a patient one
inline constexpr std::size_t kInsertWork = 20;      ///< of a point
inline constexpr std::size_t kRemoveWork = 30;      ///< of an attempt to do without a point
inline constexpr std::size_t kShakeWork = 200;      ///< for repairs after a shake

// Patience, in attempts in vain.
inline constexpr int kRounds = 3;         ///< over flat elements: each opens ways for the next
inline constexpr int kMostFailures = 12;  ///< of elements that are not bad, before they are left
inline constexpr int kReconnectionsInVain = 3, kReconnectionsInVainForFlat = 12;
inline constexpr int kMostPatient = 2;  ///< patient searches a mesh: each takes milliseconds
inline constexpr int kShakesInVain = 2, kShakesInVainForFlat = 8;

inline constexpr std::size_t kMostShakes = 40;  ///< a mesh
inline constexpr int kShakenEdges = 30;         ///< a shake
/// Slots of all shakes of a mesh together: what a shake takes back once was a copy of the mesh.
inline constexpr std::size_t kMostShakenSlots = 1'000'000;
/// Tetrahedra of a shell that is exchanged: larger ones hardly ever pay, and cost their cube. With field
/// points the elements are many, so that the rest is not worth the time.
inline constexpr std::size_t kMostShellForQ = 12, kMostShellForEnergy = 9;
inline constexpr int kMostInsertSteps = 16;         ///< tetrahedra by which the cavity of a point grows
inline constexpr std::size_t kMostMovedBall = 200;  ///< tetrahedra at a vertex that is moved: Q takes time

}  // namespace holdfast::tuning
