// Surface layer: vertices with identical coordinates are one vertex, whatever format or program wrote them
// (many programs split vertices at seams of textures and normals).
//
// A mesh has each place once, in the order of the first vertices. Facets and segments stay; only the vertex
// indices in them change. Messages and everything else that goes back to the caller use the caller's names:
// the first vertex of a place.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "holdfast/types.h"
#include "surface/complex.h"

namespace holdfast {

/// Which vertices of a complex are identical.
struct Places {
  /// For each vertex the first one at its place, or `no_index` if it is left out. A vertex that no facet or
  /// segment uses is left out if it is not finite, or if another vertex is at its place (one of them stays, a
  /// used one if possible). A used vertex that is not finite is a place of its own.
  std::vector<Index> first;
  std::size_t merged = 0;    ///< vertices in use that are not the first at their place
  std::size_t left_out = 0;  ///< vertices that are left out

  /// Each vertex is a place of its own.
  [[nodiscard]] bool all_distinct() const { return merged == 0 && left_out == 0; }
};

/// Indices may be out of range.
[[nodiscard]] Places places_of(const Complex& complex);

/// The same for all vertices, used or not: for each finite vertex the first one with its coordinates.
[[nodiscard]] std::vector<Index> first_at_places(std::span<const Point> vertices);

/// For each vertex, the index of its place, or `no_index` if it is left out.
[[nodiscard]] std::vector<Index> index_of(const Places& places);

/// The same as a public map: -1 for vertices that are left out.
[[nodiscard]] std::vector<std::int64_t> as_map(std::span<const Index> index);

/// A complex in which each place is one vertex.
struct Merged {
  std::vector<Point> vertices;  ///< with the bits of the first vertex at the place
  std::vector<Triangle> facets;
  std::vector<Segment> segments;
  std::vector<int> vertex_markers;  ///< for each place, the first that is not 0; empty if the input's are
  std::vector<Index> first;         ///< for each vertex here, the first vertex of the original
  std::vector<Index> index;         ///< for each vertex of the original, its index here; see index_of
};

/// Indices must be in range.
[[nodiscard]] Merged merge(const Complex& complex, const Places& places);

/// The smallest positive size of each place, or 0 if there is none.
[[nodiscard]] std::vector<double> merged_sizes(const Merged& merged, std::span<const double> sizes);

/// The names that messages use for the vertices of a complex that may have been merged.
class VertexNames {
 public:
  VertexNames() = default;
  explicit VertexNames(std::span<const Index> first) : first_(first) {}
  [[nodiscard]] Index operator()(Index v) const { return first_.empty() ? v : first_[v]; }

 private:
  std::span<const Index> first_;
};

}  // namespace holdfast
