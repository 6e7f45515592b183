#include "plane/growing_mesh.h"

#include <algorithm>
#include <cmath>

namespace holdfast::plane {
namespace {

std::vector<Position> scaled(const Points& points, const Scale& scale) {
  std::vector<Position> at;
  for (const Position& p : points.positions()) at.push_back(scale.down(p));
  return at;
}

}  // namespace

GrowingMesh::GrowingMesh(Triangles& mesh, Points& points, const std::vector<Ends>& segments)
    : mesh_(mesh),
      points_(points),
      insertion_(mesh, points),
      scale_(points.positions()),
      first_added_(static_cast<Vertex>(points.size())),
      at_(scaled(points, scale_)),
      segments_(mesh, at_, segments) {
  mesh_.find_stars(points.size());
}

Position GrowingMesh::middle_of(std::uint32_t t) const {
  const std::array<Vertex, 3>& v = mesh_[t].v;
  return {(at_[v[0]][0] + at_[v[1]][0] + at_[v[2]][0]) / 3, (at_[v[0]][1] + at_[v[1]][1] + at_[v[2]][1]) / 3};
}

Vertex GrowingMesh::add(const Position& scaled) {
  const Position p = scale_.up(scaled);
  at_.push_back(scale_.down(p));
  mesh_.add_star(kNoVertex);
  segments_.resize(at_.size());
  return points_.add(p);
}

void GrowingMesh::take_back(Vertex first) {
  points_.shrink(first);
  at_.resize(first);
  mesh_.drop_stars(first);
  segments_.resize(first);
}

Insertion::Place GrowingMesh::locate(Vertex p, std::uint32_t t) {
  const std::array<Vertex, 3>& v = mesh_[t].v;
  const Vertex start = add(middle_of(t));
  bool holds = true;
  for (std::uint32_t i = 0; i < 3; ++i) holds = holds && points_.orient(v[i], v[(i + 1) % 3], start) > 0;
  Insertion::Place found;
  if (holds) found = insertion_.locate(p, start, t);
  take_back(start);
  return found;
}

Vertex GrowingMesh::cut(EdgeCode e) {
  const Vertex a = mesh_.from(e), b = mesh_.to(e);
  if (is_too_fine(at_[a], at_[b])) return kNoVertex;
  const std::uint32_t s = segments_.of(a, b);
  const Vertex p = add(segments_.cut_of(a, b));
  if (!insertion_.insert_on(e, p)) {
    take_back(p);
    return kNoVertex;
  }
  segments_.put(p, s);
  return p;
}

bool GrowingMesh::is_too_fine(const Position& a, const Position& b) const {
  constexpr double kFinest = 0x1p-46;          // times the coordinates
  constexpr double kLeastSquared = 0x1p-1000;  // smaller products lose digits
  const double most = std::max({std::abs(a[0]), std::abs(a[1]), std::abs(b[0]), std::abs(b[1])});
  const double finest = std::max(scale_.finest(), kFinest * most);
  return squared(a, b) < std::max(finest * finest, kLeastSquared);
}

}  // namespace holdfast::plane
