// Facets by their corners.
#pragma once

#include <span>
#include <vector>

#include "surface/complex.h"

namespace holdfast {

/// Finds the facet with given corners in any order: those with the same least corner lie together, sorted by
/// the two others. Nearly always these are a handful.
class FacetIndex {
 public:
  /// Corners are below `vertices`. Repeated facets are found as one of them.
  FacetIndex(std::size_t vertices, std::span<const Triangle> facets);

  /// The facet, or `no_index`.
  [[nodiscard]] Index find(const Triangle& corners) const;

 private:
  struct Entry {
    Index middle, most, facet;
  };
  std::vector<Index> first_;  // by least corner, in entries_; one more than vertices
  std::vector<Entry> entries_;
};

}  // namespace holdfast
