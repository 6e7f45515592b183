// Holdfast: elements of second order, with a node in the middle of each edge.
#pragma once

#include <functional>

#include "holdfast/export.h"
#include "holdfast/limits.h"
#include "holdfast/types.h"

namespace holdfast {

/// Gives each edge of a volume's tetrahedra, facets and segments a node in its middle, rounded to doubles
/// (`Volume::mid_nodes`); nodes that are there already are replaced. Nodes are numbered as edges come in the
/// tetrahedra, then in what else the volume has. Throws std::out_of_range for indices of no vertex,
/// std::length_error where nodes are beyond 32 bits, and Interrupted for its limits.
HOLDFAST_API void add_mid_nodes(Volume& volume, const Limits& limits = {});

}  // namespace holdfast
