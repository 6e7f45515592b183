#include "mesh/measure.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "numbers/sorted.h"
#include "numbers/vector.h"

namespace holdfast {
namespace {

Vector from_to(const TetMesh& mesh, Vertex a, exact::PointRef b) {
  Vector d{};
  exact::difference(b, mesh.point(a), d.data());
  return d;
}

}  // namespace

Point centroid(const TetMesh& mesh, Tet t) {
  Point middle{};
  for (const Vertex v : mesh.corners(t))
    for (std::size_t k = 0; k < 3; ++k) middle[k] += 0.25 * mesh.position(v)[k];
  return middle;
}

double six_volumes(const TetMesh& mesh, const TetMesh::Corners& c) {
  const auto edge = [&](std::size_t i) { return from_to(mesh, c[0], mesh.point(c[i])); };
  return dot(edge(1), cross(edge(2), edge(3)));
}

double height_over(const TetMesh& mesh, Vertex a, Vertex b, Vertex c, Vertex d) {
  const Vector n = cross(from_to(mesh, a, mesh.point(b)), from_to(mesh, a, mesh.point(c)));
  const double area = length(n);  // twice that of abc
  return area > 0 ? std::abs(dot(n, from_to(mesh, a, mesh.point(d)))) / area : 0;
}

double fatness(const TetMesh& mesh, Vertex a, Vertex b, Vertex c, exact::PointRef d) {
  const Vector u = from_to(mesh, a, mesh.point(b));
  const Vector v = from_to(mesh, a, mesh.point(c));
  const Vector w = from_to(mesh, a, d);
  const Vector bc = from_to(mesh, b, mesh.point(c));
  const Vector bd = from_to(mesh, b, d);
  const Vector cd = from_to(mesh, c, d);
  const double longest = std::max({dot(u, u), dot(v, v), dot(w, w), dot(bc, bc), dot(bd, bd), dot(cd, cd)});
  if (!(longest > 0)) return 0;
  return dot(cross(u, v), w) / (longest * std::sqrt(longest));
}

Vertex best_apex(const TetMesh& mesh, const Kernel& kernel) {
  return best_apex(mesh, kernel, corners_of_all(kernel.faces()));
}

Vertex best_apex(const TetMesh& mesh, const Kernel& kernel, std::span<const Vertex> candidates) {
  Vertex best = kNone;
  double best_fatness = -1;
  for (const Vertex v : candidates) {
    if (!kernel.seen_from(v)) continue;
    double least = std::numeric_limits<double>::infinity();
    for (const auto& f : kernel.faces()) {
      if (f[0] == v || f[1] == v || f[2] == v) continue;
      least = std::min(least, fatness(mesh, f[0], f[1], f[2], mesh.point(v)));
    }
    if (best == kNone || least > best_fatness) {
      best = v;
      best_fatness = least;
    }
  }
  return best;
}

}  // namespace holdfast
