// The plane of a polygon or facet in space.
#include "plane/level.h"

#include <algorithm>
#include <cmath>

#include "exact/predicates.h"
#include "numbers/vector.h"

namespace holdfast::plane {

Places::Places(std::span<const Point> vertices, std::span<const Index> corners)
    : vertices_(vertices), index_(corners.begin(), corners.end()) {
  std::sort(index_.begin(), index_.end(),
            [&](Index i, Index j) { return vertices[i] != vertices[j] ? vertices[i] < vertices[j] : i < j; });
  index_.erase(
      std::unique(index_.begin(), index_.end(), [&](Index i, Index j) { return vertices[i] == vertices[j]; }),
      index_.end());
}

Vertex Places::place_of(Index corner) const {
  const auto found = std::lower_bound(index_.begin(), index_.end(), corner,
                                      [&](Index i, Index j) { return vertices_[i] < vertices_[j]; });
  return static_cast<Vertex>(found - index_.begin());
}

bool Places::finite() const {
  return std::all_of(index_.begin(), index_.end(), [&](Index i) {
    return std::all_of(vertices_[i].begin(), vertices_[i].end(), [](double x) { return std::isfinite(x); });
  });
}

Sides sides_of(const std::vector<Vertex>& walk) {
  Sides sides;
  sides.reserve(walk.size());
  for (std::size_t i = 0; i < walk.size(); ++i)
    sides.push_back({walk[i], walk[i + 1 < walk.size() ? i + 1 : 0]});
  std::sort(sides.begin(), sides.end());
  return sides;
}

bool turns_right(const std::vector<Position>& positions, const std::vector<Vertex>& walk) {
  const std::size_t n = walk.size();
  std::size_t least = 0;
  for (std::size_t i = 1; i < n; ++i)
    if (positions[walk[i]] < positions[walk[least]]) least = i;
  return n >= 3 && exact::orient2d(positions[walk[(least + n - 1) % n]].data(), positions[walk[least]].data(),
                                   positions[walk[(least + 1) % n]].data()) < 0;
}

int turn(const Point& a, const Point& b, const Point& c, std::size_t axis) {
  const std::size_t x = (axis + 1) % 3, y = (axis + 2) % 3;
  const double p[2] = {a[x], a[y]}, q[2] = {b[x], b[y]}, r[2] = {c[x], c[y]};
  return exact::orient2d(p, q, r);
}

Level::Level(const Places& places, const Sides& sides, double tolerance) : places_(places) {
  find_base();
  if (straight_) return;
  measure(sides);
  flat_ = exactly_flat();
  if (flat_) deviation_ = 0;
  near_ = flat_ || deviation_ <= std::max(rounding_, tolerance);
  near_in_file_ = near_ || deviation_ <= rounding_in_file_;
  choose_axis();
}

void Level::find_base() {
  third_ = 2;
  const auto on_line = [&](Vertex c) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (turn(places_.at(0), places_.at(1), places_.at(c), axis) != 0) return false;
    return true;
  };
  while (third_ < places_.size() && on_line(third_)) ++third_;
  straight_ = third_ >= places_.size();
}

bool Level::exactly_flat() const {
  for (Vertex d = 2; d < places_.size(); ++d)
    if (d != third_ && exact::orient3d(places_.at(0).data(), places_.at(1).data(), places_.at(third_).data(),
                                       places_.at(d).data()) != 0)
      return false;
  return true;
}

namespace {

/// Of the plane through the first point, the furthest from it, and the furthest from these two.
Point normal_of_widest(const std::vector<Point>& points) {
  Point side{}, normal{};
  for (const Point& p : points)
    if (length(p - points[0]) > length(side)) side = p - points[0];
  for (const Point& p : points)
    if (const Point n = cross(side, p - points[0]); length(n) > length(normal)) normal = n;
  return normal;
}

}  // namespace

void Level::measure(const Sides& sides) {
  double most = 0;
  for (Vertex v = 0; v < places_.size(); ++v)
    for (const double x : places_.at(v)) most = std::max(most, std::abs(x));
  // A power of two scales coordinates to size 1; the scaling is exact up to negligible terms.
  const int exponent = std::ilogb(most);
  const auto scaled = [&](const Point& p) {
    return Point{std::scalbn(p[0], -exponent), std::scalbn(p[1], -exponent), std::scalbn(p[2], -exponent)};
  };
  const Point origin = scaled(places_.at(0));
  std::vector<Point> local;
  double size = 0;
  for (Vertex v = 0; v < places_.size(); ++v) {
    local.push_back(scaled(places_.at(v)) - origin);
    for (const double x : local.back()) size = std::max(size, std::abs(x));
  }
  // A few units in the last place of the largest coordinate: of a double, and of six decimal digits.
  constexpr int kRounding = -50, kRoundingInFile = -16;
  const double unit = std::scalbn(most, -exponent);
  rounding_ = std::scalbn(unit, exponent + kRounding);
  rounding_in_file_ = std::scalbn(unit, exponent + kRoundingInFile);
  if (size == 0) return;  // places so close together that doubles have no normal
  Point middle{};
  for (Point& p : local)
    for (std::size_t k = 0; k < 3; ++k) middle[k] += (p[k] /= size) / static_cast<double>(local.size());
  for (const auto& [a, b] : sides) {
    const Point area = cross(local[a], local[b]);
    for (std::size_t k = 0; k < 3; ++k) normal_[k] += area[k];
  }
  // Without sides, or with a total area of 0 as a figure eight has, there is no mean plane: use three places.
  if (!(length(normal_) > 0)) normal_ = normal_of_widest(local);
  const double norm = length(normal_);
  double furthest = 0;
  for (const Point& p : local) furthest = std::max(furthest, std::abs(dot(normal_, p - middle)));
  deviation_ = std::scalbn(norm > 0 ? furthest / norm * size : size, exponent);
}

// If the three places of the base are not collinear in the projection, no two places of the plane coincide
// there.
void Level::choose_axis() {
  std::array<std::size_t, 3> axes{0, 1, 2};
  std::stable_sort(axes.begin(), axes.end(),
                   [&](std::size_t i, std::size_t j) { return std::abs(normal_[i]) > std::abs(normal_[j]); });
  axis_ = axes[0];
  for (const std::size_t axis : axes) {
    if (turn(places_.at(0), places_.at(1), places_.at(third_), axis) == 0) continue;
    axis_ = axis;
    break;
  }
  if (normal_[axis_] != 0) return;  // a divisor when points are mapped back into space
  normal_ = {};
  normal_[axis_] = 1;
}

}  // namespace holdfast::plane
