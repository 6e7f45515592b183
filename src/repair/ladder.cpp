#include "repair/ladder.h"

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <utility>
#include <vector>

#include "arrange/arrange.h"
#include "numbers/sorted.h"
#include "repair/bounds.h"
#include "repair/exact_surface.h"
#include "repair/tell_round.h"
#include "repair/weld.h"

namespace holdfast::repairing {
namespace {

// If so many times as many elements are in trouble as before, an attempt is given up.
constexpr std::size_t kTooMuch = 4;

// A second cut seldom leaves fewer elements in trouble than the first one by this factor.
constexpr std::size_t kFarFewer = 8;

void add_origins(const State& state, Index facet, std::vector<Index>& origins) {
  const auto parents = state.facet_parents.of(facet);
  origins.insert(origins.end(), parents.begin(), parents.end());
}

/// Facets of one state that the other one has not.
std::vector<Index> changed_facets(const State& before, const State& now) {
  arrange::IndexTable<3> all;
  for (const Triangle& t : now.facets) all.find_or_add(t, 0);
  std::vector<Index> changed;
  for (Index f = 0; f < before.facets.size(); ++f)
    if (all.find(before.facets[f]) == no_entity) changed.push_back(f);
  return changed;
}

}  // namespace

Ladder::Ladder(State state, const RepairOptions& options, const RepairReport& report, const Exact& exact,
               RoundedPlanes& planes, const Step& step, const Threads& threads)
    : options_(options), report_(report), exact_(exact), planes_(planes), step_(step), threads_(threads) {
  rounded_.state = std::move(state);
  work_.most = kMuchWork.of(rounded_.state.facets.size());
}

void Ladder::try_no_more_than(const Ladder& other) {
  joins_all_ = false;
  plans_ = std::min(other.next_plan_ + 1, kPlans.size());
}

bool Ladder::is_overgrown(std::size_t facets) const {
  return !rounded_.is_valid && trouble_.size() > kMany && given_.facets.size() > most_when_joined(facets);
}

void Ladder::try_little() {
  const auto is_much = [](const Plan& plan) { return plan.moves_input || plan.last_bits > kThinnest; };
  plans_ = static_cast<std::size_t>(std::find_if(kPlans.begin(), kPlans.end(), is_much) - kPlans.begin());
  is_welded_ = tries_little_ = true;
}

Rounded Ladder::run_in_plane(double most) {
  is_plane_ = true;
  most_displacement_ = most;
  begin();
  return run();
}

void Ladder::begin() {
  given_ = rounded_.state;
  given_displacement_ = rounded_.displacement;
  const std::optional<std::size_t> points =
      cut(is_plane_ ? std::min(options_.most_points, most_points_in_plane(given_.facets.size()))
                    : options_.most_points,
          &given_);
  grows_ = is_plane_ && !points;
  new_points_[0] = points.value_or(0);
  if (rounded_.is_valid || grows_) return;
  if (!is_plane_) {
    const std::size_t much = kMany + new_points_[0];
    trouble_ = trouble_of(rounded_.state, here(), threads_, much);
    if (trouble_.size() > kMany) {
      once_cut_ = OnceCut{rounded_, trouble_.size()};
      return;
    }
  }
  if (is_plane_ && new_points_[0] > many_points_in_plane(given_.facets.size())) {
    const double much = kMostInTrouble * static_cast<double>(rounded_.state.facets.size());
    grows_ = !trouble_of(rounded_.state, here(), threads_, static_cast<std::size_t>(much)).is_all;
    if (grows_) return;
  }
  cut_again();
  if (!rounded_.is_valid && !is_hopeless()) trouble_ = trouble_of(rounded_.state, here(), threads_);
}

Rounded Ladder::run(SidesOf sides) {
  try_plans(sides);
  if (!rounded_.is_valid && !is_plane_ && joins_all_ && !join_all()) {
    if (!snap_all(*this)) weld_all();
  }
  return std::move(rounded_);
}

void Ladder::flatten_all(double gap, SidesOf sides) {
  sides_ = sides;
  flatten_all(rounded_.state, gap, rounded_.displacement);
}

void Ladder::try_plans(SidesOf sides) {
  sides_ = sides;
  if (rounded_.is_valid || is_hopeless() || (tries_little_ && trouble_.size() > kMany)) return;
  most_facets_ = is_plane_ ? most_in_plane(rounded_.state.facets.size()) : SIZE_MAX;
  if (!is_plane_ && !starts_welded())
    work_.most = kPlansOfMuchWork * kMuchWork.of(rounded_.state.facets.size());
  if (!is_plane_ && trouble_.size() > kMany && begin_with_twins()) return;
  if (!puts_off_flat_) begin_flat(kFlatPlans);
  const bool may_join = report_.rung == Rung::coarser || (once_cut_ && !has_twins());
  if (!is_plane_ && !is_welded_ && trouble_.size() > kFew && may_join) join_first();
  try_next_plans();
}

bool Ladder::begin_with_twins() {
  const double bit = last_bit(given_.vertices), near = kWeldedPlans[0].last_bits * bit;
  const double most = kMostForTwins * extent(given_.vertices);
  const auto distance = distance_of_twins(rounded_.state, trouble_, 0.5, std::max(near, most), here());
  if (!distance) return false;
  // Joining displaces less than moving input vertices, but is slow if sheets nearly coincide.
  is_welded_ = *distance <= near;
  if (is_welded_) {
    begin_flat(kWeldedPlans);
    puts_off_flat_ = trouble_.size() <= kFew;
  }
  if (is_welded_ || starts_welded()) return false;
  double last = 0;
  for (double gap = kTwinsLastBits * bit; last < gap && gap <= most; gap = std::min(4 * gap, most)) {
    last = gap;
    if (gap < *distance) continue;
    State state = given_;
    const double moved = weld(state, gap, here());
    Ladder welding = welded(std::move(state), sum_above(given_displacement_, moved), gap / bit);
    welding.begin();
    if (welding.is_covered() && take_if_valid(welding)) return true;
    report_.rounds = welding.report_.rounds;
  }
  return false;
}

void Ladder::try_next_plans() {
  // In a plane, if the first plan does not reduce the trouble much, the other plans do not either.
  std::size_t most_in_trouble = SIZE_MAX;
  for (; next_plan_ < plans_; ++next_plan_) {
    const Plan& plan = kPlans[next_plan_];
    if (is_plane_ && (plan.moves_input || plan.last_bits > kMostInPlane || is_hopeless())) break;
    if (work_.is_spent() || (starts_welded() && (plan.moves_input || plan.last_bits > welded_last_bits_)))
      break;
    if (is_plane_ && trouble_.size() > most_in_trouble) break;
    most_in_trouble = std::max(2 * kFew, trouble_.size() / 2);
    if (!is_welded_ && (plan.moves_input || trouble_.size() > kFew)) {
      begin_flat_late(kWeldedPlans);
      is_welded_ = true;
    }
    if (puts_off_flat_ && next_plan_ > 0) {
      begin_flat_late(kFlatPlans);
      puts_off_flat_ = false;
    }
    if (!is_done()) cut_late();
    if (is_done()) break;
    join_from_best(plan);
    if (!is_done()) cut_if_better();
  }
  rounded_.is_valid = is_done();
}

void Ladder::cut_again() {
  const std::size_t most = is_plane_ ? 64 + new_points_[0] : 1000 + 4 * report_.points;
  const std::optional<std::size_t> points = cut(std::min(options_.most_points, most));
  new_points_[1] = points.value_or(SIZE_MAX);
  grows_ = is_plane_ && !points;
}

void Ladder::cut_late() {
  if (!once_cut_) return;
  OnceCut first = std::move(*once_cut_);
  once_cut_.reset();
  if (!trouble_.is_all) trouble_ = trouble_of(rounded_.state, here(), threads_);
  if (kFarFewer * trouble_.size() < first.in_trouble) return;
  Rounded before = std::exchange(rounded_, std::move(first.rounded));
  cut_again();
  Trouble now;
  if (!rounded_.is_valid) now = trouble_of(rounded_.state, here(), threads_, trouble_.size());
  rounded_.is_valid = false;
  if (now.size() < trouble_.size())
    trouble_ = std::move(now);
  else
    rounded_ = std::move(before);
}

bool Ladder::is_done() const {
  if (!trouble_.none()) return false;
#ifdef HOLDFAST_VALIDATE
  State doubted = rounded_.state;
  doubted.doubt_all();
  if (!trouble_of(doubted, here(), threads_).none())
    throw std::logic_error("facets that were known to fit together do not");
#endif
  return true;
}

bool Ladder::is_hopeless() const {
  const auto is_far = [&](double displacement) { return displacement > most_displacement_; };
  return grows_ || (is_far(rounded_.displacement) && (!best_ || is_far(best_->displacement)));
}

Step Ladder::here() const {
  return [this](double fraction) { step_(1 - 1 / (1 + static_cast<double>(report_.rounds) + fraction)); };
}

void Ladder::join(const Plan& plan) {
  Settle how{plan.last_bits * last_bit(rounded_.state.vertices), 0, plan.moves_input, Passings::none,
             most_facets_};
  report_.rung = plan.moves_input ? Rung::snapped : Rung::coarser;
  constexpr int kPasses = 8, kPassesInVain = 4;
  Attempt now{rounded_.state, trouble_, rounded_.displacement};
  Work work{std::min(work_.left(), kMuchWork.of(now.state.facets.size()))};
  int in_vain = 0;
  for (int pass = 0; pass < kPasses && in_vain < kPassesInVain && !trouble_.none(); ++pass) {
    if (work.is_spent()) break;
    const double moved = settle(now.state, now.trouble, how, work, here());
    grows_ |= now.state.facets.size() > most_facets_;
    if (grows_) break;
    const std::size_t too_much = kTooMuch * (trouble_.size() + 16);
    now.trouble = trouble_of(now.state, here(), threads_, too_much);
    now.displacement = sum_above(now.displacement, moved);
    if (now.trouble.size() < trouble_.size()) {
      stand(now);
      in_vain = 0;
      continue;
    }
    ++in_vain;
    const bool puts_vertices = how.passings == Passings::all;
    if (now.trouble.size() > too_much || (puts_vertices && moved == 0)) break;
    if (puts_vertices && 2 * now.trouble.size() > too_much) break;
    how.passings = Passings::all;
  }
  work_.done += work.done;
}

void Ladder::join_from_best(const Plan& plan) {
  const bool starts_best = best_ && stands_like(*best_);
  const std::size_t done = work_.done;
  join(plan);
  if (is_done()) return;
  if (!best_ || trouble_.size() < best_->trouble.size()) {
    best_ = Attempt{rounded_.state, trouble_, rounded_.displacement};
    return;
  }
  if (grows_) return;
  if (starts_best) {
    work_.done += work_.done - done;  // the same once more would be in vain, and counts
  } else {
    stand(*best_);
    join(plan);
  }
  if (trouble_.size() == best_->trouble.size()) flatten_again(plan);
  if (trouble_.size() < best_->trouble.size())
    best_ = Attempt{rounded_.state, trouble_, rounded_.displacement};
}

bool Ladder::has_twins() const {
  constexpr double kShare = 0.1;  // found: none to 2 %, or 22 % and more
  const double widest = kWeldedPlans.back().last_bits * last_bit(given_.vertices);
  return distance_of_twins(rounded_.state, trouble_, kShare, widest, here()).has_value();
}

void Ladder::join_first() {
  Attempt before{rounded_.state, trouble_, rounded_.displacement};
  const Rung rung = report_.rung;
  join_from_best(kPlans[0]);
  if (trouble_.size() <= kFew) {
    next_plan_ = 1;
    return;
  }
  stand(std::move(before));
  report_.rung = rung;
  best_.reset();
}

RoundPlane Ladder::round_plane() {
  return planes_.rounding([this](State plane, double most) {
    RepairOptions options = options_;
    options.exact = false;
    ExactSurface exact;
    RoundedPlanes none;
    const Parents of_plane;  // needed for the exact surface only
    return Ladder(std::move(plane), options, {}, {exact, of_plane}, none, here(), threads_)
        .run_in_plane(most);
  });
}

void Ladder::flatten_all(State& state, double gap, double& displacement) {
  flatten_all(state, find_clusters(state, gap, {}, here()), gap, displacement);
}

void Ladder::flatten_all(State& state, const Clusters& clusters, double gap, double& displacement) {
  const Flattened flat = repairing::flatten_all(state, clusters, gap, round_plane(), sides_, here());
  has_shared_ |= flat.has_shared;
  displacement = sum_above(displacement, flat.moved);
}

void Ladder::flatten_again(const Plan& plan) {
  constexpr std::size_t kMostInVain = 3;  // found: none in vain before one that helped, or one
  if (is_plane_ || trouble_.facets.empty() || in_vain_ >= kMostInVain) return;
  Attempt flat{rounded_.state, trouble_, rounded_.displacement};
  const RoundPlane round = round_plane();
  constexpr int kPasses = 4;
  for (int pass = 0; pass < kPasses && !flat.trouble.none(); ++pass) {
    const double gap = plan.last_bits * last_bit(flat.state.vertices);
    const Flattened now = flatten(flat.state, gap, round, sides_, here(), flat.trouble.facets);
    has_shared_ |= now.has_shared;
    if (now.moved == 0) return;
    if (pass == 0) ++in_vain_;
    flat.displacement = sum_above(flat.displacement, now.moved);
    flat.trouble = trouble_of(flat.state, here(), threads_, kTooMuch * trouble_.size());
    if (flat.trouble.size() < trouble_.size()) {
      in_vain_ = 0;
      return stand(std::move(flat));
    }
    if (flat.trouble.size() > kTooMuch * trouble_.size()) return;
  }
}

void Ladder::begin_flat(std::span<const Plan> plans) {
  if (is_plane_) return;
  for (const Plan& plan : plans)
    if (!is_done()) begin_flat(plan);
}

void Ladder::begin_flat_late(std::span<const Plan> plans) {
  begin_flat(plans);
  if (best_ && trouble_.size() < best_->trouble.size()) best_.reset();
}

void Ladder::begin_flat(const Plan& plan) {
  const double gap = plan.last_bits * last_bit(given_.vertices);
  Attempt flat{given_, {}, given_displacement_};
  if (plan.moves_input) flat.displacement = sum_above(flat.displacement, weld(flat.state, gap, here()));
  const Clusters clusters = find_clusters(flat.state, gap, {}, here());
  if (!plan.moves_input && !concerns_trouble(clusters.facets)) return;
  flatten_all(flat.state, clusters, gap, flat.displacement);
  if (flat.displacement == given_displacement_) return;
  if (flat.state.facets == flattened_.facets && flat.state.vertices == flattened_.vertices) return;
  flattened_ = flat.state;
  if (!concerns_trouble(changed_facets(given_, flat.state))) return;
  if (proven_.empty()) proven_.begin(rounded_.state);
  Rounded before = std::move(rounded_);
  rounded_ = {false, std::move(flat.state), flat.displacement, false};
  Trouble now;
  const bool is_cut = cut_flat();
  if (is_cut && !rounded_.is_valid) {
    now = trouble_of(rounded_.state, here(), threads_, trouble_.size());
    if (!now.is_all && !trouble_.is_all) {
      trouble_ = trouble_of(before.state, here(), threads_);
      now = trouble_of(rounded_.state, here(), threads_, trouble_.size());
    }
  }
  if (is_cut && now.size() < trouble_.size()) {
    trouble_ = std::move(now);
    report_.rung = plan.moves_input ? Rung::snapped : Rung::coarser;
  } else {
    rounded_ = std::move(before);
  }
}

bool Ladder::concerns_trouble(std::span<const Index> facets) const {
  constexpr std::size_t kShare = 8;
  std::vector<Index> changed, in_trouble, both;
  for (const Index f : facets) add_origins(given_, f, changed);
  for (const Index f : trouble_.facets) add_origins(rounded_.state, f, in_trouble);
  sort_unique(changed);
  sort_unique(in_trouble);
  std::set_intersection(changed.begin(), changed.end(), in_trouble.begin(), in_trouble.end(),
                        std::back_inserter(both));
  return kShare * both.size() >= in_trouble.size();
}

bool Ladder::cut_flat() {
  const auto [first, second] = new_points_;
  const std::size_t far_too_many = 1000 + 4 * first;
  const std::optional<std::size_t> now =
      cut(std::min(options_.most_points, 100 + first + first / 8), nullptr, far_too_many);
  if (!now) return too_many_ > far_too_many;
  const std::size_t most = second == SIZE_MAX ? *now / 4 : std::min(second, *now);
  return rounded_.is_valid || cut(std::min(options_.most_points, 100 + most));
}

bool Ladder::stands_like(const Attempt& attempt) const {
  const State &now = rounded_.state, &then = attempt.state;
  return trouble_.facets == attempt.trouble.facets && trouble_.segments == attempt.trouble.segments &&
         now.known == then.known && now.sheet == then.sheet && are_same(now, then);
}

void Ladder::stand(Attempt attempt) {
  rounded_.state = std::move(attempt.state);
  rounded_.displacement = attempt.displacement;
  trouble_ = std::move(attempt.trouble);
}

arrange::ArrangeOptions Ladder::at_most(std::size_t points) const {
  arrange::ArrangeOptions options;
  options.threads = threads_;
  options.most_points = points;
  if (is_plane_) options.most_pairs = most_pairs_in_plane(rounded_.state.facets.size());
  return options;
}

std::optional<std::size_t> Ladder::cut(std::size_t most_points, State* before, std::size_t counts_to) {
  arrange::Arrangement arrangement;
  proven_.tell(rounded_.state);
  try {
    arrange::ArrangeOptions options = at_most(most_points);
    options.counts_to = counts_to;
    options.keeps_points = report_.rounds == 0 && options_.exact;
    arrangement = arrangement_of(rounded_.state, here(), options);
  } catch (const arrange::TooManyPoints& many) {
    if (report_.rounds == 0 && !is_plane_) throw;
    if (!proven_.empty()) proven_.add(rounded_.state, many.fitted);
    too_many_ = many.count();
    return std::nullopt;
  }
  if (arrangement.is_same) {
    rounded_.is_valid = true;
    if (report_.rounds == 0 && options_.exact)
      exact_.surface = exact_surface(rounded_.state, exact_.of_given);
    return 0;
  }
  if (report_.rounds == 0 && options_.exact) exact_.surface = exact_surface(arrangement, exact_.of_given);
  if (before != nullptr) before->known = arrangement.fitted;
  if (!proven_.empty()) proven_.add(rounded_.state, arrangement.fitted);
  const RoundSizes sizes(arrangement);
  tell_round(report_, sizes);
  rounded_.displacement = sum_above(rounded_.displacement, largest(arrangement.distances));
  rounded_.state = arranged(rounded_.state, std::move(arrangement));
  return sizes.points;
}

void Ladder::cut_if_better() {
  arrange::Arrangement arrangement;
  try {
    const std::size_t most = std::min(options_.most_points, 200 + 4 * trouble_.size());
    arrangement = arrangement_of(rounded_.state, here(), at_most(most));
  } catch (const arrange::TooManyPoints&) {
    return;
  }
  const RoundSizes sizes(arrangement);
  const double displacement = sum_above(rounded_.displacement, largest(arrangement.distances));
  Attempt cut{arranged(rounded_.state, std::move(arrangement)), {}, displacement};
  const std::size_t too_much = 2 * trouble_.size() + 24;
  cut.trouble = trouble_of(cut.state, here(), threads_, too_much);
  if (cut.trouble.size() > too_much) return;
  stand(std::move(cut));
  tell_round(report_, sizes);
}

}  // namespace holdfast::repairing
