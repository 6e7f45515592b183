// The steps from a valid complex to a mesh of its regions (paper §3 to §6): a Delaunay mesh in a box, its
// recovered facets and segments, and which of its tetrahedra are inside.
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

/// The input of the steps of one attempt.
struct Attempt {
  Input& input;
  const Options& options;
  std::uint64_t seed;  ///< for all random orders
  const Threads& threads;
  Monitor& monitor;
  const FillAnew* fill_anew;  ///< null: the optimisation fills no polyhedra again

  [[nodiscard]] const Complex& complex() const { return input.complex(); }
  [[nodiscard]] NamedComplex named_complex() const { return {input.complex(), input.table(), input.names()}; }
  [[nodiscard]] Stage last_stage() const { return options.stop_after.value_or(Stage::optimise); }
};

/// The complex times 2^scale in the middle of a box. Its vertices come first, then the corners of the box.
struct BoxMesh {
  TetMesh mesh;
  Standing standing;  ///< the facets and segments that exist in the mesh
  int scale = 0;
  Vertex first_free = 0;    ///< the first vertex after those of the complex and of the box
  ConstraintPieces pieces;  ///< if the run ends after partition

  [[nodiscard]] Report::Missing missing() const {
    return {standing.missing_segments(), standing.missing_facets()};
  }
};

/// The regions into which the facets divide a mesh, and which of them are kept.
struct Division {
  Regions regions;
  Kept kept;

  [[nodiscard]] bool has(const TetMesh& mesh, Tet t) const {
    return mesh.alive(t) && !mesh.is_ghost(t) && kept.region[regions.of_tet[t]];
  }
  [[nodiscard]] std::vector<Tet> tets(const TetMesh& mesh) const;
};

/// The Delaunay tetrahedra of the vertices and the corners of a box around them (paper §5.1).
[[nodiscard]] BoxMesh delaunay_in_box(const Attempt& attempt);

/// Recovers facets and segments by flips alone (paper §4). Some may still be missing.
void recover_by_flips(const Attempt& attempt, BoxMesh& box);

/// Recovers everything missing with Steiner points (paper §5, §6). Constraints that exist do not change, but
/// if the points stay, the recovered ones are in pieces.
EnforceStats enforce_missing(const Attempt& attempt, BoxMesh& box);

/// Finds the regions and those to keep. If `kept.defects` is not empty, nothing else counts.
[[nodiscard]] Division divide(const Attempt& attempt, BoxMesh& box);

/// Reports which regions were chosen, and warns of a choice that may be unintended.
void report_choice(const Attempt& attempt, BoxMesh& box, const Division& division, Result& result);

/// Removes Steiner points from the kept regions (paper §6.4). Returns how many are left there. Points outside
/// disappear with their tetrahedra.
std::size_t suppress_points(const Attempt& attempt, BoxMesh& box, Division& division);

}  // namespace holdfast
