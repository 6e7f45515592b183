// The repair of segments in the plane: that of surfaces, at z = 0.
#include "holdfast/plane_repair.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>

#include "numbers/sorted.h"
#include "plane/lift.h"

namespace holdfast {
namespace {

constexpr Index kGone = no_entity;

bool can_be_cut(const Plane& plane) {
  const auto is_there = [&](const Segment& s) {
    return s[0] < plane.points.size() && s[1] < plane.points.size();
  };
  return std::all_of(plane.points.begin(), plane.points.end(),
                     [](const PlanePoint& p) { return std::isfinite(p[0]) && std::isfinite(p[1]); }) &&
         std::all_of(plane.segments.begin(), plane.segments.end(), is_there);
}

/// The repair of the segments at z = 0.
RepairResult cut(const Plane& plane, const RepairOptions& options) {
  Surface flat;
  for (const PlanePoint& p : plane.points) flat.vertices.push_back({p[0], p[1], 0});
  flat.segments = plane.segments;
  RepairOptions of_segments;
  static_cast<Limits&>(of_segments) = options;
  of_segments.weld = options.weld;
  of_segments.most_points = options.most_points;
  of_segments.threads = options.threads;
  of_segments.progress = options.progress;
  return repair(flat.view(), of_segments);
}

std::vector<bool> ends_of(std::span<const Segment> segments, std::size_t points) {
  std::vector<bool> ends(points, false);
  for (const Segment& s : segments) ends[s[0]] = ends[s[1]] = true;
  return ends;
}

class Cutter {
 public:
  Cutter(const Plane& given, const RepairResult& cut) : given_(given), cut_(cut) {}

  PlaneRepair repaired() {
    choose_points();
    put_points();
    put_segments();
    count();
    result_.plane.holes = given_.holes;
    result_.plane.regions = given_.regions;
    result_.plane.base = given_.base;
    result_.plane.remarks = given_.remarks;
    result_.plane.names = given_.names;
    return std::move(result_);
  }

 private:
  [[nodiscard]] PlanePoint place(std::size_t v) const {
    const Point& p = cut_.surface.vertices[v];
    return {p[0], p[1]};
  }

  // A point that was the end of a segment and is none any more has become another. Of points at one place, an
  // end stays, or the first.
  void choose_points() {
    const std::size_t count = cut_.surface.vertices.size(), given = given_.points.size();
    const std::vector<bool> was_end = ends_of(given_.segments, count),
                            is_end = ends_of(cut_.surface.segments, count);
    std::map<PlanePoint, Index> at;
    for (Index v = 0; v < count; ++v)
      if (is_end[v]) at.emplace(place(v), v);
    for (Index v = 0; v < given; ++v)
      if (!was_end[v] && !is_end[v]) at.emplace(place(v), v);
    number_.assign(count, kGone);
    Index next = 0;
    for (Index v = 0; v < count; ++v) {
      const bool stays = is_end[v] || (v < given && !was_end[v] && at.at(place(v)) == v);
      if (stays) number_[v] = next++;
      if (v < given && !stays) ++result_.report.joined_points;
    }
  }

  void put_points() {
    const std::size_t given = given_.points.size();
    for (Index v = 0; v < number_.size(); ++v) {
      if (number_[v] == kGone) continue;
      result_.plane.points.push_back(place(v));
      if (v < given)
        result_.points.push_back(v);
      else
        ++result_.report.new_points;
    }
    if (given_.point_markers.empty()) return;
    for (const Index v : result_.points) result_.plane.point_markers.push_back(given_.point_markers[v]);
    result_.plane.point_markers.resize(result_.plane.points.size(), 0);
  }

  // Segments that are led through the same points have become the same piece.
  void put_segments() {
    std::map<std::array<Index, 2>, std::size_t> at;
    std::vector<std::vector<Index>> parents;
    for (std::size_t s = 0; s < cut_.surface.segments.size(); ++s) {
      const Segment& piece = cut_.surface.segments[s];
      const Index a = number_[piece[0]], b = number_[piece[1]];
      const auto [found, is_new] = at.emplace(std::array{std::min(a, b), std::max(a, b)}, parents.size());
      if (is_new) {
        result_.plane.segments.push_back({a, b});
        parents.emplace_back();
      }
      const std::span<const Index> more = cut_.segment_parents[s];
      std::vector<Index>& all = parents[found->second];
      all.insert(all.end(), more.begin(), more.end());
    }
    for (std::vector<Index>& all : parents) {
      sort_unique(all);
      result_.segment_parents.all.insert(result_.segment_parents.all.end(), all.begin(), all.end());
      result_.segment_parents.first.push_back(result_.segment_parents.all.size());
      if (!given_.segment_markers.empty()) result_.plane.segment_markers.push_back(marker_of(all));
    }
  }
  [[nodiscard]] int marker_of(std::span<const Index> parents) const {
    for (const Index p : parents)
      if (given_.segment_markers[p] != 0) return given_.segment_markers[p];
    return 0;
  }

