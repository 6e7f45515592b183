// Surface layer: the elements of a complex, that is, its facets, the segments that are no facet's side and
// the vertices that neither uses; and the flaws of single elements.
//
// Vertices at one place are one vertex here (places.h), so that later steps see a connected surface.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "holdfast/types.h"
#include "mesh/parallel.h"
#include "surface/intersect.h"
#include "surface/places.h"

namespace holdfast {

/// One element. Its corners are the first vertices at their places.
struct Element {
  std::array<Index, 3> vertex{};
  Index id = 0;              ///< in the complex's facets, segments or vertices
  std::uint8_t corners = 0;  ///< 3: facet, 2: segment, 1: vertex
  std::uint8_t axis = 0;     ///< of Simplex, for facets
  std::int16_t turn = 0;     ///< of Simplex, for facets
};

/// A flaw of one entity of the complex, or two vertices at one place.
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

  /// The element in the form that the tests take.
  [[nodiscard]] static Simplex simplex(const Element& element, const Complex& complex);
};

/// What several vertices at one place mean.
enum class SamePlace {
  one_vertex,  ///< of a surface
  defect,      ///< of a volume, whose vertices stay as they are: every vertex is checked, used or not
};

/// Collects the elements. Left out, with a flaw: entities with an index out of range or a non-finite corner
/// (the flaw names the vertex), facets of zero area, segments with equal ends. Left out silently: segments
/// that repeat a facet's side or an earlier segment, and later copies of a vertex.
[[nodiscard]] Elements elements_of(const Complex& complex, const Threads& threads = 1,
                                   SamePlace same_place = SamePlace::one_vertex);

}  // namespace holdfast
