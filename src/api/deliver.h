// The last step of a call: the volume is extracted from the mesh, numbered and measured.
#pragma once

#include "api/boundary.h"
#include "api/interior.h"

namespace holdfast {

/// Fills a result with what the run has made: the kept regions from `Stage::classify` on, the whole box
/// before. `field` is null without field points. The outcome becomes `not_representable` if some vertex has
/// no doubles.
void deliver(const Attempt& attempt, const BoxMesh& box, const Division& division, Field* field,
             Result& result);

}  // namespace holdfast
