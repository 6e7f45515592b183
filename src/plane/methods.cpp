// Triangles of points and segments by one of the paper's three methods.
#include "plane/methods.h"

#include "plane/delaunay.h"
#include "plane/ears.h"
#include "plane/faces.h"
#include "plane/hull.h"
#include "plane/lay_segments.h"
#include "plane/order.h"
#include "plane/sensible.h"
#include "plane/sorted.h"
#include "plane/swaps.h"

namespace holdfast::plane {
namespace {

constexpr double kLawson = 0.85;  // share of the work at its end

std::vector<Ends> renumbered(std::span<const Segment> segments, const std::vector<Vertex>& number) {
  std::vector<Ends> ends;
  ends.reserve(segments.size());
  for (const Segment& s : segments) ends.push_back({number[s[0]], number[s[1]]});
  return ends;
}

/// Paper §2.1: the faces between segments and links, each cut into triangles. Returns nullopt if the input is
/// invalid.
std::optional<Draft> make_by_ears(const GivenPoints& points, std::span<const Segment> segments,
                                  const PlaneOptions& options, PlaneReport& report, Stages& stages) {
  Draft draft;
  std::optional<std::vector<Ends>> links = stages.run("sweep", 0.4, [&](const Poll& poll) {
    Sorted sorted(points);
    draft.points = std::move(sorted.points);
    draft.order = std::move(sorted.order);
    draft.segments = renumbered(segments, sorted.number);
    if (options.hull || draft.segments.empty()) add_hull(draft.points, draft.segments);
    return sweep(draft.points, draft.segments, poll);
  });
  if (!links) return std::nullopt;
  report.links = links->size();
  stages.run("ears", 0.75, [&](const Poll& poll) {
    links->insert(links->end(), draft.segments.begin(), draft.segments.end());
    const Walks faces = find_faces(draft.points, *links);
    EarMesh ears = cut_ears(draft.points, faces, links->size(), options.ears, [&](std::size_t f) {
      poll(static_cast<double>(f) / static_cast<double>(faces.count()));
      return true;
    });
    report.ears = ears.counts.ears;
    report.joined = ears.counts.joined;
    draft.mesh = join_faces(std::move(ears), report.links);
  });
  return draft;
}

/// Points are numbered in the order of insertion, so neighbours in the plane are neighbours in memory.
Draft ordered(const GivenPoints& points, std::span<const Segment> segments) {
  Draft draft;
  draft.order = insertion_order(points.positions());
  std::vector<Vertex> number(draft.order.size());
  for (Vertex i = 0; i < draft.order.size(); ++i) number[draft.order[i]] = i;
  draft.points = in_order(points, draft.order);
  draft.segments = renumbered(segments, number);
  return draft;
}

/// Paper §2.2 and §2.3: the Delaunay triangles of all points, with the segments inserted; empty if all points
/// are collinear. Returns nullopt if the input is invalid.
std::optional<Draft> make_by_delaunay(const GivenPoints& points, std::span<const Segment> segments,
                                      const PlaneOptions& options, PlaneResult& result, Stages& stages) {
  Draft draft = stages.run("order", 0.1, [&](const Poll&) { return ordered(points, segments); });
  std::optional<Triangles> mesh =
      stages.run("delaunay", 0.5, [&](const Poll& poll) { return delaunay(draft.points, poll); });
  if (!mesh) return std::nullopt;
  draft.mesh = std::move(*mesh);
  if (draft.mesh.size() == 0 || options.stop_after == PlaneStage::delaunay) return draft;
  const bool laid = stages.run("segments", 0.8,
                               [&](const Poll& poll) { return lay_segments(draft, options, result, poll); });
  if (!laid) return std::nullopt;
  return draft;
}

}  // namespace

std::optional<Draft> triangles_by_method(const GivenPoints& points, std::span<const Segment> segments,
                                         const PlaneOptions& options, PlaneResult& result, Stages& stages) {
  std::optional<Draft> draft = options.method == PlaneMethod::ears
                                   ? make_by_ears(points, segments, options, result.report, stages)
                                   : make_by_delaunay(points, segments, options, result, stages);
  const bool stopped = options.stop_after && options.method != PlaneMethod::ears;
  if (!draft || stopped) return draft;
  // The method by swaps has done this already.
  if ((options.delaunay || refines(options)) && options.method != PlaneMethod::swaps)
    stages.run("lawson", kLawson, [&](const Poll& share) {
      result.report.delaunay_swaps = swap_to_delaunay(draft->mesh, draft->points, share);
    });
  return draft;
}

}  // namespace holdfast::plane
