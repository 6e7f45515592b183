#include "optimise/improve_parts.h"

#include "optimise/tuning.h"
#include "refine/cut_parts.h"
#include "refine/field_points.h"

namespace holdfast {
namespace {

ImproveStats improve_each(Parts& parts, Effort effort, std::array<double, 2> work, const Threads& threads,
                          Monitor& monitor) {
  std::vector<ImproveStats> stats(parts.parts().size());
  parallel_monitored(threads, stats.size(), monitor, work, [&](std::size_t k, Monitor& own) {
    Part& part = parts.parts()[k];
    stats[k] = improve(part.data(parts.whole()), effort, own, part.on_cut(), part.was_on_cut());
  });
  ImproveStats sum;
  for (const ImproveStats& own : stats) sum += own;
  return sum;
}

}  // namespace

ImproveStats improve_in_parts(const VolumeData& volume, std::optional<FilledParts> filled, Effort effort,
                              const Threads& threads, Monitor& monitor) {
  constexpr double kMost = tuning::kWorkOfFirstParts;
  std::unique_ptr<Parts> parts;
  if (filled)
    parts = std::move(filled->parts);
  else
    parts = cut_evenly(volume, threads);
  if (!parts) return improve(volume, effort, monitor);
  ImproveStats stats;
  for (std::array<double, 2> work{0, kMost}; parts; work = {kMost, 1}) {
    stats += improve_each(*parts, effort, work, threads, monitor);
    parts = join_and_cut_again(*parts, threads);
    if (!parts || !filled) continue;
    const FilledIn missing =
        fill_parts(*parts, filled->sizes, Stage::optimise, {kMost, kMost}, threads, monitor);
    stats.filled_in += missing.points;
    stats.filling_stopped_early |= missing.stopped_early;
  }
  return stats;
}

}  // namespace holdfast
