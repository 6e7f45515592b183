// Whether a volume keeps the bounds that were asked for: looked at when all is done.
#pragma once

#include "holdfast/holdfast.h"
#include "mesh/parallel.h"

namespace holdfast {

/// Fills `Report::bounds` but for the points. A tetrahedron above its bound, decided exactly, makes the
/// outcome not_representable: it holds no point in doubles that would part it.
void judge_bounds(const Options& options, const Threads& threads, Result& result);

}  // namespace holdfast
