#include "repair/shared_sides.h"

#include <algorithm>

#include "repair/near.h"

namespace holdfast::repairing {
namespace {

std::vector<Index> from_lower(Index a, Index b, std::span<const Index> chain) {
  std::vector<Index> all(chain.begin(), chain.end());
  if (a > b) std::reverse(all.begin(), all.end());
  return all;
}

}  // namespace

std::span<const Index> SharedSides::known(const Side& side) const {
  const auto found = chains_.find(side);
  return found == chains_.end() ? std::span<const Index>{} : std::span<const Index>(found->second);
}

bool SharedSides::fits(Index a, Index b, std::span<const Index> chain) const {
  const Side side{std::min(a, b), std::max(a, b)};
  return joined(side, known(side), from_lower(a, b, chain)).has_value();
}

void SharedSides::add(Index a, Index b, std::span<const Index> chain) {
  add({std::min(a, b), std::max(a, b)}, from_lower(a, b, chain));
}

/// The position of v in the chain `before`, or else, from `first` on, of the nearest vertex within the gap
/// that is not in the other chain; the size of `before` if there is none.
std::size_t SharedSides::same_as(Index v, std::span<const Index> before, std::size_t first,
                                 std::span<const Index> chain) const {
  const auto itself = std::find(before.begin(), before.end(), v);
  if (itself != before.end()) return static_cast<std::size_t>(itself - before.begin());
  std::size_t same = before.size();
  double least = gap_;
  for (std::size_t k = first; k < before.size(); ++k) {
    if (v < old_ && before[k] < old_) continue;
    const double distance = length(at(v) - at(before[k]));
    if (!(distance <= least) || std::find(chain.begin(), chain.end(), before[k]) != chain.end()) continue;
    same = k;
    least = distance;
  }
  return same;
}

/// Nothing if joining would change the order of the other chain.
std::optional<SharedSides::Joined> SharedSides::joined(const Side& side, std::span<const Index> before,
                                                       std::span<const Index> chain) const {
  Joined joined;
  const Vector along = at(side[1]) - at(side[0]);
  const auto t = [&](Index v) { return dot(at(v) - at(side[0]), along); };
  std::size_t next = 0;  // after the earlier ones
  for (const Index v : chain) {
    const std::size_t same = same_as(v, before, next, chain);
    if (same < before.size()) {
      if (same < next) return std::nullopt;
      for (; next <= same; ++next) joined.all.push_back(before[next]);
      joined.same.push_back({v, before[same]});
      continue;
    }
    for (; next < before.size() && t(before[next]) <= t(v); ++next) joined.all.push_back(before[next]);
    joined.all.push_back(v);
  }
  for (; next < before.size(); ++next) joined.all.push_back(before[next]);
  return joined;
}

void SharedSides::add(const Side& side, std::vector<Index> chain) {
  const auto [found, is_new] = chains_.try_emplace(side, chain);
  if (is_new || found->second == chain) return;
  const std::vector<Index> before = found->second;
  std::optional<Joined> both = joined(side, before, chain);
  if (!both) {
    contradicts_ = true;
    return;
  }
  for (const auto& [v, w] : both->same) unite(v, w, old_);
  found->second = both->all;
  divide(side, before, both->all);
  divide(side, chain, both->all);
}

/// Leads the parts of a chain through the vertices between their ends.
void SharedSides::divide(const Side& side, std::span<const Index> chain, std::span<const Index> all) {
  const std::vector<Index> mine = whole(side, chain), both = whole(side, all);
  std::size_t next = 0;
  for (std::size_t k = 0; k + 1 < mine.size(); ++k) {
    if (next == both.size() || both[next] != mine[k]) {
      contradicts_ = true;
      return;
    }
    std::vector<Index> between;
    for (++next; next < both.size() && both[next] != mine[k + 1]; ++next) between.push_back(both[next]);
    const Side part{std::min(mine[k], mine[k + 1]), std::max(mine[k], mine[k + 1])};
    if (!between.empty() && part != side) add(part, from_lower(mine[k], mine[k + 1], between));
  }
}

/// The chain with its ends; joined vertices are listed once.
std::vector<Index> SharedSides::whole(const Side& side, std::span<const Index> chain) const {
  std::vector<Index> all{root(side[0])};
  for (const Index v : chain) all.push_back(root(v));
  all.push_back(root(side[1]));
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

Index SharedSides::root(Index v) const {
  for (auto found = into_.find(v); found != into_.end(); found = into_.find(v)) v = found->second;
  return v;
}

void SharedSides::unite(Index v, Index w, std::size_t first) {
  v = root(v);
  w = root(w);
  if (v > w) std::swap(v, w);
  if (v == w || w < first) return;
  into_.emplace(w, v);
  most_ = std::max(most_, length(at(v) - at(w)) * (1 + 0x1p-48));
}

bool SharedSides::finish() {
  gap_ = -1;  // joins no more vertices
  const Chains told = std::move(chains_);
  chains_.clear();
  for (const auto& [side, chain] : told) {
    const std::vector<Index> all = whole(side, chain);
    if (all.size() <= 2) continue;
    const Index a = all.front(), b = all.back();
    if (a == b) return false;
    add(a, b, std::span(all).subspan(1, all.size() - 2));
  }
  std::vector<Side> sides;
  for (const auto& [side, chain] : chains_) sides.push_back(side);
  std::map<Side, bool> is_done;
  return !contradicts_ &&
         std::all_of(sides.begin(), sides.end(), [&](const Side& s) { return expand(s, is_done); });
}

/// Inserts into a chain the vertices through which its parts are led. False if a side is a part of itself.
bool SharedSides::expand(const Side& side, std::map<Side, bool>& is_done) {
  const auto found = chains_.find(side);
  if (found == chains_.end()) return true;
  const auto [state, is_new] = is_done.try_emplace(side, false);
  if (!is_new) return state->second;
  const std::vector<Index> all = whole(side, found->second);
  std::vector<Index> expanded;
  for (std::size_t k = 0; k + 1 < all.size(); ++k) {
    if (!expand({std::min(all[k], all[k + 1]), std::max(all[k], all[k + 1])}, is_done)) return false;
    const std::vector<Index> part = chain(all[k], all[k + 1]);
    expanded.insert(expanded.end(), part.begin(), part.end());
    if (k + 2 < all.size()) expanded.push_back(all[k + 1]);
  }
  found->second = std::move(expanded);
  is_done[side] = true;
  return true;
}

std::vector<Index> SharedSides::chain(Index a, Index b) const {
  return from_lower(a, b, known({std::min(a, b), std::max(a, b)}));
}

}  // namespace holdfast::repairing
