// The 2-3 flip: a face gives way to the edge through it.
//
//          d                 The face (f0 f1 f2) between the apexes d and e gives way to edge de, and its two
//        / | \               tetrahedra to (f0 f1 e d), (f1 f2 e d) and (f2 f0 e d). These are positive
//      f0--|--f2             exactly if de passes through the inside of the face.
//        \ f1 /
//          e
#pragma once

#include <array>

#include "mesh/tet_mesh.h"

namespace holdfast {

/// Makes the flip, whose new tetrahedra must be positive, and returns these: what `replace` would do
/// (replace.h), with all neighbours known. (f0 f1 f2) is `f` as seen from its apex d. The face is no facet.
std::array<Tet, 3> swap_face(TetMesh& mesh, Face f);

}  // namespace holdfast
