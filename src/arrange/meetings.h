// What pairs of elements have in common, as points of the pool and traces on each of them.
#pragma once

#include <array>
#include <vector>

#include "arrange/arrange.h"
#include "arrange/point_pool.h"
#include "arrange/sheet.h"

namespace holdfast::arrange {

/// Two elements that do not fit together and share no area.
struct Meeting {
  std::array<Index, 2> elements;  ///< of Elements::all
  /// One or two points (else no_index), and for each element the face, as a mask of corners, in whose
  /// interior the point lies.
  std::array<Index, 2> points{no_index, no_index};
  std::array<std::array<std::uint8_t, 2>, 2> faces{};  ///< [point][element]

  /// Faces of an element in whose interiors the points lie, as one mask: if it is no facet's whole, the
  /// meeting lies on a side, or is a corner.
  [[nodiscard]] unsigned mask(std::size_t element) const {
    return faces[0][element] | (points[1] == no_index ? 0u : faces[1][element]);
  }
  [[nodiscard]] bool is_point() const { return points[1] == no_index; }
};

struct Meetings {
  std::vector<Meeting> all;                       ///< ordered by elements
  std::vector<std::array<Index, 2>> overlapping;  ///< pairs of facets that share area
};

/// Of pairs of elements, each with the lesser index first. New points go into the pool.
[[nodiscard]] Meetings find_meetings(const Complex& complex, const Elements& elements,
                                     std::vector<std::array<Index, 2>> pairs, PointPool& pool,
                                     const Step& step, const Threads& threads);

/// The line of a trace that a meeting leaves on the plane of its first (0) or second (1) element.
[[nodiscard]] Line line_of(const Meeting& meeting, std::size_t element, const Elements& elements);

}  // namespace holdfast::arrange
