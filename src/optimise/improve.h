// Makes a volume fit to compute with: smoothing, swaps, contractions and a few points, on the worst elements
// until they stop improving (paper §6.4).
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <span>

#include "holdfast/holdfast.h"
#include "mesh/monitor.h"
#include "optimise/figures.h"
#include "optimise/tuning.h"
#include "refine/volume_data.h"

namespace holdfast {

/// How far improvement goes.
struct Extent {
  // NOLINTNEXTLINE(google-explicit-constructor)
  Extent(Effort of, bool brief = false) : effort(of), is_brief(brief) {}

  Effort effort;
  /// If many elements are bad after a pass, most are left as they are: for a result that is compared with
  /// another, and is improved further if it is worse.
  bool is_brief;
  /// Points are removed until this part of the elements is left, as long as that costs little: at most so
  /// much for each removed element (kWeightBelow).
  double least_part = 1, most_cost = tuning::kBrief.most_cost;
  /// If not brief: points are removed only if more than this part of the elements is bad.
  double part_of_bad = 1;
  /// For further improvement: facets force so many small angles that the shares of elements with small angles
  /// are to be reduced.
  bool lowers_shares = false;
  /// Points are added only while the number of new elements is below this part of the present ones.
  double most_growth = std::numeric_limits<double>::infinity();
};

struct ImproveStats {
  std::size_t moved = 0, swapped = 0, contracted = 0, inserted = 0;
  std::size_t filled_in = 0;  ///< field points that were missing (improve_parts.h)
  bool filling_stopped_early = false;
  bool was_brief = false;    ///< whether it was brief, as `is_brief` allows
  bool was_thinned = false;  ///< whether it was not brief, and points were removed in the end
  double worst = 0;          ///< the worst energy (energy.h) of elements that are not spared

  ImproveStats& operator+=(const ImproveStats& other) {
    moved += other.moved;
    swapped += other.swapped;
    contracted += other.contracted;
    inserted += other.inserted;
    filled_in += other.filled_in;
    filling_stopped_early |= other.filling_stopped_early;
    was_brief |= other.was_brief;
    was_thinned |= other.was_thinned;
    worst = std::max(worst, other.worst);
    return *this;
  }
};

/// Improves the tetrahedra of the kept regions; all their vertices are explicit. Facets, segments and the
/// vertices below the first free one are unchanged. Regions, sizes and metrics are kept up to date.
/// Tetrahedra at vertices that `spared` marks, by vertex, are left alone unless they are in the way of
/// others. Passes begin with the tetrahedra at vertices that `fresh` marks, or whose number is beyond its
/// end, and continue where something changed.
ImproveStats improve(const VolumeData& volume, Extent extent, Monitor& monitor,
                     std::span<const std::uint8_t> spared = {}, std::span<const std::uint8_t> fresh = {});

/// Continues what less effort has left, as far as `extent` allows. If `figures` is given, changes keep these
/// figures, which are those of the whole volume even if this is a part of it. Progress is reported as this
/// part of the stage's work.
ImproveStats improve_further(const VolumeData& volume, Extent extent, const std::optional<Figures>& figures,
                             std::array<double, 2> work, Monitor& monitor,
                             std::span<const std::uint8_t> spared = {},
                             std::span<const std::uint8_t> fresh = {});

}  // namespace holdfast
