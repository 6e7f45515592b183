// Polygons and facets in space as points and segments in planes.
#include <algorithm>
#include <map>
#include <utility>

#include "plane/facets.h"
#include "plane/level.h"
#include "text/decimal.h"

namespace holdfast::plane {
namespace {

Ends ordered(Vertex a, Vertex b) { return {std::min(a, b), std::max(a, b)}; }

class Planes {
 public:
  Planes(std::span<const Point> vertices, const std::vector<PolygonFacet>& facets, double tolerance)
      : vertices_(vertices), facets_(facets), tolerance_(tolerance) {}

  FoundPlanes run(const Poll& poll) {
    PolygonFacet all;
    for (const PolygonFacet& facet : facets_) {
      all.polygons.insert(all.polygons.end(), facet.polygons.begin(), facet.polygons.end());
      all.holes.insert(all.holes.end(), facet.holes.begin(), facet.holes.end());
    }
    const bool alone = facets_.size() == 1 || std::none_of(facets_.begin(), facets_.end(), has_area);
    if (add(all, alone) || alone) return std::move(found_);
    const std::string why_not_one = std::exchange(found_.reason, {});
    const Sides sides = sides_of_polygons();
    for (found_.facet = 0; found_.facet < facets_.size(); ++found_.facet) {
      if (poll && found_.facet % 256 == 0)
        poll(static_cast<double>(found_.facet) / static_cast<double>(facets_.size()));
      const PolygonFacet& facet = facets_[found_.facet];
      if (has_area(facet) ? !add(facet, true) : !stands_in(facet, sides)) break;
    }
    if (found_.reason.empty() && found_.facet < facets_.size())
      found_.reason = "it is no side of a polygon, and not all is in one plane (" + why_not_one +
                      "): only polygons are filled then, each in its own plane; leave it out";
    return std::move(found_);
  }

 private:
  /// Rather than segments or points alone, each by itself.
  static bool has_area(const PolygonFacet& facet) {
    return facet.polygons.size() > 1 || (facet.polygons.size() == 1 && facet.polygons[0].size() > 2);
  }
  /// The sides of all facets with an area, by vertices, sorted.
  [[nodiscard]] Sides sides_of_polygons() const {
    Sides sides;
    for (const PolygonFacet& facet : facets_)
      if (has_area(facet))
        for (const std::vector<Index>& polygon : facet.polygons)
          for (std::size_t i = 0; i < polygon.size(); ++i)
            sides.push_back(ordered(polygon[i], polygon[(i + 1) % polygon.size()]));
    std::sort(sides.begin(), sides.end());
    return sides;
  }
  /// Whether a single segment or point adds nothing to the polygons.
  static bool stands_in(const PolygonFacet& facet, const Sides& sides) {
    if (facet.polygons.empty()) return true;
    const std::vector<Index>& ends = facet.polygons[0];
    return ends.size() == 2 && std::binary_search(sides.begin(), sides.end(), ordered(ends[0], ends[1]));
  }

  /// Adds the plane of a facet; returns false, with the reason, if it has none. A facet that is `alone` may
  /// have been rounded in its file; with several facets, this allowance would merge planes that are close to
  /// each other.
  bool add(const PolygonFacet& facet, bool alone) {
    std::vector<Index> corners;
    for (const std::vector<Index>& polygon : facet.polygons)
      corners.insert(corners.end(), polygon.begin(), polygon.end());
    const Places places(vertices_, corners);
    const auto fail = [&](std::string reason) {
      found_.reason = std::move(reason);
      return false;
    };
    if (!places.finite()) return fail("a corner is not finite");
    if (places.size() < 3) return fail("it has fewer than three places");
    const Sides edges = edges_of(facet, places);
    const std::vector<Vertex> first = first_walk(facet, places);
    const Level level(places, sides_of(first), tolerance_);
    if (level.straight()) return fail("all corners lie on one line");
    if (!(alone ? level.near_in_file() : level.near()))
      return fail("it lies in no plane: its corners are up to " + decimal(level.deviation(), 3) +
                  " away from the mean one; give a larger tolerance");
    found_.deviation = std::max(found_.deviation, level.deviation());
    PlanesInSpace::Part part;
    part.axis = level.axis();
    part.normal = level.normal();
    for (Vertex v = 0; v < places.size(); ++v) {
      part.plane.points.push_back(level.project(places.at(v)));
      part.numbers.push_back(places.index(v));
    }
    part.turned = turns_right(part.plane.points, first);
    part.plane.segments.assign(edges.begin(), edges.end());
    for (const Point& hole : facet.holes) part.plane.holes.push_back(level.project(hole));
    found_.planes.parts.push_back(std::move(part));
    return true;
  }

  /// Each side once.
  static Sides edges_of(const PolygonFacet& facet, const Places& places) {
    Sides edges;
    for (const std::vector<Index>& polygon : facet.polygons)
      for (const auto& [a, b] : sides_of(walk_of(polygon, places)))
        if (a != b) edges.push_back(ordered(a, b));
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
  }
  /// The walk of the first polygon of three corners or more, which gives the mean plane and the orientation
  /// of the triangles.
  static std::vector<Vertex> first_walk(const PolygonFacet& facet, const Places& places) {
    for (const std::vector<Index>& polygon : facet.polygons)
      if (polygon.size() >= 3) return walk_of(polygon, places);
    return {};
  }
  static std::vector<Vertex> walk_of(const std::vector<Index>& polygon, const Places& places) {
    std::vector<Vertex> walk;
    walk.reserve(polygon.size());
    for (const Index corner : polygon) walk.push_back(places.place_of(corner));
    return walk;
  }

  std::span<const Point> vertices_;
  const std::vector<PolygonFacet>& facets_;
  double tolerance_;
  FoundPlanes found_;
};

}  // namespace

FoundPlanes planes_of(std::span<const Point> vertices, const std::vector<PolygonFacet>& facets,
                      double tolerance, const Poll& poll) {
  return Planes(vertices, facets, tolerance).run(poll);
}

void mark(PlanesInSpace::Part& part, std::span<const Point> vertices, std::span<const int> vertex_markers,
          std::span<const Segment> segments, std::span<const int> segment_markers) {
  if (vertex_markers.empty() && segment_markers.empty()) return;
  std::map<Point, Vertex> at;
  for (Vertex v = 0; v < part.numbers.size(); ++v) at.try_emplace(vertices[part.numbers[v]], v);
  const auto place_of = [&](Index vertex) {
    const auto found = at.find(vertices[vertex]);
    return found == at.end() ? no_entity : found->second;
  };
  Plane& plane = part.plane;
  for (Index v = 0; v < vertex_markers.size(); ++v) {
    const Vertex place = vertex_markers[v] == 0 ? no_entity : place_of(v);
    if (place == no_entity) continue;
    plane.point_markers.resize(plane.points.size(), 0);
    if (plane.point_markers[place] == 0) plane.point_markers[place] = vertex_markers[v];
  }
  std::map<Ends, std::size_t> number;
  for (std::size_t s = 0; s < plane.segments.size(); ++s)
    number[ordered(plane.segments[s][0], plane.segments[s][1])] = s;
  for (std::size_t i = 0; i < segment_markers.size(); ++i) {
    if (segment_markers[i] == 0) continue;
    const auto found = number.find(ordered(place_of(segments[i][0]), place_of(segments[i][1])));
    if (found == number.end()) continue;
    plane.segment_markers.resize(plane.segments.size(), 0);
    int& marker = plane.segment_markers[found->second];
    if (marker == 0) marker = segment_markers[i];
  }
}

}  // namespace holdfast::plane
