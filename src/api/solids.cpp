#include "api/solids.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <numeric>
#include <utility>

#include "numbers/sorted.h"

namespace holdfast {
namespace {

/// The cavities of each component.
class Cavities {
 public:
  Cavities(std::size_t regions, const std::vector<Solid>& solids,
           const std::vector<std::vector<RegionPair>>& walls)
      : solids_(solids), walls_(walls), owner_(solids.size(), kNone), all_(solids.size()) {
    const auto face = [&](Facing way) {
      return std::any_of(solids.begin(), solids.end(), [&](const Solid& s) { return s.facing == way; });
    };
    if (!face(Facing::outwards) || !face(Facing::inwards)) return;
    std::vector<std::size_t> largest_first(solids.size());
    std::iota(largest_first.begin(), largest_first.end(), std::size_t{0});
    std::stable_sort(largest_first.begin(), largest_first.end(), [&](std::size_t a, std::size_t b) {
      return solids[a].regions.size() > solids[b].regions.size();
    });
    kept_by_.resize(regions);
    for (const std::size_t solid : largest_first) {
      if (solids[solid].facing == Facing::mixed) continue;
      find_owner(solid);
      for (const Index r : solids[solid].regions) kept_by_[r].push_back(solid);
    }
  }

  [[nodiscard]] bool is_cavity(std::size_t solid) const { return owner_[solid] != kNone; }
  [[nodiscard]] const std::vector<std::size_t>& of(std::size_t solid) const { return all_[solid]; }

 private:
  static constexpr std::size_t kNone = SIZE_MAX;

  /// Components that keep more have been entered in `kept_by_`, the one that keeps the least last.
  void find_owner(std::size_t inner) {
    const std::vector<RegionPair>& walls = walls_[inner];
    const std::vector<std::size_t>& at_wall = kept_by_[walls[0].front];
    const auto round = std::find_if(at_wall.rbegin(), at_wall.rend(), [&](std::size_t outer) {
      return std::all_of(walls.begin(), walls.end(), [&](const RegionPair& wall) {
        return has(outer, wall.front) && has(outer, wall.back);
      });
    });
    if (round == at_wall.rend()) return;
    if (solids_[*round].facing == solids_[inner].facing || is_cavity(*round)) return;
    owner_[inner] = *round;
    all_[*round].push_back(inner);
  }

  [[nodiscard]] bool has(std::size_t solid, Index region) const {
    return std::binary_search(solids_[solid].regions.begin(), solids_[solid].regions.end(), region);
  }

  const std::vector<Solid>& solids_;
  const std::vector<std::vector<RegionPair>>& walls_;
  std::vector<std::size_t> owner_;
  std::vector<std::vector<std::size_t>> all_;
  std::vector<std::vector<std::size_t>> kept_by_;  // by region
};

}  // namespace

Solid solid_of(const std::vector<RegionPair>& walls, const UndoableSets& sets) {
  std::map<Index, std::vector<std::pair<Index, int>>> steps;
  for (const RegionPair& wall : walls) {
    const Index front = sets.root(wall.front), back = sets.root(wall.back);
    if (front == back) continue;
    steps[front].emplace_back(back, 1);  // the inside is behind a facet that faces outwards
    steps[back].emplace_back(front, -1);
  }
  const Index outside = sets.root(0);
  std::map<Index, int> winding{{outside, 0}};
  bool is_consistent = true, is_inside = false, is_outside = false;
  std::vector<Index> open{outside};
  while (!open.empty()) {
    const Index region = open.back();
    open.pop_back();
    for (const auto& [next, step] : steps[region]) {
      const int expected = winding.at(region) + step;
      const auto [at, is_new] = winding.try_emplace(next, expected);
      is_consistent &= at->second == expected;
      if (!is_new) continue;
      is_inside |= expected > 0;
      is_outside |= expected < 0;
      open.push_back(next);
    }
  }
  Solid solid;
  for (const auto& [region, times] : winding)
    if (is_consistent ? times != 0 : region != outside)
      sets.for_each_member(region, [&](Index r) { solid.regions.push_back(r); });
  std::sort(solid.regions.begin(), solid.regions.end());
  if (is_consistent && is_inside != is_outside) solid.facing = is_inside ? Facing::outwards : Facing::inwards;
  return solid;
}

std::vector<std::uint8_t> material_of(std::size_t regions, const std::vector<Solid>& solids,
                                      const std::vector<std::vector<RegionPair>>& walls) {
  const Cavities cavities(regions, solids, walls);
  std::vector<std::uint8_t> material(regions, 0);
  for (std::size_t c = 0; c < solids.size(); ++c) {
    if (cavities.is_cavity(c)) continue;
    std::vector<Index> empty, full;
    for (const std::size_t cavity : cavities.of(c))
      empty.insert(empty.end(), solids[cavity].regions.begin(), solids[cavity].regions.end());
    sort_unique(empty);
    std::set_difference(solids[c].regions.begin(), solids[c].regions.end(), empty.begin(), empty.end(),
                        std::back_inserter(full));
    for (const Index r : full) material[r] = 1;
  }
  return material;
}

}  // namespace holdfast
