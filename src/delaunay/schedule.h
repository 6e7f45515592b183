// Inserts all points of a triangulation, on one or several threads.
#pragma once

#include <cstdint>
#include <functional>

#include "delaunay/triangulation.h"
#include "mesh/parallel.h"

namespace holdfast {

/// Called from the calling thread now and then with the fraction that is done; may throw.
using InsertionProgress = std::function<void(double fraction)>;

/// Inserts all points but the first four, which start() has inserted. What comes out depends on the numbering
/// of the vertices alone, but for the order of the cells.
void insert_all(Triangulation& triangulation, std::uint64_t seed, const Threads& threads,
                const InsertionProgress& progress);

}  // namespace holdfast
