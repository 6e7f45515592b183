// Holdfast: the order in which missing constraints are laid, and the mesh of a run that was stopped early.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "holdfast/export.h"
#include "holdfast/types.h"

namespace holdfast {

/// Which of the missing segments is laid first, and then which of the missing facets (paper §2.4).
enum class LayingOrder {
  given,    ///< by number in the input; sides of facets by their vertices
  random,   ///< any order with equal probability
  halving,  ///< the middle one of the given order, those in the middle of both halves, and so on
};
[[nodiscard]] HOLDFAST_API const char* name(LayingOrder order);

/// The constraints of a run that `stop_after` ended before regions were found. Vertices are numbered as in
/// the mesh, facets as in the input.
struct Intermediate {
  std::vector<Segment> missing_segments;  ///< not a single edge of the mesh; includes sides of facets
  std::vector<Index> missing_facets;      ///< not a single face of the mesh
  /// A missing segment in pieces, from its first end to the second.
  struct Chain {
    Segment segment;
    std::vector<Index> vertices;
  };
  std::vector<Chain> chains;
  /// A missing facet in pieces: the faces of the mesh that cover it.
  struct SubFacets {
    Index facet;
    std::vector<Triangle> faces;
  };
  std::vector<SubFacets> sub_facets;
  /// A vertex that was added inside a segment, or else inside a facet.
  struct Added {
    Index vertex;
    std::optional<Segment> segment;
    std::optional<Index> facet;
  };
  std::vector<Added> added;
};

}  // namespace holdfast
