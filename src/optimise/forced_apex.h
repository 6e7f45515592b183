// Whether an element is as it is since a facet forces it.
#pragma once

#include "mesh/parallel.h"
#include "mesh/tet_mesh.h"
#include "optimise/agenda.h"

namespace holdfast {

/// Whether for each facet of the element some vertex of the mesh makes one on it that is better, be it that
/// it does not see the facet: unless one does, no exchange betters the element.
[[nodiscard]] bool may_be_better(const TetMesh& mesh, const WaitingElement& e, const Threads& threads);

}  // namespace holdfast
