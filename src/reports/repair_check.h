// The report of a check of a repair.
#pragma once

#include "holdfast/check_repair.h"
#include "reports.h"

namespace holdfast::reports {

[[nodiscard]] Json to_json(const RepairCheckResult& result);

}  // namespace holdfast::reports
