// The convex hull of a surface's vertices as triangles that fit the surface.
#include <algorithm>
#include <map>
#include <numeric>

#include "exact/predicates.h"
#include "holdfast/plane.h"
#include "holdfast/tetgen.h"
#include "numbers/float_environment.h"

namespace holdfast {
namespace {

constexpr std::array<std::array<std::size_t, 3>, 4> kFaces{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

Triangle ascending(Triangle t) {
  std::sort(t.begin(), t.end());
  return t;
}

/// Hull triangles, the coplanar ones together.
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

/// Two coordinates in which a triangle turns left. Leaving one out keeps every incidence in a plane.
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

/// Triangles of one face of the hull with the surface's sides in it; the hull's own where these do not fit.
std::vector<Triangle> triangles_of(const std::vector<Point>& vertices, const std::vector<Triangle>& face,
                                   const std::vector<std::vector<Index>>& sides_at, const Limits& limits) {
  std::vector<Index> corners;
  for (const Triangle& t : face) corners.insert(corners.end(), t.begin(), t.end());
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  if (face.size() == 1) return face;
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
  if (result.outcome != Outcome::done) return face;
  std::vector<Triangle> triangles;
  for (const Triangle& t : result.mesh.triangles)
    triangles.push_back({corners[t[0]], corners[t[1]], corners[t[2]]});
  return triangles;
}

}  // namespace

std::size_t add_convex_hull(Surface& surface, const Limits& limits) {
  const FloatEnvironment environment;
  DelaunayOptions options;
  static_cast<Limits&>(options) = limits;
  const std::vector<Tetrahedron> tetrahedra = delaunay(surface.vertices, options);
  const std::vector<Neighbours> beside = neighbours(tetrahedra);
  std::vector<Triangle> hull;
  for (std::size_t t = 0; t < tetrahedra.size(); ++t)
    for (std::size_t k = 0; k < 4; ++k)
      if (beside[t][k] == no_entity)
        hull.push_back(
            {tetrahedra[t][kFaces[k][0]], tetrahedra[t][kFaces[k][1]], tetrahedra[t][kFaces[k][2]]});

  // Repeated vertices: Delaunay tetrahedra name the first alone, the surface any of them.
  std::map<Point, Index> first;
  std::vector<Index> place(surface.vertices.size());
  for (std::size_t v = 0; v < place.size(); ++v) {
    Point p = surface.vertices[v];
    for (double& x : p) x += 0.0;  // -0 is 0
    place[v] = first.try_emplace(p, static_cast<Index>(v)).first->second;
  }
  std::vector<std::vector<Index>> sides_at(surface.vertices.size());
  std::vector<Triangle> present;
  const auto add_side = [&](Index a, Index b) {
    sides_at[std::min(place[a], place[b])].push_back(std::max(place[a], place[b]));
  };
  for (const Triangle& f : surface.facets) {
    present.push_back(ascending({place[f[0]], place[f[1]], place[f[2]]}));
    for (std::size_t k = 0; k < 3; ++k) add_side(f[k], f[(k + 1) % 3]);
  }
  for (const Segment& s : surface.segments) add_side(s[0], s[1]);
  for (std::vector<Index>& sides : sides_at) {
    std::sort(sides.begin(), sides.end());
    sides.erase(std::unique(sides.begin(), sides.end()), sides.end());
  }
  std::sort(present.begin(), present.end());

  const std::size_t before = surface.facets.size();
  const HullFaces faces(surface.vertices, hull);
  for (const std::vector<Triangle>& face : faces.faces())
    for (const Triangle& t : triangles_of(surface.vertices, face, sides_at, limits))
      if (!std::binary_search(present.begin(), present.end(), ascending(t))) surface.facets.push_back(t);
  if (!surface.facet_markers.empty()) surface.facet_markers.resize(surface.facets.size(), 0);
  return surface.facets.size() - before;
}

}  // namespace holdfast
