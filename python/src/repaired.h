// A repair as Python holds it.
#pragma once

#include "holdfast/repair.h"

namespace holdfast::python {

/// A repair with its options, which a check of it needs.
struct Repair {
  RepairResult result;
  RepairOptions options;
};

}  // namespace holdfast::python
