// Checks at the end whether a volume keeps the requested bounds.
#pragma once

#include "holdfast/holdfast.h"
#include "mesh/parallel.h"

namespace holdfast {

/// Fills `Report::bounds` except the points. A tetrahedron above its bound, decided exactly, makes the
/// outcome not_representable: it contains no point in doubles that could divide it.
void judge_bounds(const Options& options, const Threads& threads, Result& result);

}  // namespace holdfast
