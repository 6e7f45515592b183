#include "plane/chosen.h"

#include <algorithm>

namespace holdfast::plane {
namespace {

// Kept regions without a seed get the numbers from 1 on that no seed has.
void number_regions(const Plane& plane, Chosen& chosen) {
  std::vector<int> taken;
  for (const Plane::Seed& seed : plane.regions) taken.push_back(seed.id);
  std::sort(taken.begin(), taken.end());
  int next = 1;
  for (std::size_t region = 1; region < chosen.ids.size(); ++region) {
    if (!chosen.kept[region] || chosen.ids[region] != 0) continue;
    while (std::binary_search(taken.begin(), taken.end(), next)) ++next;
    chosen.ids[region] = next++;
  }
}

std::vector<Index> numbers_of(const std::vector<bool>& marks) {
  std::vector<Index> numbers;
  for (Index i = 0; i < marks.size(); ++i)
    if (marks[i]) numbers.push_back(i);
  return numbers;
}

}  // namespace

std::size_t Chosen::count() const {
  return static_cast<std::size_t>(std::count(kept.begin() + 1, kept.end(), true));
}

Chosen choose_regions(Draft& draft, const Plane& plane, PlaneMethod method) {
  Chosen chosen;
  chosen.regions = find_regions(draft.mesh);
  const std::size_t count = chosen.regions.count + std::size_t{1};
  chosen.ids.assign(count, 0);
  chosen.kept.assign(count, true);
  chosen.areas.assign(count, 0);
  chosen.kept[kOutside] = false;
  const auto locate = [&](const std::vector<Position>& places, auto&& use) {
    const std::vector<Found> found = find_triangles(draft.mesh, draft.points, places);
    for (std::size_t i = 0; i < found.size(); ++i) {
      // Ears leave out segments that bound nothing.
      if (found[i].on_constraint || (method == PlaneMethod::ears && found[i].triangle == kNoVertex))
        chosen.on_constraint = true;
      if (found[i].triangle != kNoVertex && !found[i].on_constraint)
        use(i, chosen.regions.of_triangle[found[i].triangle]);
    }
  };
  std::vector<bool> is_idle(plane.holes.size(), true);
  locate(plane.holes, [&](std::size_t i, std::uint32_t region) {
    chosen.kept[region] = false;
    if (region != kOutside) is_idle[i] = false;
  });
  chosen.idle_holes = numbers_of(is_idle);
  std::vector<Position> seeds;
  for (const Plane::Seed& seed : plane.regions) seeds.push_back(seed.where);
  std::vector<Index> last(count, no_entity);
  locate(seeds, [&](std::size_t i, std::uint32_t region) {
    chosen.ids[region] = plane.regions[i].id;
    chosen.areas[region] = plane.regions[i].area;
    last[region] = static_cast<Index>(i);
  });
  is_idle.assign(seeds.size(), true);
  for (std::size_t region = 0; region < count; ++region)
    if (chosen.kept[region] && last[region] != no_entity) is_idle[last[region]] = false;
  chosen.idle_seeds = numbers_of(is_idle);
  number_regions(plane, chosen);
  return chosen;
}

}  // namespace holdfast::plane
