// The triangles of the regions that are kept.
#include "plane/kept.h"

namespace holdfast::plane {

Triangles kept_part(const Triangles& mesh, const Regions& regions, const std::vector<bool>& kept) {
  std::vector<std::uint32_t> number(mesh.size(), kNoVertex);
  std::uint32_t count = 0;
  for (std::uint32_t t = 0; t < mesh.size(); ++t)
    if (!mesh.is_ghost(t) && kept[regions.of_triangle[t]]) number[t] = count++;
  Triangles left;
  left.all().reserve(count);
  for (std::uint32_t t = 0; t < mesh.size(); ++t) {
    if (number[t] == kNoVertex) continue;
    Corners corners = mesh[t];
    corners.mark = regions.of_triangle[t];
    for (EdgeCode& across : corners.across) {
      const std::uint32_t other = across == kNoEdge ? kNoVertex : number[triangle_of(across)];
      across = other == kNoVertex ? kNoEdge : code(other, edge_of(across));
    }
    left.all().push_back(corners);
  }
  return left;
}

namespace {

/// If points of the input have no markers, the ends of segments get the marker of their first segment that
/// has one.
void mark_ends(const Plane& plane, PlaneMesh& mesh) {
  if (!plane.point_markers.empty() || plane.segment_markers.empty()) return;
  mesh.point_markers.assign(mesh.points.size(), 0);
  for (std::size_t s = 0; s < plane.segments.size(); ++s)
    for (const Index v : plane.segments[s])
      if (mesh.point_markers[v] == 0) mesh.point_markers[v] = plane.segment_markers[s];
}

}  // namespace

void cut_segments(const Plane& plane, const Refined& refined, PlaneMesh& mesh) {
  mark_ends(plane, mesh);
  std::vector<Segment> pieces;
  std::vector<int> markers;
  auto on = refined.on_segments.begin();
  for (std::size_t s = 0; s < plane.segments.size(); ++s) {
    const int marker = plane.segment_markers.empty() ? 0 : plane.segment_markers[s];
    Index from = plane.segments[s][0];
    const auto add = [&](Index to) {
      pieces.push_back({from, to});
      markers.push_back(marker);
      from = to;
    };
    for (; on != refined.on_segments.end() && on->segment == s; ++on) {
      if (!mesh.point_markers.empty()) mesh.point_markers[on->point] = marker;
      add(on->point);
    }
    add(plane.segments[s][1]);
  }
  mesh.segments = std::move(pieces);
  if (!mesh.segment_markers.empty()) mesh.segment_markers = std::move(markers);
}

}  // namespace holdfast::plane
