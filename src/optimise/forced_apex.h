// Whether a facet forces the shape of an element.
#pragma once

#include "mesh/parallel.h"
#include "mesh/tet_mesh.h"
#include "optimise/agenda.h"

namespace holdfast {

/// Whether, for each facet of the element, some vertex of the mesh, visible from the facet or not, makes a
/// better element on the facet. Otherwise no exchange improves the element.
[[nodiscard]] bool may_be_better(const TetMesh& mesh, const WaitingElement& e, const Threads& threads);

}  // namespace holdfast
