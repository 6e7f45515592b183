// Joins vertices near each other, or near a side or facet, within the user's tolerance.
#pragma once

#include <optional>

#include "repair/settle.h"
#include "repair/state.h"
#include "surface/search.h"

namespace holdfast::repairing {

/// In last bits of the largest coordinate: hardly any mesh could be in what is thinner.
inline constexpr double kThinnest = 0x1p6;

/// `RepairOptions::weld`. Returns the largest distance by which anything moved or was bent, rounded up: less
/// than the tolerance, with room left for rounding where that is possible.
double weld(State& state, double tolerance, const Step& step, Touching touching = Touching::bends);
/// The same, not to the end if the work is spent.
double weld(State& state, double tolerance, Work& work, const Step& step,
            Touching touching = Touching::bends);

/// The distance within which more than this share of the input vertices in trouble have another of them at a
/// different place. Half of them do if a surface is duplicated up to rounding, or if its triangles were
/// written one by one. No value if the distance is more than `widest`.
[[nodiscard]] std::optional<double> distance_of_twins(const State& state, const Trouble& trouble,
                                                      double share, double widest, const Step& step);

}  // namespace holdfast::repairing
