#include "check_repair/slits.h"

#include <array>
#include <cstddef>
#include <limits>
#include <utility>

namespace holdfast::checking {

void Slits::close_gaps() {
  constexpr std::size_t kMost = 16;
  for (const auto& [tip, ends] : neighbours_of(odd_)) {
    if (ends.size() > kMost) continue;
    for (std::size_t i = 0; i < ends.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (odd_.contains(edge_of(tip, ends[i])) && odd_.contains(edge_of(tip, ends[j])))
          close_gap({tip, ends[i], ends[j]});
  }
}

/// The first corner of `t` is its tip.
void Slits::close_gap(const Triangle& t) {
  const std::optional<Reach> left = near_.reach_without(near_.width(t[1], t[2]) / 2);
  if (!left || !near_.has_within(*left, t)) return;
  const unsigned sides = near_.sides_of(*left, t[1], t[2]);
  if (sides == 0) return;
  flip(odd_, t);
  ends_[edge_of(t[1], t[2])] = sides;
}

void Slits::close() {
  renew();
  const Neighbours tips = neighbours_;
  for (const auto& [tip, unused] : tips)
    if (near_.sides_of(tip) == 0 && close_from(tip)) renew();
  constexpr int kMost = 16;
  for (int k = 0; k < kMost && close_from_side(); ++k) renew();
}

/// The next vertex, if there is only one.
Index Slits::next_on(const Bank& bank) const {
  const auto at = neighbours_.find(bank.at);
  if (at == neighbours_.end() || at->second.size() != 2) return no_entity;
  return at->second[at->second[0] == bank.before ? 1 : 0];
}

/// From the far end, where both banks begin, to where they reach one side.
bool Slits::close_from(Index tip) {
  const auto at = neighbours_.find(tip);
  if (at == neighbours_.end() || at->second.size() != 2) return false;
  const Index a = at->second[0], b = at->second[1];
  const Triangle first{tip, a, b};
  return close_between(Banks{{{a, tip, no_entity}, {b, tip, no_entity}}}, {first},
                       reach_beside(edge_of(tip, a), edge_of(tip, b), first));
}

/// Closes one slit.
bool Slits::close_from_side() {
  constexpr std::size_t kMost = 16;
  const std::vector<Bank> banks = banks_at_sides();
  if (banks.size() > kMost) return false;
  for (std::size_t i = 0; i < banks.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (close_between(banks[i], banks[j])) return true;
  return false;
}

/// Where the odd edges leave a side, away from it.
std::vector<Slits::Bank> Slits::banks_at_sides() {
  std::vector<Bank> banks;
  for (const auto& [v, ends] : neighbours_) {
    const unsigned sides = near_.sides_of(v);
    if (sides == 0 || ends.size() != 2) continue;
    const std::array<bool, 2> stays{(sides & near_.sides_of(ends[0])) != 0,
                                    (sides & near_.sides_of(ends[1])) != 0};
    if (stays[0] != stays[1]) banks.push_back({v, ends[stays[0] ? 0 : 1], v});
  }
  return banks;
}

/// From where both banks leave a side to where they meet or reach another one.
bool Slits::close_between(const Bank& a, const Bank& b) {
  if (a.at == b.at || (near_.sides_of(a.at) & near_.sides_of(b.at)) == 0) return false;
  Banks banks{a, b};
  std::vector<Triangle> between;
  const std::optional<Reach> left = go_on(banks, between);
  const unsigned sides = left ? near_.sides_of(*left, a.at, b.at) : 0;
  if (sides == 0 || !close_between(banks, std::move(between), left)) return false;
  ends_[edge_of(a.at, b.at)] = sides;
  return true;
}

bool Slits::close_between(Banks banks, std::vector<Triangle> between, std::optional<Reach> left) {
  constexpr std::size_t kMost = 64;
  while (left && between.size() < kMost) {
    const Segment across = edge_of(banks[0].at, banks[1].at);
    const unsigned sides = near_.sides_of(*left, across[0], across[1]);
    if (sides != 0 || odd_.contains(across)) {
      for (const Triangle& t : between) flip(odd_, t);
      if (sides != 0) ends_[across] = sides;
      return true;
    }
    left = go_on(banks, between);
  }
  return false;
}

/// One step on the bank where the step leads less far from the other bank; returns what remains of the
/// distance.
std::optional<Reach> Slits::go_on(Banks& banks, std::vector<Triangle>& between) {
  std::optional<Reach> left;
  double least = std::numeric_limits<double>::infinity();
  std::size_t best = 0;
  for (std::size_t i = 0; i < 2; ++i) {
    const Bank &bank = banks[i], &other = banks[1 - i];
    const Index next = next_on(bank);
    if (next == no_entity || next == other.at) continue;
    if (bank.at != bank.start && near_.sides_of(bank.at) != 0) continue;
    const double width = near_.width(next, other.at);
    if (width >= least) continue;
    const std::optional<Reach> now =
        reach_beside(edge_of(bank.at, next), edge_of(other.before, other.at), {bank.at, next, other.at});
    if (!now) continue;
    left.emplace(*now);
    least = width;
    best = i;
  }
  if (!left) return left;
  Bank& bank = banks[best];
  const Index next = next_on(bank);
  between.push_back({bank.at, next, banks[1 - best].at});
  bank = {next, bank.at, bank.start};
  return left;
}

std::optional<Reach> Slits::reach_beside(const Segment& a, const Segment& b, const Triangle& corners) const {
  // Only edges of the output count.
  if (ends_.contains(a) && ends_.contains(b)) return std::nullopt;
  if (ends_.contains(a)) return near_.reach_beside({b}, corners);
  if (ends_.contains(b)) return near_.reach_beside({a}, corners);
  return near_.reach_beside({a, b}, corners);
}

}  // namespace holdfast::checking
