// Vertices that lie near to each other, or to a side or facet, joined within the user's tolerance.
#pragma once

#include <optional>

#include "repair/settle.h"
#include "repair/state.h"
#include "surface/search.h"

namespace holdfast::repairing {

/// `RepairOptions::weld`. Returns the largest distance by which anything moved or was bent, rounded up: less
/// than the tolerance, with room left for rounding where that is possible.
double weld(State& state, double tolerance, const Step& step);

/// The distance within which more than half of the vertices of the input that are in trouble have another one
/// of them at another place, as they do where a surface is there twice but for rounding, or its triangles
/// were written one by one. None where it is more than `widest`.
[[nodiscard]] std::optional<double> distance_of_twins(const State& state, const Trouble& trouble,
                                                      double widest, const Step& step);

}  // namespace holdfast::repairing
