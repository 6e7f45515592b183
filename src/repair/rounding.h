// The exact arrangement rounded to doubles so that it stays valid (docs/repairing.md).
#pragma once

#include "arrange/arrange.h"
#include "holdfast/repair.h"
#include "repair/state.h"

namespace holdfast::repairing {

struct Rounded {
  bool is_valid = false;
  State state;
  double displacement = 0;   ///< of points by rounding, all rounds added; rounded up
  bool has_united = false;   ///< facets went since: see RepairOptions::unite
  double joined_within = 0;  ///< less than RepairOptions::join if that multiplied the facets in vain
};

/// How much is tried.
enum class Trials {
  all,
  near_trouble,  ///< only steps near facets in trouble; no joining of sheets or vertices all over the surface
  little,        ///< no more than `near_trouble`, nothing that moves input vertices, and only near few facets
};

/// Arranges and rounds until nothing is left to arrange. Fills `report` and `exact`.
[[nodiscard]] Rounded round_arranged(State state, const RepairOptions& options, RepairReport& report,
                                     ExactSurface& exact, const Step& step, const Threads& threads,
                                     Trials trials = Trials::all);

}  // namespace holdfast::repairing
