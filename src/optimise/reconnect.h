// Small polyhedron reconnection for quality: the tetrahedra round a bad one filled again, better
// (Marot, Remacle 2020, "Quality tetrahedral mesh generation with HXT").
#pragma once

#include <random>
#include <vector>

#include "mesh/tet_mesh.h"
#include "optimise/badness.h"

namespace holdfast {

/// Grows a cavity from a tetrahedron until it can be filled with tetrahedra that are all better than the
/// worst that go. Steiner points (the vertices from `first_free` on) that the cavity swallows go with them.
/// For a flat one more is tried, and much more if `patient`. `created` receives the new
/// tetrahedra. Returns whether there are any.
bool reconnect(TetMesh& mesh, Tet t, Vertex first_free, const BadFrom& bad_from, bool patient,
               std::mt19937_64& random, std::vector<Tet>& created);

}  // namespace holdfast
