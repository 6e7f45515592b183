// The last step of a call: the volume is taken out of the mesh, numbered and measured.
#pragma once

#include "api/boundary.h"
#include "api/interior.h"

namespace holdfast {

/// Fills a result with what there is: the kept regions from `Stage::classify` on, all of the box before.
/// `field` is null without field points. The outcome becomes `not_representable` if some vertex has no
/// doubles.
void deliver(const Attempt& attempt, const BoxMesh& box, const Division& division, Field* field,
             Result& result);

}  // namespace holdfast