  void count() {
    // Of an overlap, the first parent counts as the one that is there.
    std::vector<std::size_t> pieces(given_.segments.size(), 0), own(given_.segments.size(), 0);
    for (std::size_t s = 0; s < result_.segment_parents.size(); ++s) {
      const std::span<const Index> parents = result_.segment_parents[s];
      for (const Index p : parents) ++pieces[p];
      ++own[parents[0]];
    }
    PlaneRepairReport& report = result_.report;
    report.cut_segments = static_cast<std::size_t>(
        std::count_if(pieces.begin(), pieces.end(), [](std::size_t n) { return n > 1; }));
    report.left_out_segments = static_cast<std::size_t>(std::count(own.begin(), own.end(), 0u));
    report.moved_points = static_cast<std::size_t>(
        std::count_if(cut_.moved.begin(), cut_.moved.end(),
                      [&](const RepairResult::Moved& moved) { return number_[moved.vertex] != kGone; }));
    report.max_displacement = cut_.max_displacement;
  }

  const Plane& given_;
  const RepairResult& cut_;
  std::vector<Index> number_;  // in the result
  PlaneRepair result_;
};

PlaneRepair unchanged(const Plane& plane) {
  PlaneRepair result;
  result.plane = plane;
  for (Index v = 0; v < plane.points.size(); ++v) result.points.push_back(v);
  for (Index s = 0; s < plane.segments.size(); ++s) {
    result.segment_parents.all.push_back(s);
    result.segment_parents.first.push_back(result.segment_parents.all.size());
  }
  return result;
}

void add(PlaneRepairReport& sum, const PlaneRepairReport& part) {
  for (const auto member :
       {&PlaneRepairReport::cut_segments, &PlaneRepairReport::left_out_segments,
        &PlaneRepairReport::new_points, &PlaneRepairReport::joined_points, &PlaneRepairReport::moved_points})
    sum.*member += part.*member;
  sum.max_displacement = std::max(sum.max_displacement, part.max_displacement);
}

/// Puts points that moved, and new ones, into space: on the first segment that they cut, or on the mean
/// plane.
void put_in_space(const PlanesInSpace& given, const PlanesInSpace::Part& before, const PlaneRepair& repaired,
                  PlanesInSpace& planes, PlanesInSpace::Part& after) {
  const plane::Lift lift(given, before);
  after.numbers.clear();
  for (std::size_t k = 0; k < repaired.points.size(); ++k) {
    const Index v = repaired.points[k];
    after.numbers.push_back(before.numbers[v]);
    if (repaired.plane.points[k] != before.plane.points[v])
      planes.points[before.numbers[v]] = lift(repaired.plane.points[k]);
  }
  std::vector<Index> cuts(repaired.plane.points.size(), kGone);
  for (std::size_t s = 0; s < repaired.plane.segments.size(); ++s)
    for (const Index v : repaired.plane.segments[s])
      if (cuts[v] == kGone) cuts[v] = repaired.segment_parents[s][0];
  for (std::size_t k = repaired.points.size(); k < repaired.plane.points.size(); ++k) {
    const auto [a, b] = before.plane.segments[cuts[k]];
    after.numbers.push_back(static_cast<Index>(planes.points.size()));
    planes.points.push_back(lift.on_segment(repaired.plane.points[k], a, b));
  }
}

}  // namespace

PlaneRepair repair(const Plane& plane, const RepairOptions& options) {
  if (!can_be_cut(plane)) return unchanged(plane);
  const RepairResult result = cut(plane, options);
  if (result.outcome == Outcome::done) return Cutter(plane, result).repaired();
  PlaneRepair ended;
  ended.outcome = result.outcome;
  ended.message = result.message;
  return ended;
}

PlanesRepair repair(const PlanesInSpace& planes, const RepairOptions& options) {
  if (options.weld > 0 && planes.parts.size() > 1)
    throw std::invalid_argument(
        "points of several planes cannot be joined within a distance: each plane is repaired by itself, and "
        "would come apart from the others");
  PlanesRepair result;
  result.planes = planes;
  for (PlanesInSpace::Part& part : result.planes.parts) {
    const PlanesInSpace::Part before = part;
    PlaneRepair repaired = repair(before.plane, options);
    if (repaired.outcome != Outcome::done) {
      result.planes = {};
      result.outcome = repaired.outcome;
      result.message = repaired.message;
      return result;
    }
    if (!planes.points.empty()) put_in_space(planes, before, repaired, result.planes, part);
    add(result.report, repaired.report);
    part.plane = std::move(repaired.plane);
  }
  return result;
}

}  // namespace holdfast
