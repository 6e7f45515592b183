#include "refine/point_setter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "mesh/editor.h"
#include "numbers/vector.h"
#include "refine/circumcentre.h"

namespace holdfast {
namespace {

double square(const Vector& v) { return dot(v, v); }

std::array<double, 2> shortest_and_longest2(const Point& a, const Point& b, const Point& c, const Point& d) {
  const std::array<double, 6> lengths2{square(b - a), square(c - a), square(d - a),
                                       square(c - b), square(d - b), square(d - c)};
  const auto [least, most] = std::minmax_element(lengths2.begin(), lengths2.end());
  return {*least, *most};
}

}  // namespace

double radius_over_edge(const Point& a, const Point& b, const Point& c, const Point& d) {
  const ScaledCentre centre = sphere_centre(a, b, c, d);
  const double shortest2 = shortest_and_longest2(a, b, c, d)[0];
  const double ratio = std::sqrt(square(centre.at) / shortest2) / std::abs(centre.scale);
  return ratio >= 0 ? ratio : std::numeric_limits<double>::infinity();
}

double fatness_of(const Point& a, const Point& b, const Point& c, const Point& d) {
  const double longest2 = shortest_and_longest2(a, b, c, d)[1];
  const double fatness = dot(b - a, cross(c - a, d - a)) / (longest2 * std::sqrt(longest2));
  return fatness > 0 ? fatness : 0;
}

std::optional<Point> PointSetter::centre_of(Tet t) const {
  const TetMesh::Corners& c = mesh_.corners(t);
  const Point& a = mesh_.position(c[0]);
  const ScaledCentre centre =
      sphere_centre(a, mesh_.position(c[1]), mesh_.position(c[2]), mesh_.position(c[3]));
  const Point x{a[0] + centre.at[0] / centre.scale, a[1] + centre.at[1] / centre.scale,
                a[2] + centre.at[2] / centre.scale};
  if (!std::isfinite(x[0]) || !std::isfinite(x[1]) || !std::isfinite(x[2])) return std::nullopt;
  return x;
}

std::span<const Tet> PointSetter::make(const Point& x, Tet t, bool alone) {
  const RegionId region = volume_.region_of[t];
  const TetMesh::Corners near = mesh_.corners(t);
  const Vertex p = begin(x);
  if (!find(p, t, alone)) throw std::logic_error("holdfast: a point that fitted does not fit");
  double size = 0;
  for (const Vertex v : near) size = std::max(size, volume_.sizes[v]);
  volume_.sizes.push_back(size);
  if (volume_.metrics != nullptr) volume_.metrics->push_back(volume_.mean_metric(near));
  cavity_.insert();
  volume_.region_of.resize(mesh_.slot_count(), kNone);
  for (const Tet made : cavity_.created()) volume_.region_of[made] = region;
  return cavity_.created();
}

Vertex PointSetter::begin(const Point& x) { return MeshEditor(mesh_).add_vertex(x); }

void PointSetter::end() { MeshEditor(mesh_).remove_last_vertex(); }

bool PointSetter::find(Vertex p, Tet t, bool alone) {
  const Tet base = cavity_.locate(p, t);
  if (base == kNone || mesh_.is_ghost(base) || volume_.region_of[base] != volume_.region_of[t]) return false;
  if (!alone) return cavity_.find(p, base, Frame{}, kMostTets);
  return base == t && cavity_.find_among(p, t, std::array{t});
}

}  // namespace holdfast
