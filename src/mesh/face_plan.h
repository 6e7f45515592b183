// The plan of a 2-3 flip: a face gives way to the edge through it.
//
//          d                 The face (f0 f1 f2) between the apexes d and e gives way to edge de, and its two
//        / | \               tetrahedra to (f0 f1 e d), (f1 f2 e d) and (f2 f0 e d). These are positive
//      f0--|--f2             exactly if de passes through the inside of the face.
//        \ f1 /
//          e
#pragma once

#include <array>

#include "mesh/change.h"

namespace holdfast {

class FacePlan {
 public:
  /// The face is no facet, and (f0 f1 f2) as seen from its apex d.
  FacePlan(const TetMesh& mesh, Face f);

  [[nodiscard]] Change change() const { return {old_tets_, new_tets_}; }

 private:
  std::array<Tet, 2> old_tets_;
  std::array<NewTet, 3> new_tets_;
};

}  // namespace holdfast
