// The untangled mesh as a volume: constrained vertices keep their numbers, whatever came and went.
#pragma once

#include "holdfast/types.h"
#include "untangle/tangle.h"

namespace holdfast {

struct Assembled {
  Volume volume;
  std::size_t moved = 0, added = 0, removed = 0;  ///< vertices
};

/// `before` is the volume that the tangle was made from; its facets, segments and markers go over. An added
/// vertex takes the number of a removed one where there is any; for numbers that are left between others, a
/// tetrahedron is split (the largest first, which is the `tangle`'s own change), so that no vertex becomes
/// unused.
[[nodiscard]] Assembled assemble(const Volume& before, Tangle& tangle);

}  // namespace holdfast
