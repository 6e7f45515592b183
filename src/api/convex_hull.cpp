// The convex hull of a surface's vertices as triangles that fit the surface.
#include <algorithm>
#include <map>
#include <numeric>
#include <stdexcept>
#include <string>

#include "exact/predicates.h"
#include "holdfast/plane.h"
#include "holdfast/tetgen.h"
#include "mesh/limit_message.h"
#include "mesh/started.h"
#include "numbers/float_environment.h"
#include "numbers/sorted.h"
#include "surface/places.h"

namespace holdfast {
namespace {

/// The triangles of the hull, counterclockwise from outside, by the first vertex of each place.
std::vector<Triangle> hull_of(const std::vector<Point>& vertices, const Limits& limits) {
  DelaunayOptions options;
  static_cast<Limits&>(options) = limits;
  const std::vector<Tetrahedron> tetrahedra = delaunay(vertices, options);
  const std::vector<Neighbours> beside = neighbours(tetrahedra);
  std::vector<Triangle> hull;
  for (std::size_t t = 0; t < tetrahedra.size(); ++t)
    for (std::size_t k = 0; k < 4; ++k)
      if (beside[t][k] == no_entity) hull.push_back(outward_face(tetrahedra[t], k));
  return hull;
}

/// Hull triangles, grouped by plane.
class HullFaces {
 public:
  HullFaces(const std::vector<Point>& vertices, const std::vector<Triangle>& triangles)
      : vertices_(vertices) {
    std::map<Segment, std::size_t> sides;
    std::vector<std::size_t> parent(triangles.size());
    std::iota(parent.begin(), parent.end(), std::size_t{0});
    const auto root = [&](std::size_t i) {
      while (parent[i] != i) i = parent[i] = parent[parent[i]];
      return i;
    };
    for (std::size_t i = 0; i < triangles.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        const Index a = triangles[i][k], b = triangles[i][(k + 1) % 3], c = triangles[i][(k + 2) % 3];
        const auto [at, is_new] = sides.try_emplace({std::min(a, b), std::max(a, b)}, i);
        if (!is_new && is_coplanar(triangles[at->second], c)) parent[root(i)] = root(at->second);
      }
    std::map<std::size_t, std::vector<Triangle>> by_root;
    for (std::size_t i = 0; i < triangles.size(); ++i) by_root[root(i)].push_back(triangles[i]);
    for (auto& [first, face] : by_root) faces_.push_back(std::move(face));
  }
  [[nodiscard]] const std::vector<std::vector<Triangle>>& faces() const { return faces_; }

 private:
  [[nodiscard]] bool is_coplanar(const Triangle& t, Index v) const {
    return exact::orient3d(vertices_[t[0]].data(), vertices_[t[1]].data(), vertices_[t[2]].data(),
                           vertices_[v].data()) == 0;
  }
  const std::vector<Point>& vertices_;
  std::vector<std::vector<Triangle>> faces_;
};

/// Two coordinates in which a triangle is counterclockwise. Projection onto them keeps every incidence in the
/// triangle's plane.
std::array<std::size_t, 2> projection_of(const std::vector<Point>& vertices, const Triangle& t) {
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t x = (k + 1) % 3, y = (k + 2) % 3;
    std::array<PlanePoint, 3> p;
    for (std::size_t i = 0; i < 3; ++i) p[i] = {vertices[t[i]][x], vertices[t[i]][y]};
    const int turn = exact::orient2d(p[0].data(), p[1].data(), p[2].data());
    if (turn != 0) return turn > 0 ? std::array{x, y} : std::array{y, x};
  }
  return {0, 1};
}

/// Triangles of one face of the hull that contain the surface's sides; the hull's own if the sides do not
/// fit.
std::vector<Triangle> triangles_of(const std::vector<Point>& vertices, const std::vector<Triangle>& face,
                                   const std::vector<std::vector<Index>>& sides_at, const Limits& limits) {
  if (face.size() == 1) return face;
  const std::vector<Index> corners = corners_of_all(face);
  const auto [x, y] = projection_of(vertices, face[0]);
  Plane plane;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    plane.points.push_back({vertices[corners[i]][x], vertices[corners[i]][y]});
    for (const Index other : sides_at[corners[i]]) {
      const auto at = std::lower_bound(corners.begin(), corners.end(), other);
      if (at != corners.end() && *at == other)
        plane.segments.push_back({static_cast<Index>(i), static_cast<Index>(at - corners.begin())});
    }
  }
  PlaneOptions options;
  static_cast<Limits&>(options) = limits;
  options.hull = true;
  const PlaneResult result = triangulate(plane, options);
  if (is_interruption(result.outcome)) throw Interrupted(result.outcome);
  if (result.outcome != Outcome::done) return face;
  std::vector<Triangle> triangles;
  for (const Triangle& t : result.mesh.triangles)
    triangles.push_back({corners[t[0]], corners[t[1]], corners[t[2]]});
  return triangles;
}

template <class Entity>
void require_vertices(const char* what, const std::vector<Entity>& entities, std::size_t vertices) {
  for (std::size_t i = 0; i < entities.size(); ++i)
    for (const Index v : entities[i])
      if (v >= vertices)
        throw std::invalid_argument(what + (" " + std::to_string(i)) + " names vertex " + std::to_string(v) +
                                    ", of " + std::to_string(vertices));
}

/// The facets and sides of a surface, by the first vertex of each place.
class Present {
 public:
  explicit Present(const Surface& surface) : sides_at_(surface.vertices.size()) {
    const std::vector<Index> place = first_at_places(surface.vertices);
    const auto add_side = [&](Index a, Index b) {
      sides_at_[std::min(place[a], place[b])].push_back(std::max(place[a], place[b]));
    };
    for (const Triangle& f : surface.facets) {
      facets_.push_back(ascending(Triangle{place[f[0]], place[f[1]], place[f[2]]}));
      for (std::size_t k = 0; k < 3; ++k) add_side(f[k], f[(k + 1) % 3]);
    }
    for (const Segment& s : surface.segments) add_side(s[0], s[1]);
    for (std::vector<Index>& sides : sides_at_) sort_unique(sides);
    std::sort(facets_.begin(), facets_.end());
  }

  [[nodiscard]] bool has(const Triangle& t) const {
    return std::binary_search(facets_.begin(), facets_.end(), ascending(t));
  }
  /// By the lower end of each side, its higher ends.
  [[nodiscard]] const std::vector<std::vector<Index>>& sides_at() const { return sides_at_; }

 private:
  std::vector<Triangle> facets_;
  std::vector<std::vector<Index>> sides_at_;
};

}  // namespace

std::size_t add_convex_hull(Surface& surface, const Limits& given) {
  const FloatEnvironment environment;
  const Limits limits = started(given);
  require_vertices("facet", surface.facets, surface.vertices.size());
  require_vertices("segment", surface.segments, surface.vertices.size());
  const HullFaces faces(surface.vertices, hull_of(surface.vertices, limits));
  const Present present(surface);
  std::vector<Triangle> added;
  for (const std::vector<Triangle>& face : faces.faces())
    for (const Triangle& t : triangles_of(surface.vertices, face, present.sides_at(), limits))
      if (!present.has(t)) added.push_back(t);
  surface.facets.insert(surface.facets.end(), added.begin(), added.end());
  if (!surface.facet_markers.empty()) surface.facet_markers.resize(surface.facets.size(), 0);
  return added.size();
}

}  // namespace holdfast
