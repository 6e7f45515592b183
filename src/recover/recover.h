// Recovery by flips: missing segments, then missing facets, without new points (paper §4; design §2.3).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "mesh/monitor.h"
#include "mesh/tet_mesh.h"
#include "recover/standing.h"
#include "surface/complex.h"

namespace holdfast {

struct FlipStats {
  std::size_t missing_segments = 0, missing_facets = 0;      ///< before
  std::size_t recovered_segments = 0, recovered_facets = 0;  ///< standing now that did not before
  std::size_t face_flips = 0, edge_removals = 0;             ///< that were carried out
};

/// Flips until no missing constraint can be recovered within a limit of work for each. What comes to stand
/// gets its bits and its flag in `standing`, and no flip ever removes what stands.
///
/// The mesh's vertices are those of the complex, strictly inside its hull, besides others that lie on no
/// constraint; `standing` is what mark_present found. Throws Interrupted through the monitor; the mesh and
/// `standing` are then as far as the work had come.
FlipStats recover_by_flips(TetMesh& mesh, const SegmentTable& table, std::span<const Triangle> facets,
                           Standing& standing, std::uint64_t seed, Monitor& monitor);

}  // namespace holdfast
