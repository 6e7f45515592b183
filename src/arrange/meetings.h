// The intersections of pairs of elements, as points of the pool and traces on both elements.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "arrange/arrange.h"
#include "arrange/facet_planes.h"
#include "arrange/point_pool.h"
#include "arrange/sheet.h"
#include "surface/contacts.h"

namespace holdfast::arrange {

/// Two elements that do not fit together and share no area.
struct Meeting {
  std::array<Index, 2> elements;  ///< of Elements::all
  /// One or two points (else no_index), and for each element the face (vertex, side or facet, as a mask of
  /// corners) in whose interior the point lies.
  std::array<Index, 2> points{no_index, no_index};
  std::array<std::array<std::uint8_t, 2>, 2> faces{};  ///< [point][element]

  /// The union of the masks of an element's faces in whose interiors the points lie. If it is not the whole
  /// facet, the meeting lies on a side or is a corner.
  [[nodiscard]] unsigned mask(std::size_t element) const {
    return faces[0][element] | (points[1] == no_index ? 0u : faces[1][element]);
  }
  [[nodiscard]] bool is_point() const { return points[1] == no_index; }
};

struct Meetings {
  std::vector<Meeting> all;                       ///< ordered by elements
  std::vector<std::array<Index, 2>> overlapping;  ///< pairs of facets that share area
};

/// Two elements that do not fit together, the lower index first, and their intersection.
struct OffendingPair {
  std::array<Index, 2> elements;
  Common part;

  friend bool operator<(const OffendingPair& a, const OffendingPair& b) { return a.elements < b.elements; }
};

/// `planes`: of all facets of the pairs. New points go into the pool. Throws TooManyPoints if there are many
/// more than the options allow; if there are only some more, the caller will find that.
[[nodiscard]] Meetings find_meetings(const Complex& complex, const Elements& elements,
                                     std::span<const OffendingPair> pairs, const FacetPlanes& planes,
                                     PointPool& pool, const Step& step, const ArrangeOptions& options);

/// The line of a trace that a meeting leaves on the plane of its first (0) or second (1) element.
[[nodiscard]] Line line_of(const Meeting& meeting, std::size_t element, const Elements& elements);

}  // namespace holdfast::arrange
