// Surface layer: vertices with identical coordinates are one vertex, whatever format or program wrote them
// (many split vertices at seams of textures and normals).
//
// A mesh has each place once, in the order of their first vertices. Facets and segments stay what they were,
// so that of all that names them only indices of vertices change. Messages, and whatever else goes back to
// the caller, name vertices as the caller does: by the first of a place.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "holdfast/types.h"
#include "surface/complex.h"

namespace holdfast {

/// Which vertices of a complex are one.
struct Places {
  /// For each vertex the first at its place, or `no_index` where it is left out: what no facet and no segment
  /// uses is left out if it is not finite or if another vertex is at its place (of which one stays, a used
  /// one where there is any). A vertex that is not finite, but used, is a place of its own.
  std::vector<Index> first;
  std::size_t merged = 0;    ///< vertices in use that are not the first at their place
  std::size_t left_out = 0;  ///< vertices

  /// Each vertex is a place of its own.
  [[nodiscard]] bool all_distinct() const { return merged == 0 && left_out == 0; }
};

/// Indices may be out of range.
[[nodiscard]] Places places_of(const Complex& complex);

/// The same without a look at what is used: each finite vertex and the first with its coordinates.
[[nodiscard]] std::vector<Index> first_at_places(std::span<const Point> vertices);

/// For each vertex its index where each place is one vertex, or `no_index` where it is left out.
[[nodiscard]] std::vector<Index> index_of(const Places& places);

/// The same as a public map has it: -1 for what is left out.
[[nodiscard]] std::vector<std::int64_t> as_map(std::span<const Index> index);

/// A complex in which each place is one vertex.
struct Merged {
  std::vector<Point> vertices;  ///< with the bits of the first vertex at the place
  std::vector<Triangle> facets;
  std::vector<Segment> segments;
  std::vector<int> vertex_markers;  ///< of each place the first that is not 0; empty if the original's are
  std::vector<Index> first;         ///< for each vertex here, the first of the original's
  std::vector<Index> index;         ///< for each vertex of the original, see index_of
};

/// Indices must be in range.
[[nodiscard]] Merged merge(const Complex& complex, const Places& places);

/// The least positive one of each place's sizes, and 0 where there is none.
[[nodiscard]] std::vector<double> merged_sizes(const Merged& merged, std::span<const double> sizes);

/// What messages call the vertices of a complex that may have been merged.
class VertexNames {
 public:
  VertexNames() = default;
  explicit VertexNames(std::span<const Index> first) : first_(first) {}
  [[nodiscard]] Index operator()(Index v) const { return first_.empty() ? v : first_[v]; }

 private:
  std::span<const Index> first_;
};

}  // namespace holdfast
