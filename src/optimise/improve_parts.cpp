#include "optimise/improve_parts.h"

#include <functional>

#include "optimise/tuning.h"
#include "refine/cut_parts.h"
#include "refine/field_points.h"

namespace holdfast {
namespace {

// With a metric, elements need not be good in Euclidean space.
std::optional<Figures> figures_to_keep(const VolumeData& volume, const Threads& threads) {
  return volume.metrics == nullptr ? std::optional(figures_of(volume, threads)) : std::nullopt;
}

/// The operation applied to a part.
using ImprovePart = std::function<ImproveStats(Part&, Monitor&)>;

ImproveStats improve_each(Parts& parts, const ImprovePart& improve_part, std::array<double, 2> work,
                          const Threads& threads, Monitor& monitor) {
  std::vector<ImproveStats> stats(parts.parts().size());
  parallel_monitored(threads, stats.size(), monitor, work,
                     [&](std::size_t k, Monitor& own) { stats[k] = improve_part(parts.parts()[k], own); });
  ImproveStats sum;
  for (const ImproveStats& own : stats) sum += own;
  return sum;
}

}  // namespace

ImproveStats improve_in_parts(const VolumeData& volume, std::optional<FilledParts> filled, Extent extent,
                              const Threads& threads, Monitor& monitor) {
  constexpr double kMost = tuning::kWorkOfFirstParts;
  std::unique_ptr<Parts> parts;
  if (filled)
    parts = std::move(filled->parts);
  else
    parts = cut_evenly(volume, threads);
  if (!parts) return improve(volume, extent, monitor);
  ImproveStats stats;
  for (std::array<double, 2> work{0, kMost}; parts; work = {kMost, 1}) {
    const auto improve_part = [&](Part& part, Monitor& own) {
      return improve(part.data(parts->whole()), extent, own, part.on_cut(), part.was_on_cut());
    };
    stats += improve_each(*parts, improve_part, work, threads, monitor);
    parts = join_and_cut_again(*parts, threads);
    if (!parts || !filled) continue;
    const FilledIn missing =
        fill_parts(*parts, filled->sizes, Stage::optimise, {kMost, kMost}, threads, monitor);
    stats.filled_in += missing.points;
    stats.filling_stopped_early |= missing.stopped_early;
  }
  return stats;
}

ImproveStats improve_further_in_parts(const VolumeData& volume, Extent extent, std::optional<Figures> figures,
                                      std::array<double, 2> work, const Threads& threads, Monitor& monitor) {
  if (!figures) figures = figures_to_keep(volume, threads);
  std::unique_ptr<Parts> parts = cut_evenly(volume, threads);
  if (!parts) return improve_further(volume, extent, figures, work, monitor);
  ImproveStats stats;
  const double most = work[0] + tuning::kWorkOfFirstParts * (work[1] - work[0]);
  for (std::array<double, 2> now{work[0], most}; parts; now = {most, work[1]}) {
    const auto improve_part = [&](Part& part, Monitor& own) {
      return improve_further(part.data(parts->whole()), extent, figures, {0, 1}, own, part.on_cut(),
                             part.was_on_cut());
    };
    stats += improve_each(*parts, improve_part, now, threads, monitor);
    parts = join_and_cut_again(*parts, threads);
    if (parts) figures = figures_to_keep(volume, threads);
  }
  return stats;
}

}  // namespace holdfast
