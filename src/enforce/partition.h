// The method that always recovers a missing constraint: its partition (paper §5), and the elimination of its
// points (paper §6).
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "enforce/facet_section.h"
#include "enforce/steiner_points.h"
#include "mesh/tet_mesh.h"
#include "numbers/random.h"
#include "surface/complex.h"

namespace holdfast {

/// Constraints that are several edges or faces of the mesh, by their numbers.
struct ConstraintPieces {
  struct Chain {
    Index segment;
    std::vector<Vertex> vertices;
  };
  struct SubFacets {
    Index facet;
    std::vector<std::array<Vertex, 3>> faces;
    std::vector<Vertex> inner;
  };
  std::vector<Chain> chains;
  std::vector<SubFacets> sub_facets;
};

/// Recovered constraints are unions of mesh edges and faces, with their bits set: single ones if points are
/// eliminated. All segments must come before the first facet.
class Partition {
 public:
  /// All references must outlive the partition. `tell` is called from time to time, and may throw.
  Partition(TetMesh& mesh, const SegmentTable& table, std::span<const Triangle> facets, Vertex first_free,
            Random& random, const std::function<void()>& tell)
      : mesh_(mesh),
        table_(table),
        facets_(facets),
        first_free_(first_free),
        random_(random),
        tell_(tell),
        chains_(table.segments.size()) {}

  /// Puts points where the mesh crosses a segment. Returns their number.
  std::size_t cut_segment(Index s);
  /// The same for a facet. Its pieces are remembered until its points are eliminated.
  std::size_t cut_facet(Index f);
  /// Takes the points of its partition off a segment, which is then one edge.
  void eliminate_from_segment(Index s, SteinerPoints& steiner);
  /// The same for the points inside the facet that was cut last, which is then one face.
  void eliminate_from_facet(SteinerPoints& steiner);
  /// All constraints that are cut and whose points are not eliminated.
  [[nodiscard]] ConstraintPieces take_pieces();

 private:
  [[nodiscard]] FacetFrame frame_of(Index f) const;

  TetMesh& mesh_;
  const SegmentTable& table_;
  std::span<const Triangle> facets_;
  const Vertex first_free_;
  Random& random_;
  const std::function<void()>& tell_;
  std::vector<std::vector<Vertex>> chains_;  // by segment; empty where it is one edge
  std::vector<ConstraintPieces::SubFacets> sub_facets_;
};

}  // namespace holdfast
