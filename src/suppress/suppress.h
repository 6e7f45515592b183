// Suppresses Steiner points and gives the rest positions in doubles (paper §6.4; docs/concepts.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesh/monitor.h"
#include "mesh/tet_mesh.h"

namespace holdfast {

struct SuppressStats {
  std::size_t collapsed = 0;  ///< onto a neighbour
  std::size_t filled = 0;     ///< ball filled again without the point
  std::size_t merged = 0;     ///< with a neighbour
  std::size_t left = 0;
  std::size_t unrounded = 0;  ///< left, at a position that no double holds
};

/// Tries to remove each of `points`, cheapest way first, and recentres those that stay, round after round
/// until neither removes one nor rounds one. The mesh stays exactly positive throughout. The mesh's Steiner
/// points are its vertices from `first_free` on, strictly off every constraint; `points` are all of some
/// regions. `seed` is that of the random orders.
SuppressStats suppress(TetMesh& mesh, std::vector<Vertex> points, Vertex first_free, Monitor& monitor,
                       std::uint64_t seed = 1);

}  // namespace holdfast
