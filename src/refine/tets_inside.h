// Lists of tetrahedra, made on threads.
#pragma once

#include <map>
#include <mutex>
#include <vector>

#include "mesh/parallel.h"
#include "refine/volume_data.h"

namespace holdfast {

/// The tetrahedra of the kept regions that are wanted, in ascending order.
template <typename IsWanted>
[[nodiscard]] std::vector<Tet> tets_inside(const VolumeData& volume, const Threads& threads,
                                           IsWanted&& is_wanted) {
  std::mutex mutex;
  std::map<std::size_t, std::vector<Tet>> ranges;
  parallel_ranges(threads, volume.mesh.slot_count(), [&](std::size_t first, std::size_t last) {
    std::vector<Tet> own;
    for (auto t = static_cast<Tet>(first); t < last; ++t)
      if (volume.is_inside(t) && is_wanted(t)) own.push_back(t);
    const std::scoped_lock lock(mutex);
    ranges[first] = std::move(own);
  });
  std::vector<Tet> tets = std::move(ranges.begin()->second);
  ranges.erase(ranges.begin());
  for (const auto& [first, own] : ranges) tets.insert(tets.end(), own.begin(), own.end());
  return tets;
}
[[nodiscard]] inline std::vector<Tet> tets_inside(const VolumeData& volume, const Threads& threads) {
  return tets_inside(volume, threads, [](Tet) { return true; });
}

}  // namespace holdfast
