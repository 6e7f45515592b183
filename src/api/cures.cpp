// Which options a repair would need; options are tried from the weakest on.
#include "holdfast/cures.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "mesh/plain_monitor.h"
#include "mesh/started.h"
#include "repair/borders.h"
#include "repair/bounds.h"
#include "repair/near_bodies.h"
#include "repair/state.h"
#include "repair/weld.h"
#include "text/parse.h"

namespace holdfast {
namespace {

/// A digit times a power of ten, parsed from the text that a user would type.
double one_digit(int digit, int exponent) {
  const std::string text = std::to_string(digit) + "e" + std::to_string(exponent);
  double value = exponent > 0 ? HUGE_VAL : 0;  // larger numbers stay infinite
  parse_double(text.data(), text.data() + text.size(), value);
  return value;
}

/// The smallest of 1, 2, ..., 9 times a power of ten that is greater than x > 0.
double one_digit_above(double x) {
  int exponent = 0;
  while (one_digit(1, exponent) > x) --exponent;
  while (one_digit(1, exponent + 1) <= x) ++exponent;
  int digit = 2;
  while (digit <= 9 && one_digit(digit, exponent) <= x) ++digit;
  return digit <= 9 ? one_digit(digit, exponent) : one_digit(1, exponent + 1);
}

bool breaks_validity(const Defect& defect) { return defect.kind < DefectKind::encloses_nothing; }

std::size_t count_of(const DefectSummary& summary, Cause cause) {
  for (const DefectGroup& group : summary.groups)
    if (group.cause == cause) return group.count;
  return 0;
}

/// Which gaps a surface still has.
struct GapsLeft {
  bool narrow = false;    ///< some gap is no wider than the given ones
  bool at_given = false;  ///< a vertex of a given gap still has one

  [[nodiscard]] bool none() const { return !narrow && !at_given; }
};

class Proposal {
 public:
  Proposal(const Complex& complex, std::span<const Defect> defects, const DefectSummary& summary,
           const RepairOptions& options)
      : complex_(complex),
        defects_(defects),
        summary_(summary),
        options_(options),
        monitor_(options_, options_.progress) {}

  Cures run() {
    const auto broken =
        static_cast<std::size_t>(std::count_if(defects_.begin(), defects_.end(), breaks_validity));
    cures_.tried = true;
    cures_.was_valid = broken == 0;
    RepairResult result;
    if (!summary_.gaps.empty()) result = weld();
    if (broken > 0) cures_.cures.push_back({CureKind::cut, broken, 0, 0, 0, 0});
    const bool is_welded = result.outcome == Outcome::done && !result.surface.facets.empty();
    if (broken > 0 && !is_welded) result = attempt(0);
    if (!cures_.tried) return std::move(cures_);
    fill(broken > 0 || is_welded ? result.surface.view() : complex_);
    unite();
    if (cures_.tried && (broken > 0 || summary_.parts > 1)) join(result);
    return std::move(cures_);
  }

 private:
  /// The progress over all trials, whose number is not known in advance.
  static double share(std::size_t trial, double fraction) {
    return 1 - 1 / (1 + static_cast<double>(trial) + fraction);
  }

  RepairOptions next_trial() {
    RepairOptions options = options_;
    if (options_.progress)
      options.progress = [this, trial = trials_++](double fraction) {
        return options_.progress(share(trial, fraction));
      };
    return options;
  }

  RepairResult repaired(const Complex& complex, double weld, double join) {
    RepairOptions options = next_trial();
    options.weld = weld;
    options.join = join;
    options.fill_holes = {};
    options.unite = options.exact = false;
    constexpr std::size_t kFewPoints = 20'000;
    options.most_points = kFewPoints + complex_.facets.size() / 2;
    RepairResult result = repair(complex, options);
    if (result.outcome == Outcome::time_limit || result.outcome == Outcome::cancelled)
      throw Interrupted(result.outcome);
    return result;
  }

  /// Repairs the complex; sets `tried` to false if that takes too many points or finds no doubles.
  RepairResult attempt(double tolerance) {
    RepairResult result = repaired(complex_, tolerance, 0);
    cures_.tried = result.outcome == Outcome::done;
    return result;
  }

  /// A gap may need more than its width, if closing one moves two vertices to a new one or pulls a side away
  /// from the next one. If every length leaves some gaps, the least length that leaves none as narrow as the
  /// given ones counts. Welding alone, without cuts, rules out most lengths.
  RepairResult weld() {
    double widest = 0;
    for (const Gap& gap : summary_.gaps) widest = std::max(widest, gap.distance);
    if (!(widest > 0) || !std::isfinite(widest)) return {};
    constexpr int kAttempts = 10;  // lengths of up to ten times the width
    double tolerance = one_digit_above(widest * (1 + 0x1p-19)), fair_tolerance = 0;
    for (int i = 0; i < kAttempts; ++i, tolerance = one_digit_above(tolerance)) {
      const GapsLeft left = gaps_welded(tolerance, widest);
      if (!left.narrow && fair_tolerance == 0) fair_tolerance = tolerance;
      if (!left.none()) continue;
      RepairResult result = attempt(tolerance);
      if (!cures_.tried || gaps_left(result.surface.view(), widest).none())
        return propose_weld(widest, tolerance, std::move(result));
    }
    if (fair_tolerance == 0) return {};
    RepairResult fair = attempt(fair_tolerance);
    if (cures_.tried && gaps_left(fair.surface.view(), widest).narrow) return {};
    return propose_weld(widest, fair_tolerance, std::move(fair));
  }

