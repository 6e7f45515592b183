// Surface layer: the elements of a complex, that is its facets, the segments that are no facet's side and
// the vertices that neither uses, with what is wrong already with each of them alone.
//
// Vertices at one place are one vertex here (places.h), so that what follows sees a connected surface.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "holdfast/types.h"
#include "mesh/parallel.h"
#include "surface/intersect.h"
#include "surface/places.h"

namespace holdfast {

/// One element; its corners are the first vertices at their places.
struct Element {
  std::array<Index, 3> vertex{};
  Index id = 0;              ///< in the complex's facets, segments or vertices
  std::uint8_t corners = 0;  ///< 3: facet, 2: segment, 1: vertex
  std::uint8_t axis = 0;     ///< of Simplex, for facets
  std::int16_t turn = 0;     ///< of Simplex, for facets
};

/// What is wrong with one entity of the complex, or with two vertices at one place.
struct Flaw {
  DefectKind kind;
  unsigned corners;  ///< 3: a facet, 2: a segment, 1: a vertex
  Index id;          ///< of the entity
  Index other = 0;   ///< repeated_vertex: the first vertex with these coordinates
};

struct Elements {
  std::vector<Element> all;  ///< facets, segments, vertices; each kind by ascending id
  Places places;
  std::vector<Flaw> flaws;  ///< ordered by kind of entity, then id

  /// The element as the tests take it.
  [[nodiscard]] static Simplex simplex(const Element& element, const Complex& complex);
};

/// What several vertices at one place are.
enum class SamePlace {
  one_vertex,  ///< of a surface
  defect,      ///< of a volume, whose vertices stay as they are: then every vertex is looked at, used or not
};

/// Sorts out the elements. Left out, with a flaw: entities with an index out of range or a non-finite
/// corner (told of the vertex), facets of zero area, segments with equal ends. Left out silently: segments
/// that repeat a facet's side or an earlier segment, and later copies of a vertex.
[[nodiscard]] Elements elements_of(const Complex& complex, const Threads& threads = 1,
                                   SamePlace same_place = SamePlace::one_vertex);

}  // namespace holdfast
