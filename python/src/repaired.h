// What a repair is to Python.
#pragma once

#include "holdfast/repair.h"

namespace holdfast::python {

/// A repair with what it was asked for, of which a check needs to know.
struct Repair {
  RepairResult result;
  RepairOptions options;
};

}  // namespace holdfast::python
