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

/// What is joined before the arrangement of a round: nothing in the first two, then what is nearer to each
/// other than some last bits of the largest coordinate.
struct Plan {
  double last_bits = 0;
  bool moves_input = false;
};
constexpr std::array<Plan, 13> kRounds{{{},
                                        {},
                                        {0x1p2, false},
                                        {0x1p4, false},
                                        {0x1p6, false},
                                        {0x1p8, false},
                                        {0x1p10, false},
                                        {0x1p11, false},
                                        {0x1p11, true},
                                        {0x1p14, true},
                                        {0x1p17, true},
                                        {0x1p20, true},
                                        {0x1p24, true}}};

class Rounding {
 public:
  Rounding(State state, const RepairOptions& options, RepairReport& report, const Step& step,
           const Threads& threads)
      : options_(options), report_(report), step_(step), threads_(threads) {
    rounded_.state = std::move(state);
  }

  Rounded run() {
    for (round_ = 0; round_ < kRounds.size() && !rounded_.is_valid; ++round_) {
      if (kRounds[round_].last_bits > 0 && !join(kRounds[round_])) break;
      cut();
    }
    // What the last round made is judged, too.
    rounded_.is_valid = rounded_.is_valid || trouble_of(rounded_.state, here(), threads_).none();
    return std::move(rounded_);
  }

 private:
  [[nodiscard]] Step here() const {
    return [this](double fraction) { step_(1 - 1 / (1 + static_cast<double>(round_) + fraction)); };
  }

  /// False if nothing is in trouble. Bending makes new sides, which are looked at again.
  bool join(const Plan& plan) {
    constexpr int kPasses = 4;
    const double gap = plan.last_bits * last_bit(rounded_.state);
    for (int pass = 0; pass < kPasses; ++pass) {
      const Trouble trouble = trouble_of(rounded_.state, here(), threads_);
      if (trouble.none()) return pass > 0;
      report_.rung = plan.moves_input ? Rung::snapped : Rung::coarser;
      if (pass > 0 && trouble.size() >= in_trouble_) break;
      in_trouble_ = trouble.size();
      const double moved = settle(rounded_.state, trouble, gap, plan.moves_input, here());
      if (moved == 0) break;
      rounded_.displacement = sum_above(rounded_.displacement, moved);
    }
    return true;
  }

  void cut() {
    const Complex complex = rounded_.state.complex();
    const Elements elements = elements_of(complex, threads_);
    const std::vector<std::uint8_t> known = known_elements(rounded_.state, elements);
    arrange::ArrangeOptions arranging;
    arranging.threads = threads_;
    arranging.known = known;
    arranging.most_points = most_points();
    arrange::Arrangement arrangement;
    try {
      arrangement = arrange::arrange(complex, elements, here(), arranging);
    } catch (const arrange::TooManyPoints&) {
      if (round_ == 0) throw;
      return;  // the next round joins more
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

  /// Where little was in trouble, many new points are a sign of facets that lie in each other: rather than
  /// cut all that, the next round joins more.
  [[nodiscard]] std::size_t most_points() const {
    if (round_ == 0) return options_.most_points;
    if (round_ == 1) return std::min(options_.most_points, 1000 + 4 * report_.points);
    return std::min(options_.most_points, 200 + 4 * in_trouble_);
  }

  void tell(const arrange::Arrangement& arrangement) {
    report_.rounds = round_ + 1;
    if (round_ == 0) {
      rounded_.left_out = arrangement.left_out;
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
  std::size_t round_ = 0, in_trouble_ = 0;
};

}  // namespace

Rounded round_arranged(State state, const RepairOptions& options, RepairReport& report, ExactSurface&,
                       const Step& step, const Threads& threads) {
  return Rounding(std::move(state), options, report, step, threads).run();
}

}  // namespace holdfast::repairing
