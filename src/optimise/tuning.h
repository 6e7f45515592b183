// Constants of this stage that were found by experiment. docs/tuning.md tells what is known of each.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "holdfast/holdfast.h"

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
/// Times that for a flat element beside field points, where others are left alone.
inline constexpr std::size_t kWorkOfFlatTimes = 5;
inline constexpr std::size_t kUsualShare = 4;  ///< one part of so many is for what is not worth a point
/// The most for that: millions of thin elements of a smooth surface would use up all in both searches.
inline constexpr std::size_t kMostUsual = 1'000'000, kMostUsualAgain = 200'000;
inline constexpr std::size_t kPromisingTimes = 10;  ///< as much for what would better the worst
inline constexpr std::size_t kIdle = 300;           ///< work without a gain after which nothing is promising
inline constexpr std::size_t kReconnectWork = 50;   ///< of a search, as timed
inline constexpr std::size_t kPatientWork = 200;    ///< of a patient one
inline constexpr std::size_t kInsertWork = 20;      ///< of a point
inline constexpr std::size_t kRemoveWork = 30;      ///< of an attempt to do without a point
inline constexpr std::size_t kShakeWork = 200;      ///< for repairs after a shake

// In parts, on several threads.
inline constexpr std::size_t kWeightOfFlat = 50,
                             kWeightOfBad = 10;  ///< of an element, others weigh 1: the work
inline constexpr std::size_t kWorstTriedAgain = 64, kWorkOnWorst = 3000;  ///< once the parts are done
inline constexpr double kMostMixed = 0.25;        ///< share of the tetrahedra between parts: more is not cut
inline constexpr std::size_t kSpareSlots = 2048;  ///< that the ways for an element may take
inline constexpr std::size_t kTetsASpareSlot = 128;  ///< one slot more for so many tetrahedra of a part

// Patience, in attempts in vain.
inline constexpr int kRounds = 3;         ///< over flat elements: each opens ways for the next
inline constexpr int kMostFailures = 12;  ///< of elements that are not bad, before they are left
inline constexpr int kReconnectionsInVain = 3, kReconnectionsInVainForFlat = 8;
inline constexpr int kMostPatient = 2;  ///< patient searches a mesh: each takes milliseconds
inline constexpr int kShakesInVain = 2, kShakesInVainForFlat = 4;

inline constexpr std::size_t kMostShakes = 40;  ///< a mesh
inline constexpr int kShakenEdges = 30;         ///< a shake
/// Slots of all shakes of a mesh together, so that large meshes get few. (A shake itself costs what it
/// changes.)
inline constexpr std::size_t kMostShakenSlots = 1'000'000;
/// Polyhedra that are filled anew: tetrahedra of the first and of the second that is tried; the least Q for
/// which, and the least gain; polyhedra a mesh, and of these in vain. Tetrahedra at a point that is to go,
/// and points in vain.
inline constexpr std::array<std::size_t, 2> kFilledAnew{100, 200};
inline constexpr double kLeastFilledAnew = 10, kFilledAnewForTarget = 3, kLeastGainOfFilling = 1.1;
inline constexpr int kMostFilledAnew = 40, kFilledAnewInVain = 2;
inline constexpr std::size_t kMostFilledBall = 60;
inline constexpr int kPointsInVain = 2;
/// Tetrahedra of a shell that is exchanged: larger ones hardly ever pay, and cost their cube. With field
/// points the elements are many, so that the rest is not worth the time.
inline constexpr std::size_t kMostShellForQ = 12, kMostShellForEnergy = 9;
inline constexpr int kMostInsertSteps = 16;         ///< tetrahedra by which the cavity of a point grows
inline constexpr std::size_t kMostMovedBall = 200;  ///< tetrahedra at a vertex that is moved: Q takes time

// A cavity that grows from a bad element until it can be filled another way.
struct Reconnecting {
  int attempts, steps;        ///< tetrahedra that each may add
  int every;                  ///< steps between two searches: a search costs more than growing on
  std::size_t most_vertices;  ///< of the cavity
  std::size_t most_nodes;     ///< of the search tree
};
inline constexpr Reconnecting kUsual{1, 10, 4, 14, 100};
inline constexpr Reconnecting kForFlat{1, 20, 8, 20, 200};     ///< a flat element is worth larger cavities
inline constexpr Reconnecting kPatient{2, 20, 2, 20, 300};     ///< for an element that would get a point
inline constexpr Reconnecting kWithoutPoint{2, 6, 1, 18, 60};  ///< to do without a point in the end
inline constexpr std::size_t kLeastTets = 3;  ///< fewer tetrahedra cannot be filled another way

