// Last resorts. They change the whole surface, after changes near the facets in trouble did not help: sheets
// are made one, vertices are welded, and vertices are rounded to the points of a grid.
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "repair/bounds.h"
#include "repair/covered.h"
#include "repair/grid.h"
#include "repair/ladder.h"
#include "repair/weld.h"

namespace holdfast::repairing {
namespace {

/// Distances, in last bits, within which vertices are welded. Up to the user's tolerance a few are enough: it
/// says what may become one.
std::vector<double> welded_last_bits(double tolerance) {
  std::vector<double> levels;
  for (const double part : kPartsOfTolerance)
    if (part * tolerance >= kWeldedLastBits.front()) levels.push_back(part * tolerance);
  for (const double last_bits : kWeldedLastBits)
    if (last_bits > tolerance) levels.push_back(last_bits);
  return levels;
}

}  // namespace

bool Ladder::join_all() {
  if (options_.join > 0) return false;
  State last;
  for (const double last_bits : kJoinedLastBits) {
    RepairOptions options = options_;
    options.join = last_bits * last_bit(given_.vertices);
    Ladder joining(given_, options, report_, exact_, planes_, step_, threads_);
    joining.proven_ = proven_;
    joining.flatten_all(options.join, sides_);
    has_shared_ |= joining.has_shared_;
    if (joining.rounded_.displacement == 0 || are_same(joining.rounded_.state, last)) continue;
    last = joining.rounded_.state;
    joining.report_.rung = Rung::coarser;
    joining.begin();
    joining.try_plans(sides_);
    if (take_if_valid(joining)) return true;
  }
  return false;
}

void Ladder::weld_all() {
  std::optional<Ladder> welding;
  std::size_t least_points = new_points_[0] - new_points_[0] / 8;
  const double bit = last_bit(given_.vertices);
  for (const double last_bits : welded_last_bits(options_.weld / bit)) {
    const double gap = last_bits * bit;
    State state = given_;
    const double moved = weld(state, gap, here());
    if (moved == 0) continue;
    const double displacement = sum_above(given_displacement_, moved);
    if (welding && displacement == welding->given_displacement_ && are_same(state, welding->given_)) {
      welding->welded_last_bits_ = last_bits;  // the same, except for the plans that are tried last
      welding->try_next_plans();
    } else {
      welding.emplace(welded(std::move(state), displacement, last_bits));
      welding->begin();
      welding->try_plans(sides_);
    }
    if (take_if_valid(*welding)) return;
    // A smaller number of new points is a sign that welding has brought sheets together.
    if (welding->new_points_[0] >= least_points) continue;
    least_points = welding->new_points_[0];
    if (snap_all(*welding)) return;
    Ladder joining = welded(welding->given_, welding->given_displacement_, last_bits);
    joining.flatten_all(gap, sides_);
    if (joining.rounded_.displacement == welding->given_displacement_) continue;
    joining.begin();
    joining.try_plans(sides_);
    if ((joining.is_covered() && take_if_valid(joining)) || snap_all(joining)) return;
  }
}

Ladder Ladder::welded(State state, double displacement, double last_bits) const {
  Ladder welding(std::move(state), options_, report_, exact_, planes_, step_, threads_);
  welding.welded_last_bits_ = last_bits;
  welding.before_ = before_;
  welding.proven_ = proven_;
  welding.work_.most = kLittleWork.of(given_.facets.size());
  welding.rounded_.displacement = displacement;
  welding.report_.rung = Rung::snapped;
  return welding;
}

bool Ladder::snap_all(Ladder from) {
  const double widest = from.starts_welded() ? from.welded_last_bits_ : kGridLastBits.back();
  Attempt best{from.rounded_.state, from.trouble_, from.rounded_.displacement};
  for (const double last_bits : kGridLastBits) {
    if (last_bits > widest || best.trouble.size() > kMany) return false;
    from.snap(std::ldexp(1.0, std::ilogb(last_bits * last_bit(given_.vertices))), best);
    if (from.is_covered() && take_if_valid(from)) return true;
  }
  return false;
}

void Ladder::snap(double cell, Attempt& best) {
  constexpr int kRounds = 8, kRoundsInVain = 2;
  stand(best);
  rounded_.is_valid = false;
  report_.rung = Rung::snapped;
  for (int round = 0, in_vain = 0; round < kRounds && in_vain < kRoundsInVain; ++round) {
    const double moved = snap_to_grid(rounded_.state, trouble_, cell);
    rounded_.displacement = sum_above(rounded_.displacement, moved);
    if (!cut(std::min(options_.most_points, 200 + 4 * trouble_.size()))) return;
    if (rounded_.is_valid) return;
    trouble_ = trouble_of(rounded_.state, here(), threads_);
    rounded_.is_valid = is_done();
    if (rounded_.is_valid) return;
    ++in_vain;
    if (trouble_.size() >= best.trouble.size()) continue;
    best = {rounded_.state, trouble_, rounded_.displacement};
    in_vain = 0;
  }
}

bool Ladder::is_covered() const {
  return rounded_.is_valid &&
         (before_ == nullptr || covered_within(rounded_.state, *before_, rounded_.displacement, here()));
}

bool Ladder::take_if_valid(const Ladder& other) {
  report_.rounds = other.report_.rounds;
  has_shared_ |= other.has_shared_;
  if (!other.rounded_.is_valid) return false;
  report_ = other.report_;
  welded_last_bits_ = other.welded_last_bits_;
  rounded_ = other.rounded_;
  return true;
}

bool Ladder::are_same(const State& a, const State& b) {
  return a.facets == b.facets && a.vertices == b.vertices && a.segments == b.segments;
}

}  // namespace holdfast::repairing
