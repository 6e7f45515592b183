// Constants of this stage, found by experiment. docs/tuning.md says what is known about each.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "holdfast/holdfast.h"

namespace holdfast::tuning {

// --- With --fill. Thresholds of the paper's Q (1 is regular).
inline constexpr double kGood = 2;  ///< better elements are left alone: users do not see the difference
inline constexpr double kBad = 30;  ///< from here on elements come first, and only these may be shaken
/// From here on, and from kFlatForTarget targets on, an element is flat.
inline constexpr double kFlat = 100;
inline constexpr double kFlatForTarget = 2;
inline constexpr double kWorthReconnecting = 200;  ///< from here on a search may fail more often
inline constexpr double kHopeless = 1000;          ///< from here on, and from kHopelessForTarget targets on,
inline constexpr double kHopelessForTarget = 30;   ///< an element is worth a point
inline constexpr double kNull = 1e10;              ///< from here on Q is only rounding: four coplanar points
inline constexpr double kLeastGain = 0.98;         ///< part of the worst Q that a worthwhile change leaves
inline constexpr double kLeastPointGain = 10;      ///< factor by which points that stay improve the worst Q
inline constexpr double kCuredByOnePoint = 2;      ///< hopeless elements that one point removes, at most

// Work, in exchanges tried, some 10 microseconds each.
inline constexpr std::size_t kLeastWork = 1200;  ///< so that small meshes are done thoroughly
inline constexpr std::size_t kWorkPerTet = 4;    ///< so that the time stays proportional to the mesh
/// Factor for a flat element with field points, where other elements are left alone.
inline constexpr std::size_t kWorkOfFlatTimes = 5;
inline constexpr std::size_t kUsualShare = 4;  ///< one part of this many is for elements not worth a point
/// The most work for these: otherwise millions of thin elements on a smooth surface would use up all work in
/// both searches.
inline constexpr std::size_t kMostUsual = 1'000'000, kMostUsualAgain = 200'000;
/// The most work, and the most on what is promising. Where nearly all of millions of elements are flat, and
/// exchanges take ten times as long as elsewhere, work in proportion to the mesh takes a quarter of an hour.
inline constexpr std::size_t kMostWork = 1'000'000, kMostPromising = 2'000'000;
inline constexpr std::size_t kPromisingTimes = 10;  ///< factor of the work on what would improve the worst
inline constexpr std::size_t kIdle = 300;           ///< work without a gain after which nothing is promising
inline constexpr std::size_t kReconnectWork = 50;   ///< of a search, as timed
inline constexpr std::size_t kPatientWork = 200;    ///< of a patient one
inline constexpr std::size_t kInsertWork = 20;      ///< of a point
inline constexpr std::size_t kRemoveWork = 30;      ///< of an attempt to remove a point
inline constexpr std::size_t kShakeWork = 200;      ///< for repairs after a shake

// In parts, on several threads.
inline constexpr std::size_t kWeightOfFlat = 50,
                             kWeightOfBad = 10;  ///< work on an element; others weigh 1
inline constexpr std::size_t kWorstTriedAgain = 64, kWorkOnWorst = 3000;  ///< when the parts are done
inline constexpr double kMostMixed = 0.25;           ///< share of tetrahedra between parts: above it no cut
inline constexpr std::size_t kSpareSlots = 2048;     ///< that the ways for an element may use
inline constexpr std::size_t kTetsASpareSlot = 128;  ///< one more slot for this many tetrahedra of a part
inline constexpr std::size_t kSlotsAPoint = 16;      ///< and so many for each point that it may get

// Patience, in unsuccessful attempts.
inline constexpr int kRounds = 3;         ///< over flat elements: each opens ways for the next
inline constexpr int kMostFailures = 12;  ///< of elements that are not bad, before they are left alone
inline constexpr int kReconnectionsInVain = 3, kReconnectionsInVainForFlat = 8;
inline constexpr int kMostPatient = 2;  ///< patient searches for each mesh: each takes milliseconds
inline constexpr int kShakesInVain = 2, kShakesInVainForFlat = 4;

inline constexpr std::size_t kMostShakes = 40;  ///< for each mesh
inline constexpr int kShakenEdges = 30;         ///< for each shake
/// Slots of all shakes of a mesh together, so that large meshes get few. (A shake itself costs only what it
/// changes.)
inline constexpr std::size_t kMostShakenSlots = 1'000'000;
/// Polyhedra filled anew: tetrahedra of the first and of the second one that is tried; the least Q that is
/// worth it, and the least gain; polyhedra for each mesh, and how many of these without success. Tetrahedra
/// at a point to be removed, and points tried without success.
inline constexpr std::array<std::size_t, 2> kFilledAnew{100, 200};
inline constexpr double kLeastFilledAnew = 10, kFilledAnewForTarget = 3, kLeastGainOfFilling = 1.1;
inline constexpr int kMostFilledAnew = 40, kFilledAnewInVain = 2;
inline constexpr std::size_t kMostFilledBall = 60;
inline constexpr int kPointsInVain = 2;
/// Tetrahedra of a shell that is exchanged: larger shells hardly ever pay, and their cost is cubic. With
/// field points there are many elements, so the rest is not worth the time.
inline constexpr std::size_t kMostShellForQ = 12, kMostShellForEnergy = 9;
inline constexpr int kMostInsertSteps = 16;         ///< tetrahedra by which the cavity of a point grows
inline constexpr std::size_t kMostMovedBall = 200;  ///< tetrahedra at a moved vertex: Q takes time

// Grows a cavity from a bad element until it can be filled in another way.
struct Reconnecting {
  int attempts, steps;        ///< steps: tetrahedra that each attempt may add
  int every;                  ///< steps between two searches: a search costs more than growing on
  std::size_t most_vertices;  ///< of the cavity
  std::size_t most_nodes;     ///< of the search tree
};
inline constexpr Reconnecting kUsual{1, 10, 4, 14, 100};
inline constexpr Reconnecting kForFlat{1, 20, 8, 20, 200};     ///< a flat element is worth larger cavities
inline constexpr Reconnecting kPatient{2, 20, 2, 20, 300};     ///< for an element that would get a point
inline constexpr Reconnecting kWithoutPoint{2, 6, 1, 18, 60};  ///< to remove a point in the end
inline constexpr std::size_t kLeastTets = 3;  ///< fewer tetrahedra cannot be filled in another way

// A vertex is moved in random directions. The step doubles after a gain and is halved after failures.
inline constexpr int kMoveTries = 60, kMovePatience = 4;  ///< tries, and failures in a row
inline constexpr double kFirstStep = 0.1;                 ///< of the size of the kernel

// Flips that clear the way for each other.
inline constexpr int kFlatDepth = 4;                  ///< levels of flips
inline constexpr std::size_t kMostShellForFlat = 14;  ///< tetrahedra of a shell
inline constexpr std::size_t kFlatShells = 200;       ///< shells examined for one element

// --- With field points. Angles are given by their sines.
/// Which of the bad elements comes first. On surfaces full of needles the facets force most of the worst
/// elements, so the elements nearest to being good come first. But with the least effort, and
/// where the result is compared with that of --fill, the worst must not be left over.
enum class First : std::uint8_t { the_worst, the_mildest };
inline constexpr double kHopelessSine = 0.14;  ///< 8 degrees: below, energies grow less: much is forced
/// Passes over the whole volume, then work on single elements.
struct Passes {
  int passes;
  double sine;         ///< of the angle below which elements are exchanged in a pass
  double smooth_sine;  ///< of the angle below which the vertices of elements are moved in a pass
  double aim;          ///< of the angle below which single elements are worked on
  double patient_aim;  ///< of the angle below which everything is tried on single elements
  int rounds;
  First first;  ///< in a round
  /// Work for a round, in elements tried, about three microseconds each. Most volumes use a small part of it.
  /// The rest is for volumes full of elements that the surface forces and that nothing improves.
  double work_per_tet;
  /// The most points for single elements: on good surfaces few elements take one, but needles would take
  /// points without end.
  double inserted_per_tet;
  double least_work = 1500;  ///< of a round, in elements tried, so that small meshes are done thoroughly
  double share_of_the_worst = 0.3;  ///< of the work of a round, after the mildest
  /// Where so much touches no constraint, and so much of the whole is bad as well, rounds get their work
  /// again, up to this many times.
  double most_shares = 10;
  bool points_must_pay = false;  ///< measured by the shares of elements with small angles
  double hopeless_sine = kHopelessSine;
  double saturation = 0;   ///< of hopeless elements (energy.h), but in patient rounds
  int patient_rounds = 3;  ///< factor for the rounds: the very worst are few and get all that help
  /// After the rounds, elements below this are worked on, too, the mildest first: little work moves many of
  /// them out of the shares of small angles.
  double aim_of_mild = 0, work_of_mild_per_tet = 0;
};
/// The rest of fast effort on results that are compared with others, if such a share of the elements is below
/// its aim after this many passes: one patient round.
struct Brief {
  double many_bad = 0.05;  ///< smooth surfaces with a fine mesh have 0.00001 to 0.012
  int most_passes = 2;
  double patient_work_per_tet = 0.06, least_patient_work = 600;
  /// For each removed element: how much more the others may weigh (kWeightBelow).
  double most_cost = 0.1;
};
inline constexpr Brief kBrief;
[[nodiscard]] constexpr Passes passes_of(Effort effort) {
  switch (effort) {
    case Effort::fast:
      return {1, 0.45, 0.50, 0.26, 0.24, 1, First::the_worst, 0.2, 0.04};
    case Effort::good:
      return {1, 0.45, 0.50, 0.36, 0.24, 1, First::the_mildest, 8, 0.04};
    case Effort::best:
      break;
  }
  return {6, 0.65, 0.80, 0.60, 0.34, 6, First::the_worst, 10, 0.08};
}
/// Passes that continue where less effort ended, with whatever that left undone; more of them if shares are
/// to be reduced.
[[nodiscard]] constexpr Passes further_passes_of(Effort effort, bool lowers_shares) {
  if (effort != Effort::good) return passes_of(effort);
  Passes passes{0, 0.45, 0.50, 0.36, 0.24, 1, First::the_mildest, 1, 0.02};
  passes.aim_of_mild = 0.5;  // 30 degrees
  passes.work_of_mild_per_tet = 0.03;
  if (!lowers_shares) return passes;
  passes.aim = 0.46;  // 27 degrees
  passes.rounds = 3;
  passes.work_per_tet = 1.3;
  passes.inserted_per_tet = 0.042;
  passes.least_work = 2400;
  passes.most_shares = 1;  // what was left need not be inside for lack of work
  passes.points_must_pay = true;
  passes.patient_rounds = 2;
  passes.hopeless_sine = 0.33;  // 19 degrees: elements below hardly ever leave a share
  passes.saturation = 0.1;
  return passes;
}
inline constexpr int kMostPasses = 6;    ///< while many elements are bad, because passes improve these faster
inline constexpr double kManyBad = 0.1;  ///< of the elements: from here on they are many
inline constexpr double kPatientShare = 0.1;       ///< of the work of a round for each of these
inline constexpr double kBeyondPatientAim = 0.02;  ///< so that elements just better get the cheap ways, too
inline constexpr double kSineWorthAPoint = 0.42;   ///< 25 degrees; no element above is worth a vertex
// Points that must pay.
/// Sines of 10, 20 and 30 degrees, and what an element with a smaller angle weighs.
struct WeightBelow {
  double sine, weight;
};
inline constexpr std::array<WeightBelow, 3> kWeightBelow{{{0.1736, 1}, {0.342, 1}, {0.5, 1}}};
inline constexpr double kWeightThatPays = 0.5;        ///< of an additional element
inline constexpr double kPartOfVolumeThatPays = 0.7;  ///< part of the weight, by volume, that may remain
// Points that are removed again, by how much more the elements beside them weigh for each removed element.
inline constexpr double kCostOfWhatMustGo = -1;
inline constexpr double kWeightOfTwiceTheEnergy = 0.07;  ///< of an element
inline constexpr double kSineNotToFallBelow = 0.02;      ///< 1 degree, unless there are worse elements
// Contractions.
inline constexpr double kLongestContracted = 1.6;  ///< sizes: longer edges would violate the wanted sizes
inline constexpr double kLongestThinned = 2;       ///< the same, when points that do not pay are removed
inline constexpr double kLongerContracted = 2;     ///< factor of the longest edge before, if that is longer
// Shares of the elements that trigger more shares of the work.
inline constexpr double kMuchInside = 0.15, kManyBadInside = 0.002;
inline constexpr double kSineOfBad = 0.17364817766693033;  ///< 10 degrees
// Work, in elements tried, some three microseconds each, as timed.
inline constexpr double kRefillWork = 600;         ///< 1 to 4 ms
inline constexpr double kAddWork = 6;              ///< the shells of a point
inline constexpr double kAddTetsAWork = 60;        ///< tetrahedra of its cavities
inline constexpr double kContractTetsAWork = 100;  ///< tetrahedra looked at
inline constexpr double kSmoothTetsAWork = 10;     ///< tetrahedra of a ball

/// Square of the factor for the sine of an obtuse angle: it does less harm.
inline constexpr double kObtuse = 1.5;
inline constexpr double kSineOfFlat = 0.035;  ///< 2 degrees: worse elements get the ways of --fill, too
/// Part of a sum of energies that is only rounding, and a gain that is worth a change.
inline constexpr double kEnergyRounding = 1e-9, kLeastEnergyGain = 0.02;

// Search for the best place of a vertex: first the place that its faces prefer, then down the gradient.
inline constexpr int kIdealTrials = 3;  ///< each goes half as far
/// The most of the energy that remains after a patient move.
inline constexpr double kLeastPatientGain = 0.98;
inline constexpr int kDescentSteps = 6, kDescentTrials = 4;  ///< trials a step
inline constexpr double kDifference = 1e-5;     ///< sizes of the star, for the gradient by differences
inline constexpr double kDescentStep = 0.15;    ///< sizes of the star, in the first trial
inline constexpr double kStepDivisor = 2.5;     ///< of the step from trial to trial
inline constexpr double kLeastDescent = 0.995;  ///< part of the energy above which the descent ends
inline constexpr double kFarFromGain = 3;  ///< times the energy removed: from there no descent leads below it

// Cavities, in tetrahedra: balls of hundreds take long and are seldom bad.
inline constexpr std::size_t kMostContractedBall = 100, kMostAddedBall = 200;
inline constexpr std::size_t kMostRefilled = 25;    ///< the best cavity for a point mostly has fewer
inline constexpr std::size_t kFartherThanBest = 5;  ///< by which the cavity grows beyond the best so far
/// A search without a point soon takes too long above this.
inline constexpr std::size_t kMostRefillVertices = 13;
inline constexpr std::size_t kRefillNodes = 100;  ///< of that search
/// Part of the worst energy that remains after a filling without a point.
inline constexpr double kRefillGain = 0.5;
/// Share of progress; the rest is for the mesh near the cuts.
inline constexpr double kWorkOfFirstParts = 0.9;

}  // namespace holdfast::tuning
