// One cavity to be filled again: its boundary as a complex, and what the filler made of it.
#pragma once

#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "untangle/refill.h"
#include "untangle/tangle.h"

namespace holdfast {

/// The tetrahedra of a cavity as a complex: the faces to the rest of the mesh and every constraint inside,
/// and as isolated points the vertices inside that must stay or may.
class RefillCavity {
 public:
  RefillCavity(const Tangle& tangle, std::vector<Tet> tets);

  enum class Outcome {
    filled,
    invalid,   ///< the boundary is no valid surface, or what it bounds does not fit the mesh around
    overlaps,  ///< it is, but does not bound what it should: sides lie within one another or inside out
    not_representable,  ///< the filler has no mesh in doubles
  };
  /// Asks the filler for a mesh; the tangle is unchanged.
  Outcome fill(const Filler& filler);
  /// After Outcome::filled: puts the new tetrahedra in the place of the old.
  void apply(Tangle& tangle) const;

 private:
  static constexpr Index kOutside = ~Index{0};

  struct Facet {
    Index above, below;  ///< components of the cavity on the two sides, or kOutside
  };

  [[nodiscard]] Index component_of(Tet t) const {
    const auto at = component_.find(t);
    return at == component_.end() ? kOutside : at->second;
  }
  void find_components();
  void take_facets();
  void take_segments();
  void take_points();
  Index local(Vertex v);
  bool drop_points(const Result& result);
  Outcome judge(const Volume& volume);
  bool claim(const Volume& volume, std::size_t tet, std::vector<std::optional<Index>>& owners,
             std::vector<std::array<bool, 2>>& seen) const;
  [[nodiscard]] bool splits(std::span<const std::optional<Index>> owners) const;
  bool joins_outside(const Volume& volume) const;

  const Tangle& tangle_;
  std::vector<Tet> tets_;
  std::unordered_map<Tet, Index> component_;  // of the cavity's tetrahedra
  std::vector<int> region_;                   // by component
  std::vector<Vertex> vertex_;                // by local number
  std::unordered_map<Vertex, Index> number_;
  std::size_t first_point_ = 0;  // local vertices from here on may go
  Surface surface_;
  std::vector<Facet> sides_;
  std::vector<std::array<Index, 4>> face_index_;  // corners ascending, facet; sorted
  Volume volume_;
  bool whole_ = true;         // no tetrahedra beside it
  std::vector<Index> owner_;  // of each tetrahedron of volume_
};

}  // namespace holdfast
