// Fills the result of a repair: the markers of parents, and the lists of what was moved, dropped or merged.
#pragma once

#include "holdfast/repair.h"
#include "repair/rounding.h"

namespace holdfast::repairing {

/// Fills the surface, its parents and all lists of the result.
void deliver(const Complex& input, Rounded rounded, RepairResult& result);

}  // namespace holdfast::repairing
