// Sets of faces and vertices in files of solvers, which may overlap: here each has one marker, that of the
// smallest set.
#pragma once

#include <cstddef>
#include <limits>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "io/mesh_data.h"
#include "numbers/sorted.h"

namespace holdfast::io {

/// A set, as its members are marked with it.
struct SetOfFile {
  int marker;
  std::size_t size;
};

/// The facets of a mesh and the sets that they belong to. Facets that the mesh has before belong to no set.
class FacetSets {
 public:
  explicit FacetSets(MeshData& mesh);

  /// Gives a facet the marker of a set; `add` adds it to the mesh if it is not there yet.
  template <typename Add>
  void mark(const Triangle& facet, const SetOfFile& set, Add&& add) {
    const auto [found, is_new] = facet_of_.emplace(ascending(facet), static_cast<Index>(mesh_.facets.size()));
    if (is_new) {
      add();
      sizes_.push_back(set.size);
      markers_.push_back(set.marker);
    } else {
      remark(found->second, set);
    }
  }
  /// The triangles of a side of three or four corners: those that the mesh has, or by the rule of `add_cell`.
  [[nodiscard]] std::vector<Triangle> triangles_of(std::span<const Index> corners) const;
  /// Gives a facet that the mesh has the marker of a set.
  void remark(Index facet, const SetOfFile& set);
  /// Stores the markers in the mesh, and reports memberships in larger sets.
  void finish();

 private:
  static constexpr std::size_t kNoSet = std::numeric_limits<std::size_t>::max();

  MeshData& mesh_;
  std::map<Triangle, Index> facet_of_;
  std::vector<std::size_t> sizes_;  ///< by facet, of the set that it belongs to
  std::vector<int> markers_;        ///< by facet
  std::size_t overlaps_ = 0;
};

struct VertexSet {
  int marker;
  std::vector<Index> vertices;
};

/// Gives the vertices of sets their markers, and reports memberships in larger sets.
void mark_vertices(MeshData& mesh, std::vector<VertexSet> sets);

/// The faces of one tetrahedron alone, as seen from outside.
[[nodiscard]] std::vector<Triangle> boundary_of(const MeshData& mesh);

/// Nodes on the edges of the tetrahedra and facets that a mesh has so far.
class NodesOnEdges {
 public:
  explicit NodesOnEdges(const MeshData& mesh);
  /// Adds a triangle, with the nodes on its edges if all have some.
  void add_facet(MeshData& mesh, const Triangle& facet, int marker) const;

 private:
  [[nodiscard]] Index of(Index a, Index b) const;
  std::vector<std::pair<Segment, Index>> nodes_;
};

}  // namespace holdfast::io
