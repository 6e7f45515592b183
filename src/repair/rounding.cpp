// The exact arrangement rounded to doubles so that it stays valid.
#include "repair/rounding.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "repair/settle.h"
#include "surface/elements.h"

namespace holdfast::repairing {
namespace {

/// Sums of numbers that are rounded up.
double sum_above(double a, double b) {
  if (a == 0 || b == 0) return a + b;
  return std::nextafter(a + b, std::numeric_limits<double>::infinity());
}

double displacement_of(const arrange::Arrangement& arrangement, const std::vector<Point>& positions,
                       const Threads& threads) {
  std::vector<double> all(positions.size());
  parallel_ranges(threads, all.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k)
      all[k] = exact::distance_bound(arrangement.points[k], positions[k].data());
  });
  double most = 0;
  for (const double d : all) most = std::max(most, d);
  return most;
}

/// The last bit of the largest coordinate.
double last_bit(const State& state) {
  double most = 0;
  for (const Point& p : state.vertices)
    for (const double x : p)
      if (std::isfinite(x)) most = std::max(most, std::fabs(x));
  return std::nextafter(most, std::numeric_limits<double>::infinity()) - most;
}

/// What is joined where a surface is still not valid after it was cut and rounded twice: what is nearer to
/// each other than some last bits of the largest coordinate.
struct Plan {
  double last_bits = 0;
  bool moves_input = false;
};
constexpr std::array kPlans{Plan{0x1p2, false},  Plan{0x1p3, false}, Plan{0x1p4, false}, Plan{0x1p5, false},
                            Plan{0x1p6, false},  Plan{0x1p7, false}, Plan{0x1p8, false}, Plan{0x1p9, false},
                            Plan{0x1p10, false}, Plan{0x1p8, true},  Plan{0x1p10, true}, Plan{0x1p12, true},
                            Plan{0x1p14, true},  Plan{0x1p17, true}, Plan{0x1p20, true}, Plan{0x1p24, true}};

class Rounding {
 public:
  Rounding(State state, const RepairOptions& options, RepairReport& report, const Step& step,
           const Threads& threads)
      : options_(options), report_(report), step_(step), threads_(threads) {
    rounded_.state = std::move(state);
  }

  Rounded run() {
    cut(options_.most_points);
    if (!rounded_.is_valid) cut(std::min(options_.most_points, 1000 + 4 * report_.points));
    if (rounded_.is_valid) return std::move(rounded_);
    trouble_ = trouble_of(rounded_.state, here(), threads_);
    for (const Plan& plan : kPlans) {
      if (trouble_.none()) break;
      join(plan);
      if (!trouble_.none()) cut_if_better();
    }
    rounded_.is_valid = trouble_.none();
    return std::move(rounded_);
  }

 private:
  [[nodiscard]] Step here() const {
    return [this](double fraction) { step_(1 - 1 / (1 + static_cast<double>(report_.rounds) + fraction)); };
  }

  /// A state that stands, or may come to stand.
  struct Attempt {
    State state;
    Trouble trouble;
    double displacement;
  };

  /// Joins again and again, since bending makes new sides; the pass that leaves the least in trouble counts.
  /// Where joining does not help by itself, vertices are put where sides pass each other. That may take some
  /// passes: sheets that lie in each other agree only when the diagonals of what they share do, too.
  void join(const Plan& plan) {
    Settle how{plan.last_bits * last_bit(rounded_.state), 0, plan.moves_input, false};
    report_.rung = plan.moves_input ? Rung::snapped : Rung::coarser;
    constexpr int kPasses = 8, kPassesInVain = 4;
    constexpr std::size_t kTooMuch = 4;
    Attempt now{rounded_.state, trouble_, rounded_.displacement};
    int in_vain = 0;
    for (int pass = 0; pass < kPasses && in_vain < kPassesInVain && !trouble_.none(); ++pass) {
      const double moved = settle(now.state, now.trouble, how, here());
      now.trouble = trouble_of(now.state, here(), threads_);
      now.displacement = sum_above(now.displacement, moved);
      if (now.trouble.size() < trouble_.size()) {
        stand(now);
        in_vain = 0;
        continue;
      }
      ++in_vain;
      if (now.trouble.size() > kTooMuch * (trouble_.size() + 16) || (how.passings && moved == 0)) break;
      how.passings = true;
    }
  }

  void stand(Attempt attempt) {
    rounded_.state = std::move(attempt.state);
    rounded_.displacement = attempt.displacement;
    trouble_ = std::move(attempt.trouble);
  }

  arrange::Arrangement arrangement_of(std::size_t most_points) const {
    const Complex complex = rounded_.state.complex();
    const Elements elements = elements_of(complex, threads_);
    const std::vector<std::uint8_t> known = known_elements(rounded_.state, elements);
    arrange::ArrangeOptions arranging;
    arranging.threads = threads_;
    arranging.known = known;
    arranging.most_points = most_points;
    return arrange::arrange(complex, elements, here(), arranging);
  }

  void cut(std::size_t most_points) {
    arrange::Arrangement arrangement;
    try {
      arrangement = arrangement_of(most_points);
    } catch (const arrange::TooManyPoints&) {
      if (report_.rounds == 0) throw;
      return;
    }
    if (arrangement.is_same) {
      rounded_.is_valid = true;
      return;
    }
    tell(arrangement);
    rounded_.displacement =
        sum_above(rounded_.displacement, displacement_of(arrangement, arrangement.nearest, threads_));
    rounded_.state = arranged(rounded_.state, arrangement, arrangement.nearest);
  }

  /// Where little is in trouble, many new points are a sign of facets that lie in each other: rather than cut
  /// all that, the next plan joins more.
  void cut_if_better() {
    arrange::Arrangement arrangement;
    try {
      arrangement = arrangement_of(std::min(options_.most_points, 200 + 4 * trouble_.size()));
    } catch (const arrange::TooManyPoints&) {
      return;
    }
    constexpr std::size_t kMore = 24;
    Attempt cut{arranged(rounded_.state, arrangement, arrangement.nearest), {}, 0};
    cut.trouble = trouble_of(cut.state, here(), threads_);
    if (cut.trouble.size() > 2 * trouble_.size() + kMore) return;
    cut.displacement =
        sum_above(rounded_.displacement, displacement_of(arrangement, arrangement.nearest, threads_));
    stand(std::move(cut));
    tell(arrangement);
  }

  void tell(const arrange::Arrangement& arrangement) {
    if (++report_.rounds == 1) {
      report_.pairs = arrangement.pairs;
      report_.sheets = arrangement.sheets;
      report_.points = arrangement.points.size();
      if (!arrangement.points.empty()) report_.rung = Rung::nearest;
    } else if (report_.rung < Rung::again) {
      report_.rung = Rung::again;
    }
  }

  const RepairOptions& options_;
  RepairReport& report_;
  const Step& step_;
  const Threads& threads_;
  Rounded rounded_;
  Trouble trouble_;
};

}  // namespace

Rounded round_arranged(State state, const RepairOptions& options, RepairReport& report, ExactSurface&,
                       const Step& step, const Threads& threads) {
  return Rounding(std::move(state), options, report, step, threads).run();
}

}  // namespace holdfast::repairing
