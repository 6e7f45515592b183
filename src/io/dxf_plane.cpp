#include "io/dxf_plane.h"

#include <cmath>
#include <string>

namespace holdfast::io {
namespace {

Point cross_of(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Point unit_of(const Point& p, const DxfText& text, const DxfEntity& entity) {
  const double length = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
  if (!(length > 0))
    text.fail_at(entity.place, "an entity (" + in_quotes(entity.type) + ") whose plane has no normal");
  return {p[0] / length, p[1] / length, p[2] / length};
}

}  // namespace

Placement placement_of_plane(DxfText& text, const DxfEntity& entity) {
  const Point normal{text.real(entity, 210, 0), text.real(entity, 220, 0), text.real(entity, 230, 1)};
  if (normal == Point{0, 0, 1}) return {};
  constexpr double kSmall = 1.0 / 64;
  const bool is_near_z = std::fabs(normal[0]) < kSmall && std::fabs(normal[1]) < kSmall;
  const Point z = unit_of(normal, text, entity),
              x = unit_of(cross_of(is_near_z ? Point{0, 1, 0} : Point{0, 0, 1}, z), text, entity);
  const Point y = cross_of(z, x);
  Placement plane;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    plane.m[axis] = x[axis];
    plane.m[3 + axis] = y[axis];
    plane.m[6 + axis] = z[axis];
  }
  return plane;
}

}  // namespace holdfast::io
