// What a repaired surface is told as: markers of parents, and all that moved, went or became one.
#pragma once

#include "holdfast/repair.h"
#include "repair/rounding.h"

namespace holdfast::repairing {

/// Fills the surface, its parents and all lists of the result.
void deliver(const Complex& input, Rounded rounded, RepairResult& result);

}  // namespace holdfast::repairing
