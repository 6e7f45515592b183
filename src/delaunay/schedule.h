// Inserts all points of a triangulation, on one or several threads.
#pragma once

#include <cstdint>
#include <functional>

#include "delaunay/triangulation.h"
#include "mesh/parallel.h"

namespace holdfast {

/// Called from time to time from the calling thread with the fraction that is done; may throw.
using InsertionProgress = std::function<void(double fraction)>;

/// Inserts all points but the first four, which start() has inserted. Up to the order of the cells, the
/// result depends only on the numbering of the vertices.
void insert_all(Triangulation& triangulation, std::uint64_t seed, const Threads& threads,
                const InsertionProgress& progress);

}  // namespace holdfast
