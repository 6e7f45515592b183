// Facets by their corners.
#pragma once

#include <span>
#include <vector>

#include "surface/complex.h"

namespace holdfast {

/// Finds the facet with given corners in any order. Facets with the same least corner are adjacent, sorted by
/// the two other corners. There are rarely more than a handful.
class FacetIndex {
 public:
  /// Corners are below `vertices`. For repeated facets, one of them is found.
  FacetIndex(std::size_t vertices, std::span<const Triangle> facets);

  /// The facet, or `no_index`.
  [[nodiscard]] Index find(const Triangle& corners) const;

 private:
  struct Entry {
    Index middle, most, facet;
  };
  std::vector<Index> first_;  // start in entries_ by least corner; one more than vertices
  std::vector<Entry> entries_;
};

}  // namespace holdfast
