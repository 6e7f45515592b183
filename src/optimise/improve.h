// Makes a volume fit to compute with: smoothing, swaps, contractions and a few points, on the worst elements
// until they stop improving (paper §8).
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <span>

#include "holdfast/holdfast.h"
#include "mesh/monitor.h"
#include "optimise/figures.h"
#include "refine/volume_data.h"

namespace holdfast {

/// How far improvement goes.
struct Extent {
  // NOLINTNEXTLINE(google-explicit-constructor)
  Extent(Effort of, bool brief = false) : effort(of), is_brief(brief) {}

  Effort effort;
  /// Where many elements are bad after a pass, most are left: for a result that is compared with another, and
  /// goes on where it is worse.
  bool is_brief;
  /// Of what is brief: points go again until that part of the elements is left, as long as it costs little.
  double least_part = 1;
  /// Of what goes on: facets force so much that the shares of elements with small angles are to become less.
  bool lowers_shares = false;
  /// Points are added as long as there are less than so many elements more, of those there are.
  double most_growth = std::numeric_limits<double>::infinity();
};

struct ImproveStats {
  std::size_t moved = 0, swapped = 0, contracted = 0, inserted = 0;
  std::size_t filled_in = 0;  ///< field points that were missing (improve_parts.h)
  bool filling_stopped_early = false;
  bool was_brief = false;  ///< as it was allowed to be
  double worst = 0;        ///< energy (energy.h): of what is not spared, nothing worse is left

  ImproveStats& operator+=(const ImproveStats& other) {
    moved += other.moved;
    swapped += other.swapped;
    contracted += other.contracted;
    inserted += other.inserted;
    filled_in += other.filled_in;
    filling_stopped_early |= other.filling_stopped_early;
    was_brief |= other.was_brief;
    worst = std::max(worst, other.worst);
    return *this;
  }
};

/// Improves the tetrahedra of the kept regions; all their vertices are explicit. Facets, segments and the
/// vertices below the first free one stand. Regions, sizes and metrics are kept up to date. Tetrahedra at
/// vertices that `spared` marks, by vertex, are left alone unless they are in the way of others. Passes begin
/// with those at vertices that `fresh` marks, or that are higher than it tells of, and go on where something
/// changed.
ImproveStats improve(const VolumeData& volume, Extent extent, Monitor& monitor,
                     std::span<const std::uint8_t> spared = {}, std::span<const std::uint8_t> fresh = {});

/// Goes on with what less effort has left, as far as `extent` goes. Changes keep `figures`, those of the
/// whole that the volume is, or is a part of, if they are given. Progress is told as that part of the stage's
/// work.
ImproveStats improve_further(const VolumeData& volume, Extent extent, const std::optional<Figures>& figures,
                             std::array<double, 2> work, Monitor& monitor,
                             std::span<const std::uint8_t> spared = {},
                             std::span<const std::uint8_t> fresh = {});

}  // namespace holdfast
