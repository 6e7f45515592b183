#include "io/two_dimensions.h"

#include <algorithm>
#include <cmath>

#include "numbers/sorted.h"

namespace holdfast::io {
namespace {

/// The edges of exactly one triangle, ascending.
std::vector<Segment> boundary_of(const std::vector<Triangle>& triangles) {
  std::vector<Segment> edges;
  edges.reserve(3 * triangles.size());
  for (const Triangle& t : triangles)
    for (std::size_t k = 0; k < 3; ++k) edges.push_back(ascending(Segment{t[k], t[(k + 1) % 3]}));
  std::sort(edges.begin(), edges.end());
  std::vector<Segment> once;
  for (auto first = edges.begin(); first != edges.end();) {
    const auto last = std::upper_bound(first, edges.end(), *first);
    if (last - first == 1) once.push_back(*first);
    first = last;
  }
  return once;
}

}  // namespace

bool is_in_plane(const Volume& volume) {
  // Two dimensions would lose the sign of -0.
  const auto is_flat = [](const Point& p) { return p[2] == 0 && !std::signbit(p[2]); };
  return has_cells_of_triangles(volume) && volume.mid_nodes.points.empty() &&
         std::all_of(volume.vertices.begin(), volume.vertices.end(), is_flat);
}

Sides::Sides(const Volume& volume) : segments(volume.segments), markers(volume.segment_markers) {
  markers.resize(segments.size(), 0);
  const std::vector<Segment> boundary = boundary_of(volume.facets);
  std::vector<bool> is_segment(boundary.size(), false);
  for (const Segment& s : segments) {
    const Segment edge = ascending(s);
    const auto found = std::lower_bound(boundary.begin(), boundary.end(), edge);
    on_boundary.push_back(found != boundary.end() && *found == edge);
    if (on_boundary.back()) is_segment[static_cast<std::size_t>(found - boundary.begin())] = true;
  }
  for (std::size_t i = 0; i < boundary.size(); ++i) {
    if (is_segment[i]) continue;
    segments.push_back(boundary[i]);
    markers.push_back(0);
    on_boundary.push_back(true);
  }
}

}  // namespace holdfast::io
