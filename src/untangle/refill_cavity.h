// One cavity to fill again, and the test whether a filling may replace it.
#pragma once

#include <optional>
#include <vector>

#include "untangle/cavity_complex.h"

namespace holdfast {

class RefillCavity {
 public:
  RefillCavity(const Tangle& tangle, std::vector<Tet> tets)
      : tangle_(tangle), cavity_(tangle, std::move(tets)) {}

  enum class Outcome {
    filled,
    invalid,   ///< the boundary is no valid surface, or what it bounds does not fit the mesh around
    overlaps,  ///< it is, but does not bound what it should: sides lie within one another or inside out
    outside,   ///< it is, but segments or vertices that are to stay lie outside
    not_representable,  ///< the filler has no mesh in doubles
  };
  /// Asks the filler for a mesh; the tangle is unchanged.
  Outcome fill(const CavityFiller& filler);
  /// After Outcome::filled: puts the new tetrahedra in the place of the old.
  void apply(Tangle& tangle) const;

 private:
  static constexpr Index kOutside = CavityComplex::kOutside;
  using Owners = std::vector<std::optional<Index>>;  // the part of the cavity that each region fills

  Outcome judge(Volume volume);
  [[nodiscard]] std::optional<Owners> owners_in(const Volume& volume) const;
  [[nodiscard]] bool splits(const Owners& owners) const;
  [[nodiscard]] bool joins_outside() const;
  [[nodiscard]] bool keeps_segments_and_vertices() const;

  const Tangle& tangle_;
  CavityComplex cavity_;
  Volume volume_;
  std::vector<Index> owner_;  // of each tetrahedron of volume_
};

}  // namespace holdfast