  /// Like `gaps_left`, after welding alone.
  GapsLeft gaps_welded(double tolerance, double widest) {
    repairing::State state = repairing::state_of(complex_);
    repairing::weld(state, tolerance, step());
    return gaps_left(state.complex(), widest);
  }

  RepairResult propose_weld(double widest, double tolerance, RepairResult result) {
    cures_.cures.push_back({CureKind::weld, summary_.gaps.size(), widest, tolerance, 0, 0});
    welded_ = tolerance;
    return result;
  }

  GapsLeft gaps_left(const Complex& surface, double widest) const {
    const DefectSummary after = summarise(surface, {});
    const auto is_narrow = [&](const Gap& gap) { return gap.distance <= widest; };
    std::vector<Index> vertices;
    for (const Gap& gap : summary_.gaps) vertices.push_back(gap.vertex);
    std::sort(vertices.begin(), vertices.end());
    const auto had_one = [&](const Gap& gap) {
      return std::binary_search(vertices.begin(), vertices.end(), gap.vertex);
    };
    return {std::any_of(after.gaps.begin(), after.gaps.end(), is_narrow),
            std::any_of(after.gaps.begin(), after.gaps.end(), had_one)};
  }

  void fill(const Complex& valid) {
    const std::vector<repairing::Loop> loops = repairing::border_loops(valid);
    if (loops.empty()) return;
    std::size_t sides = 0;
    for (const repairing::Loop& loop : loops) sides = std::max(sides, loop.size());
    RepairOptions options = next_trial();
    options.weld = 0;
    options.fill_holes = sides;
    options.unite = options.exact = false;
    const RepairResult result = repair(valid, options);
    if (result.outcome == Outcome::time_limit || result.outcome == Outcome::cancelled)
      throw Interrupted(result.outcome);
    cures_.tried = result.outcome == Outcome::done;
    if (!cures_.tried) return;
    const std::size_t left = result.left_open.size();
    cures_.left_open = left;
    if (result.filled.empty()) return;
    cures_.cures.push_back({CureKind::fill_holes, loops.size() - left, 0, 0, sides, left});
  }

  void unite() {
    if (const std::size_t count = count_of(summary_, Cause::parts_cross); count > 0)
      cures_.cures.push_back({CureKind::unite, count, 0, 0, 0, 0});
  }

  /// Proposes a tolerance within which bodies touch. Without it, what they nearly share becomes slivers. What
  /// a repair without options moves anyway is no reason to join faces.
  void join(const RepairResult& plain) {
    constexpr double kNear = 0x1p-20;  // of the extent: more than the rounding of files with six digits
    constexpr double kMuchMore = 16;
    constexpr double kLeastLastBits = 0x1p6;  // a tolerance needs some room for the rounding of distances
    constexpr int kAttempts = 3;
    const double most = kNear * repairing::extent(complex_.vertices);
    const double moved = std::max(plain.max_displacement, repairing::last_bit(complex_.vertices));
    const auto near_in = [&](const Complex& complex) {
      repairing::NearBodies near = repairing::near_bodies(repairing::state_of(complex), most, step());
      if (!(near.thickness > kMuchMore * moved)) near.facets = 0;
      return near;
    };
    const repairing::NearBodies near = near_in(complex_);
    if (near.facets + near.edges == 0) return;
    const bool has_faces = near.facets > 0;
    Cure cure{CureKind::join,
              has_faces ? near.facets : near.edges,
              has_faces ? near.thickness : near.edge_distance,
              0,
              0,
              0,
              has_faces};
    const double least = kLeastLastBits * repairing::last_bit(complex_.vertices);
    cure.tolerance = one_digit_above(std::max(cure.distance * (1 + 0x1p-19), least));
    for (int i = 0; i < kAttempts; ++i, cure.tolerance = one_digit_above(cure.tolerance)) {
      const RepairResult result =
          repaired(complex_, std::max(cure.tolerance, welded_), has_faces ? cure.tolerance : 0);
      if (result.outcome != Outcome::done) continue;
      const repairing::NearBodies after = near_in(result.surface.view());
      if ((has_faces ? after.facets : after.edges) == 0) return cures_.cures.push_back(cure);
    }
  }

  Step step() {
    return [this, trial = trials_++](double fraction) { monitor_.poll(share(trial, fraction)); };
  }

  const Complex& complex_;
  std::span<const Defect> defects_;
  const DefectSummary& summary_;
  const RepairOptions& options_;
  PlainMonitor monitor_;
  std::size_t trials_ = 0;
  double welded_ = 0;
  Cures cures_;
};

}  // namespace

Cures propose_cures(const Complex& complex, std::span<const Defect> defects, const DefectSummary& summary,
                    const RepairOptions& options) {
  RepairOptions timed = options;
  static_cast<Limits&>(timed) = started(options);
  return Proposal(complex, defects, summary, timed).run();
}

}  // namespace holdfast