// A vertex is moved in random directions, the step twice as long after a gain, half as long after failures.
inline constexpr int kMoveTries = 60, kMovePatience = 4;  ///< tries, and failures in a row
inline constexpr double kFirstStep = 0.1;                 ///< of the size of the kernel

// Flips that clear each other's way.
inline constexpr int kFlatDepth = 4;                  ///< levels of flips
inline constexpr std::size_t kMostShellForFlat = 14;  ///< tetrahedra of a shell
inline constexpr std::size_t kFlatShells = 200;       ///< shells looked at for one element

// --- With field points. Angles are told by their sines.
/// Which of the bad elements comes first. On surfaces full of needles the facets force most of the worst, so
/// that what is nearest to being good is helped the soonest. But where the least is spent, and the result is
/// held to that of --fill, the worst must not be left over.
enum class First : std::uint8_t { the_worst, the_mildest };
inline constexpr double kHopelessSine = 0.14;  ///< 8 degrees: below, energies grow less, for much is forced
/// Passes over the whole volume, then work on single elements.
struct Passes {
  int passes;
  double sine;         ///< of the angle below which elements are exchanged in a pass
  double smooth_sine;  ///< of the angle below which the vertices of elements are moved in a pass
  double aim;          ///< of the angle below which single elements are worked on
  double patient_aim;  ///< of that below which everything is tried on them
  int rounds;
  First first;  ///< in a round
  /// For a round, in elements tried, some three microseconds each. Most volumes take a small part of it: it
  /// is for those full of elements that the surface forces, which nothing helps.
  double work_per_tet;
  /// The most points for single elements: of good surfaces few take any, but needles would take them without
  /// end.
  double inserted_per_tet;
  double least_work = 1500;  ///< of a round, in elements tried, so that small meshes are done thoroughly
  double share_of_the_worst = 0.3;  ///< of the work of a round, after the mildest
  /// Where so much touches no constraint, and so much of the whole is bad besides, rounds get their work
  /// again, up to so many times.
  double most_shares = 10;
  bool points_must_pay = false;  ///< by the shares of elements with small angles
  double hopeless_sine = kHopelessSine;
  int patient_rounds = 3;  ///< times the rounds: the very worst are few and get all that help
  /// Once the rounds are done, elements below that are worked on, too, the mildest first: with little work
  /// many leave the shares of small angles.
  double aim_of_mild = 0, work_of_mild_per_tet = 0;
};
/// What is left of fast effort on results that are compared with others, where so large a share of the
/// elements is below its aim after so many passes: one patient round.
struct Brief {
  double many_bad = 0.05;  ///< of smooth surfaces with a fine mesh 0.00001 to 0.012 are
  int most_passes = 2;
  double patient_work_per_tet = 0.06, least_patient_work = 600;
  /// Of an element that goes: what others may weigh more (kWeightBelow).
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
/// Of what goes on where less effort ended, with whatever that has left undone: more of it where shares are
/// to become less.
[[nodiscard]] constexpr Passes further_passes_of(Effort effort, bool lowers_shares) {
  if (effort != Effort::good) return passes_of(effort);
  Passes passes{0, 0.45, 0.50, 0.36, 0.24, 1, First::the_mildest, 1, 0.02};
  if (!lowers_shares) {
    passes.aim_of_mild = 0.5;  // 30 degrees
    passes.work_of_mild_per_tet = 0.03;
    return passes;
  }
  passes.aim = 0.46;  // 27 degrees
  passes.rounds = 3;
  passes.work_per_tet = 1;
  passes.inserted_per_tet = 0.042;
  passes.least_work = 2400;
  passes.most_shares = 1;  // what was left need not be inside for want of work
  passes.points_must_pay = true;
  passes.patient_rounds = 2;
  passes.hopeless_sine = 0.3;  // 17 degrees: what is below hardly leaves a share
  return passes;
}
inline constexpr int kMostPasses = 6;              ///< while many elements are bad, which passes help faster
inline constexpr double kManyBad = 0.1;            ///< of the elements: as many are many
inline constexpr double kPatientShare = 0.1;       ///< of the work of a round for each of these
inline constexpr double kBeyondPatientAim = 0.02;  ///< so that what is just better gets the cheap ways, too
inline constexpr double kSineWorthAPoint = 0.42;   ///< 25 degrees; no element above is worth a vertex
// Points that must pay.
/// Sines of 10, 20 and 30 degrees, and what an element with a smaller angle weighs.
struct WeightBelow {
  double sine, weight;
};
inline constexpr std::array<WeightBelow, 3> kWeightBelow{{{0.1736, 0.7}, {0.342, 1}, {0.5, 1}}};
inline constexpr double kWeightThatPays = 0.5;        ///< of an element more
inline constexpr double kPartOfVolumeThatPays = 0.7;  ///< part of what weighs, by volume, that may stay
// Points that go again, by what the elements beside them weigh more for each that goes.
inline constexpr double kCostOfWhatMustGo = -1;
inline constexpr double kWeightOfTwiceTheEnergy = 0.07;  ///< of an element
inline constexpr double kSineNotToFallBelow = 0.02;      ///< 1 degree, unless there is worse
// Contractions.
inline constexpr double kLongestContracted = 1.6;  ///< sizes: longer edges would undo the sizes asked for
inline constexpr double kLongestThinned = 2;       ///< the same, where points go that do not pay
inline constexpr double kLongerContracted = 2;     ///< times the longest edge before, where that is longer
// What asks for more shares of the work: of the elements.
inline constexpr double kMuchInside = 0.15, kManyBadInside = 0.002;
inline constexpr double kSineOfBad = 0.17364817766693033;  ///< 10 degrees
// Work, in elements tried, some three microseconds each, as timed.
inline constexpr double kRefillWork = 600;         ///< 1 to 4 ms
inline constexpr double kAddWork = 6;              ///< the shells of a point
inline constexpr double kAddTetsAWork = 60;        ///< tetrahedra of its cavities
inline constexpr double kContractTetsAWork = 100;  ///< tetrahedra looked at
inline constexpr double kSmoothTetsAWork = 10;     ///< tetrahedra of a ball

inline constexpr double kObtuse = 1.5;  ///< square of what the sine of an obtuse angle counts for: less harm
inline constexpr double kSineOfFlat = 0.035;  ///< 2 degrees: what is worse gets the ways of --fill, too
/// Part of a sum of energies that is rounding, and a gain that is worth a change.
inline constexpr double kEnergyRounding = 1e-9, kLeastEnergyGain = 0.02;

// Where a vertex is best: the place that its faces would have it at, then down the gradient.
inline constexpr int kIdealTrials = 3;             ///< each goes half as far
inline constexpr double kLeastPatientGain = 0.98;  ///< part of the energy that a patient move leaves at most
inline constexpr int kDescentSteps = 6, kDescentTrials = 4;  ///< trials a step
inline constexpr double kDifference = 1e-5;     ///< sizes of the star, for the gradient by differences
inline constexpr double kDescentStep = 0.15;    ///< sizes of the star, in the first trial
inline constexpr double kStepDivisor = 2.5;     ///< of the step from trial to trial
inline constexpr double kLeastDescent = 0.995;  ///< part of the energy above which the descent ends
inline constexpr double kFarFromGain =
    3;  ///< times the energy that goes: from there no descent leads below it

// Cavities, in tetrahedra: balls of hundreds take long and are seldom bad.
inline constexpr std::size_t kMostContractedBall = 100, kMostAddedBall = 200;
inline constexpr std::size_t kMostRefilled = 25;        ///< the best one for a point has mostly fewer
inline constexpr std::size_t kFartherThanBest = 5;      ///< by which it grows beyond the best so far
inline constexpr std::size_t kMostRefillVertices = 13;  ///< a search without a point soon takes too long
inline constexpr std::size_t kRefillNodes = 100;        ///< of that search
inline constexpr double kRefillGain =
    0.5;  ///< part of the worst energy that a filling without a point leaves
inline constexpr double kWorkOfFirstParts = 0.9;  ///< share of progress; the rest is what was near the cuts

}  // namespace holdfast::tuning
