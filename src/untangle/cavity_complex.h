// The boundary and the constraints of a cavity, as a complex to mesh.
#pragma once

#include <span>
#include <unordered_map>
#include <vector>

#include "untangle/refill.h"
#include "untangle/tangle.h"

namespace holdfast {

/// The tetrahedra of a cavity as a complex: the faces to the rest of the mesh and every constraint inside,
/// and as isolated points the vertices inside that must stay or may.
class CavityComplex {
 public:
  static constexpr Index kOutside = ~Index{0};

  /// Parts of the cavity, which constraints separate, on the two sides of a facet; or kOutside.
  struct Sides {
    Index above, below;
  };

  CavityComplex(const Tangle& tangle, std::vector<Tet> tets);

  [[nodiscard]] Complex view() const { return surface_.view(); }
  [[nodiscard]] const std::vector<Triangle>& facets() const { return surface_.facets; }
  /// Their ends ascending.
  [[nodiscard]] const std::vector<Segment>& segments() const { return surface_.segments; }
  [[nodiscard]] const std::vector<Sides>& sides() const { return sides_; }
  /// The tangle's vertices, by number in the complex.
  [[nodiscard]] const std::vector<Vertex>& vertices() const { return vertex_; }
  /// From here on vertices lie on no constraint and may go; those before are to stay.
  [[nodiscard]] std::size_t first_point() const { return first_point_; }
  [[nodiscard]] const std::vector<Tet>& tets() const { return tets_; }
  [[nodiscard]] Index part_of(Tet t) const {
    const auto at = part_.find(t);
    return at == part_.end() ? kOutside : at->second;
  }
  /// The region of each part.
  [[nodiscard]] const std::vector<int>& regions() const { return region_; }
  /// Whether there are no tetrahedra beside it.
  [[nodiscard]] bool is_whole() const { return is_whole_; }

  /// Drops points that do not fit the boundary or each other; all points if it is unknown which. Returns
  /// false if there is no point to drop.
  bool drop_points(const Filled& filled);

 private:
  void find_parts();
  void take_facets();
  void take_segments();
  void take_points();
  Index local(Vertex v);

  const Tangle& tangle_;
  std::vector<Tet> tets_;
  std::unordered_map<Tet, Index> part_;  // of the cavity's tetrahedra
  std::vector<int> region_;              // by part
  std::vector<Vertex> vertex_;
  std::unordered_map<Vertex, Index> number_;
  std::size_t first_point_ = 0;
  Surface surface_;
  std::vector<Sides> sides_;
  bool is_whole_ = true;
};

}  // namespace holdfast
