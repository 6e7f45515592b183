// The steps of a call from a valid complex to a mesh of its regions (paper §3 to §6): a Delaunay mesh in a
// box, the facets and segments in it, and which of its tetrahedra are inside.
#pragma once

#include <cstdint>

#include "api/input.h"
#include "classify/keep.h"
#include "classify/regions.h"
#include "enforce/enforce.h"
#include "holdfast/holdfast.h"
#include "mesh/monitor.h"
#include "mesh/parallel.h"
#include "mesh/tet_mesh.h"
#include "optimise/optimise.h"
#include "recover/standing.h"

namespace holdfast {

/// What the steps of one attempt are given.
struct Attempt {
  Input& input;
  const Options& options;
  std::uint64_t seed;  ///< of all random orders
  const Threads& threads;
  Monitor& monitor;
  const FillAnew* fill_anew;  ///< null: the optimisation fills no polyhedron anew

  [[nodiscard]] const Complex& complex() const { return input.complex(); }
  [[nodiscard]] Stage last_stage() const { return options.stop_after.value_or(Stage::optimise); }
};

/// The complex times 2^scale in the middle of a box. Its vertices come first, then the corners of the box.
struct BoxMesh {
  TetMesh mesh;
  Standing standing;  ///< which facets and segments the mesh has
  int scale = 0;
  Vertex first_free = 0;    ///< after the vertices of the complex and of the box
  ConstraintPieces pieces;  ///< if the run ends after partition

  [[nodiscard]] Report::Missing missing() const {
    return {standing.missing_segments(), standing.missing_facets()};
  }
};

/// Into which regions the facets divide a mesh, and which of them are kept.
struct Division {
  Regions regions;
  Kept kept;

  [[nodiscard]] bool has(const TetMesh& mesh, Tet t) const {
    return mesh.alive(t) && !mesh.is_ghost(t) && kept.region[regions.of_tet[t]];
  }
  [[nodiscard]] std::vector<Tet> tets(const TetMesh& mesh) const;
};

/// The Delaunay tetrahedra of the vertices and of a box round them (paper §3).
[[nodiscard]] BoxMesh delaunay_in_box(const Attempt& attempt);

/// Recovers facets and segments by flips alone (paper §4). Some may still be missing.
void recover_by_flips(const Attempt& attempt, BoxMesh& box);

/// Recovers all that is missing with Steiner points (paper §5, §6). What stands does not change if the points
/// stay on the constraints: these are in pieces then.
EnforceStats enforce_missing(const Attempt& attempt, BoxMesh& box);

/// Finds the regions and those to be kept. Only `kept.defects` counts if there are any.
[[nodiscard]] Division divide(const Attempt& attempt, BoxMesh& box);

/// Reports which regions were chosen, and warns of what may not have been meant.
void report_choice(const Attempt& attempt, BoxMesh& box, const Division& division, Result& result);

/// Takes Steiner points out of the kept regions (paper §6.4). Returns how many are left there. Points outside
/// go with their tetrahedra.
std::size_t suppress_points(const Attempt& attempt, BoxMesh& box, Division& division);

}  // namespace holdfast
