// The last resort: a cavity round non-positive tetrahedra is emptied and filled again by the mesher itself.
//
// A cavity whose boundary is a valid surface can always be filled (paper §5), whatever its inside looks like,
// and a
// growing cavity at last is a whole connected component, whose boundary is the volume's: valid, as checked
// before.
#pragma once

#include <functional>

#include "untangle/tangle.h"
#include "untangle/watch.h"

namespace holdfast {

/// What a filler makes of a complex.
struct Filled {
  enum class Outcome {
    done,
    invalid,            ///< the complex is no valid surface
    not_representable,  ///< there is no mesh in doubles
  };
  Outcome outcome = Outcome::done;
  Volume volume{};              ///< every bounded region with its own id, without what lies outside
  std::vector<Index> faulty{};  ///< vertices of what is invalid
};
using CavityFiller = std::function<Filled(const Complex&)>;

struct RefillStats {
  std::size_t cavities = 0;
  /// No tetrahedron is left that is not positive. Where some are, the boundary encloses no mesh (`overlaps`:
  /// parts of the volume lie in one another, or inside out; `outside`: a segment or a vertex that is to stay
  /// lies there) or the filler found none in doubles.
  bool done = false;
  bool overlaps = false, outside = false;
};

/// Empties and refills the smallest cavities that allow it. Free vertices in a cavity stay where they serve;
/// the others are taken out of the mesh, and the filler's come in.
RefillStats refill(Tangle& tangle, const CavityFiller& filler, Watch& watch);

}  // namespace holdfast
