#include "optimise/thin_out.h"

#include <algorithm>
#include <bit>
#include <limits>

#include "optimise/tuning.h"

namespace holdfast {
namespace {

// The logarithm to base 2, linear between powers of 2, so that it has the same bits everywhere: a double is
// its exponent plus its fraction.
double rough_log2(double x) {
  constexpr double kFractions = 0x1p52, kBias = 1023;
  return static_cast<double>(std::bit_cast<std::int64_t>(x)) / kFractions - kBias;
}

}  // namespace

double Thinner::tets_where_left(double part) const {
  const TetMesh& mesh = volume_.mesh();
  std::size_t tets = 0;
  for (Tet t = 0; t < mesh.slot_count(); ++t) {
    const TetMesh::Corners& c = mesh.corners(t);
    if (volume_.is_inside(t) &&
        (fresh_.empty() || std::any_of(c.begin(), c.end(), [&](Vertex v) { return may_go(v); })))
      ++tets;
  }
  return static_cast<double>(mesh.tet_count()) - (1 - part) * static_cast<double>(tets);
}

std::size_t Thinner::run(double least_tets, double most_cost) {
  TetMesh& mesh = volume_.mesh();
  const auto is_to_go_on = [&] { return static_cast<double>(mesh.tet_count()) > least_tets; };
  small_.emplace(volume_);
  queue_ = {};
  is_queued_.assign(mesh.vertex_count(), 0);
  if (is_to_go_on())
    for (Vertex v = volume_.first_free(); v < mesh.vertex_count(); ++v)
      if (mesh.in_mesh(v)) push(v, most_cost);
  std::size_t gone = 0;
  while (!queue_.empty() && is_to_go_on()) {
    const Entry next = queue_.top();
    queue_.pop();
    is_queued_[next.v] = 0;
    if (!mesh.in_mesh(next.v)) continue;
    poll_();
    // Removed neighbours may have raised its cost since.
    const double cost = cost_of(next.v, most_cost);
    if (!contraction_.has_choice()) continue;
    if (cost > next.cost && !queue_.empty() && cost > queue_.top().cost) {
      queue_.push({cost, next.v});
      is_queued_[next.v] = 1;
      continue;
    }
    if (!contraction_.is_allowed()) continue;
    link_.assign(contraction_.link().begin(), contraction_.link().end());
    contraction_.make();
    ++gone;
    for (const Vertex w : link_) push(w, most_cost);
  }
  return gone;
}

void Thinner::push(Vertex v, double most_cost) {
  if (!may_go(v) || is_queued_[v] != 0 || volume_.in_vain().has(v, InVain::AtVertex::going)) return;
  poll_();
  const double cost = cost_of(v, most_cost);
  if (!contraction_.has_choice()) {
    volume_.in_vain().add(v, InVain::AtVertex::going);
    return;
  }
  queue_.push({cost, v});
  is_queued_[v] = 1;
}

// The least cost; if it is at most `most`, its contraction is chosen.
double Thinner::cost_of(Vertex v, double most) {
  if (!contraction_.turn_to(v)) return most;
  const std::span<const Tet> ball = contraction_.ball();
  double before = 0, worst = volume_.energy_of_sine(tuning::kSineNotToFallBelow);
  for (const Tet t : ball) {
    before += burden_of(volume_.energy(t));
    worst = std::max(worst, volume_.energy(t));
  }
  const double longest = longest_at(v, ball.front());
  double best = most;
  for (const Vertex w : contraction_.link()) {
    const auto gone = static_cast<double>(ball.size() - contraction_.with(w).size());
    if (!contraction_.is_within(longest, w)) continue;
    const double limit = before + best * gone;
    const double after = burden_of_listed(worst, limit);
    if (!(after < limit) || !contraction_.is_valid()) continue;
    best = (after - before) / gone;
    contraction_.choose();
  }
  return best;
}

// The longest edge allowed beside v, a corner of t, where a limit on sizes holds. Facets may want larger
// sizes, and edges that are already longer may be replaced by others.
double Thinner::longest_at(Vertex v, Tet t) const {
  const double limit = volume_.most_size(t);
  if (limit == std::numeric_limits<double>::infinity()) return limit;
  return std::max(tuning::kLongestThinned * std::max(limit, volume_.size(v)), contraction_.longest());
}

// The burden of the listed elements; at least `limit` if it is not less, or if an element is worse than
// `worst`.
double Thinner::burden_of_listed(double worst, double limit) const {
  const std::span<const TetMesh::Corners> tets = contraction_.listed();
  double sum = 0;
  for (std::size_t k = 0; k < tets.size() && sum < limit; k += 4) {
    const std::size_t count = std::min<std::size_t>(4, tets.size() - k);
    const std::array<double, 4> energies = volume_.energies_of(tets.subspan(k, count));
    for (std::size_t i = 0; i < count; ++i) {
      if (!(energies[i] < worst)) return limit;
      sum += burden_of(energies[i]);
    }
  }
  return sum;
}

// Energies decide between contractions of equal weight.
double Thinner::burden_of(double energy) const {
  constexpr double kMostEnergy = 1e30;  // so that an infinite energy has a logarithm
  return small_->weight(energy) + tuning::kWeightOfTwiceTheEnergy * rough_log2(std::min(energy, kMostEnergy));
}

}  // namespace holdfast
