// The intersections of pairs of elements.
#include "arrange/meetings.h"

#include <algorithm>
#include <bit>
#include <optional>
#include <tuple>
#include <utility>

#include "numbers/sorted.h"

namespace holdfast::arrange {
namespace {

/// A point, named by the side and facet or the two sides that cross there. All pairs of elements that contain
/// it give it the same name.
struct Crossing {
  std::array<Index, 2> side;
  std::array<Index, 2> other{no_index, no_index};  // a side, or none
  Index facet = no_index;                          // in Elements::all, or none

  friend bool operator==(const Crossing&, const Crossing&) = default;
  [[nodiscard]] auto tied() const { return std::tie(side, other, facet); }
};

/// One end of a meeting that has no number yet.
struct End {
  Index meeting;
  std::uint8_t which;
  Crossing crossing;
};

std::array<Index, 2> side_of_mask(const Element& element, unsigned mask) {
  std::array<Index, 2> ends{};
  std::size_t count = 0;
  for (unsigned i = 0; i < element.corners; ++i)
    if ((mask >> i & 1u) != 0) ends[count++] = element.vertex[i];
  return ascending(ends);
}

Index corner_of_mask(const Element& element, unsigned mask) {
  return element.vertex[static_cast<std::size_t>(std::countr_zero(mask))];
}

Crossing crossing_of(const Elements& elements, Index i, unsigned mask_i, Index j, unsigned mask_j) {
  const Element &a = elements.all[i], &b = elements.all[j];
  if (std::popcount(mask_i) == 3) return {side_of_mask(b, mask_j), {no_index, no_index}, i};
  if (std::popcount(mask_j) == 3) return {side_of_mask(a, mask_i), {no_index, no_index}, j};
  Crossing crossing{side_of_mask(a, mask_i), side_of_mask(b, mask_j)};
  if (crossing.other < crossing.side) std::swap(crossing.side, crossing.other);
  return crossing;
}

/// A projection in which the two crossing sides are not parallel.
unsigned axis_of(const Complex& complex, const Crossing& crossing) {
  const auto at = [&](Index v) { return complex.vertices[v].data(); };
  for (unsigned axis = 0; axis < 2; ++axis) {
    const exact::SpacePlane plane = exact::upright_plane(at(crossing.other[0]), at(crossing.other[1]), axis);
    const auto side = [&](Index v) {
      const exact::SpacePoint p = exact::space_point(at(v));
      return exact::BigInt(plane.a * p.x + plane.b * p.y + plane.c * p.z + plane.d * p.w).sign();
    };
    if (side(crossing.side[0]) != side(crossing.side[1])) return axis;
  }
  return 2;
}

exact::SpacePoint point_of(const Complex& complex, const FacetPlanes& planes, const Crossing& crossing) {
  const auto at = [&](Index v) { return complex.vertices[v].data(); };
  if (crossing.facet != no_index)
    return exact::crossing(at(crossing.side[0]), at(crossing.side[1]), planes[crossing.facet]);
  return exact::crossing(
      at(crossing.side[0]), at(crossing.side[1]),
      exact::upright_plane(at(crossing.other[0]), at(crossing.other[1]), axis_of(complex, crossing)));
}

Meeting meeting_of(const OffendingPair& pair) {
  Meeting meeting{pair.elements};
  for (std::size_t k = 0; k < pair.part.count; ++k)
    meeting.faces[k] = {static_cast<std::uint8_t>(pair.part.touches[k].a),
                        static_cast<std::uint8_t>(pair.part.touches[k].b)};
  return meeting;
}

/// Numbers the ends that are not vertices. They are computed on all threads, some at a time, and numbered in
/// the order of the crossings.
void number(std::vector<End>& ends, std::vector<Meeting>& meetings, const Complex& complex,
            const FacetPlanes& planes, PointPool& pool, const Step& step, const ArrangeOptions& options) {
  std::sort(ends.begin(), ends.end(), [](const End& a, const End& b) {
    return std::tuple(a.crossing.tied(), a.meeting, a.which) <
           std::tuple(b.crossing.tied(), b.meeting, b.which);
  });
  std::vector<std::size_t> firsts;
  for (std::size_t k = 0; k < ends.size(); ++k)
    if (k == 0 || !(ends[k].crossing == ends[k - 1].crossing)) firsts.push_back(k);
  firsts.push_back(ends.size());
  const std::size_t all = firsts.size() - 1, at_once = std::min<std::size_t>(all, 16384);
  std::vector<std::optional<exact::PackedPoint>> points(at_once);
  std::vector<Point> nearest(at_once);
  for (std::size_t begin = 0; begin < all; begin += at_once) {
    step(0.4);
    const std::size_t count = std::min(at_once, all - begin);
    parallel_ranges(options.threads, count, [&](std::size_t first, std::size_t last) {
      for (std::size_t k = first; k < last; ++k) {
        const exact::SpacePoint point = point_of(complex, planes, ends[firsts[begin + k]].crossing);
        points[k].emplace(point);
        nearest[k] = exact::nearest(point);
      }
    });
    for (std::size_t k = 0; k < count; ++k) {
      const Index p = pool.add(*std::move(points[k]), nearest[k]);
      for (std::size_t e = firsts[begin + k]; e < firsts[begin + k + 1]; ++e)
        meetings[ends[e].meeting].points[ends[e].which] = p;
    }
    if (pool.added() > options.far_too_many()) throw TooManyPoints(pool.added());
  }
}

}  // namespace

Meetings find_meetings(const Complex& complex, const Elements& elements, std::span<const OffendingPair> pairs,
                       const FacetPlanes& planes, PointPool& pool, const Step& step,
                       const ArrangeOptions& options) {
  Meetings meetings;
  std::vector<End> ends;
  for (const OffendingPair& pair : pairs) {
    const auto [i, j] = pair.elements;
    if (pair.part.is_area) {
      meetings.overlapping.push_back({i, j});
      continue;
    }
    Meeting meeting = meeting_of(pair);
    const auto number = static_cast<Index>(meetings.all.size());
    for (std::size_t k = 0; k < 2 && meeting.faces[k][0] != 0; ++k) {
      const unsigned mask_i = meeting.faces[k][0], mask_j = meeting.faces[k][1];
      if (std::popcount(mask_i) == 1)
        meeting.points[k] = corner_of_mask(elements.all[i], mask_i);
      else if (std::popcount(mask_j) == 1)
        meeting.points[k] = corner_of_mask(elements.all[j], mask_j);
      else
        ends.push_back({number, static_cast<std::uint8_t>(k), crossing_of(elements, i, mask_i, j, mask_j)});
    }
    meetings.all.push_back(meeting);
  }
  number(ends, meetings.all, complex, planes, pool, step, options);
  return meetings;
}

Line line_of(const Meeting& meeting, std::size_t element, const Elements& elements) {
  const std::size_t other = 1 - element;
  const Element& cutting = elements.all[meeting.elements[other]];
  const unsigned mask = meeting.mask(other);
  if (cutting.corners == 3 && std::popcount(mask) == 3)
    return {{no_index, no_index}, meeting.elements[other]};
  return {side_of_mask(cutting, mask), no_index};
}

}  // namespace holdfast::arrange
