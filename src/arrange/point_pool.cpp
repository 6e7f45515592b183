// The points of an arrangement.
#include "arrange/point_pool.h"

#include <cmath>

#include "surface/complex.h"

namespace holdfast::arrange {

PointPool::PointPool(std::span<const Point> vertices, std::span<const Index> first)
    : vertices_(vertices), table_(vertices.size()), next_(vertices.size(), no_index) {
  const auto point_of = [&](Index v) -> const Point& { return nearest(v); };
  for (Index v = 0; v < vertices.size(); ++v) {
    const Point& p = vertices[v];
    if (first[v] == v && std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]))
      table_.find_or_add(p, PlaceTable::hash_of(p), v, point_of);
  }
}

bool PointPool::is_at(Index p, const exact::SpacePoint& point) const {
  return exact::equal(is_vertex(p) ? exact::space_point(vertices_[p].data()) : exact(p), point);
}

Index PointPool::add(exact::PackedPoint point, const Point& at) {
  const Index fresh = size();
  const auto point_of = [&](Index v) -> const Point& { return v == fresh ? at : nearest(v); };
  Index p = table_.find_or_add(at, PlaceTable::hash_of(at), fresh, point_of);
  if (p != fresh) {
    for (const exact::SpacePoint unpacked = point.point(); !is_at(p, unpacked);) {
      if (next_[p] == no_index) {
        next_[p] = fresh;
        p = fresh;
        break;
      }
      p = next_[p];
    }
  }
  if (p == fresh) {
    exact_.push_back(std::move(point));
    nearest_.push_back(at);
    next_.push_back(no_index);
  }
  return p;
}

int PointPool::compare(Index p, Index q) const {
  if (p == q) return 0;
  // Rounding to nearest is monotonic: coordinates that differ after rounding differ in the same sense before
  // it.
  const Point &a = nearest(p), &b = nearest(q);
  if (a[0] != b[0]) return a[0] < b[0] ? -1 : 1;
  const auto exact_of = [&](Index v) {
    return is_vertex(v) ? exact::space_point(vertices_[v].data()) : exact(v);
  };
  return exact::compare(exact_of(p), exact_of(q));
}

}  // namespace holdfast::arrange
