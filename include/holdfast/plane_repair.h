// Holdfast: makes segments in the plane valid.
//
// Drawings have segments that cross, overlap, or end on others. These are cut exactly where they meet, as
// repair.h cuts facets. See docs/plane.md.
#pragma once

#include "holdfast/plane.h"
#include "holdfast/repair.h"

namespace holdfast {

struct PlaneRepairReport {
  std::size_t cut_segments = 0;       ///< of the input, which are pieces now
  std::size_t left_out_segments = 0;  ///< that have no length, or lie on others piece by piece
  std::size_t new_points = 0;         ///< where segments cross
  std::size_t joined_points = 0;      ///< that became others of the input, and are left out
  std::size_t moved_points = 0;       ///< that stay, but elsewhere
  /// No point of a segment is further than this from those of the result, nor the other way round. Of planes
  /// in space: as they are seen along their axes. Rounded up.
  double max_displacement = 0;

  [[nodiscard]] bool changes_nothing() const {
    return cut_segments + left_out_segments + new_points + joined_points + moved_points == 0;
  }
};

struct PlaneRepair {
  Outcome outcome = Outcome::done;  ///< or not_representable (no rounding was found), or what Limits say
  /// The points of the input that stay, in order, then new ones. Pieces of a segment carry its marker; those
  /// of several, the first marker that is not 0. Empty unless `outcome` is done.
  Plane plane;
  std::vector<Index> points;   ///< the number in the input of each point that stays
  IndexLists segment_parents;  ///< for each segment, those of the input that it is a part of
  PlaneRepairReport report;
  std::string message;  ///< one sentence when the outcome is not done
};

/// Makes a plane valid, apart from holes and seeds, which stay where they are. Of the options, only `weld`,
/// the limits, threads and progress count: the others are for facets. Points on no segment stay, unless they
/// repeat others; a segment gets such a point only if it lies exactly on it. Points that are not finite, and
/// segments of points that do not exist, stay as well, with all else as it is: `diagnose` names them. Throws
/// as the function in repair.h does.
[[nodiscard]] HOLDFAST_API PlaneRepair repair(const Plane& plane, const RepairOptions& options = {});

struct PlanesRepair {
  Outcome outcome = Outcome::done;
  /// All points of the input with their numbers, then new ones. Empty unless `outcome` is done.
  PlanesInSpace planes;
  PlaneRepairReport report;  ///< of all planes together
  std::string message;
};

/// The same for each plane by itself, as it is seen along its axis. Throws std::invalid_argument for `weld`
/// and several planes, which it would tear apart.
[[nodiscard]] HOLDFAST_API PlanesRepair repair(const PlanesInSpace& planes,
                                               const RepairOptions& options = {});

}  // namespace holdfast
