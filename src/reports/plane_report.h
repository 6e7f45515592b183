// The report of `holdfast plane`.
#pragma once

#include "holdfast/plane.h"
#include "reports.h"

namespace holdfast::reports {

/// `options` is what the user asked for; `stopped`: with what stands after the stage where the run ended.
[[nodiscard]] Json to_json(const PlaneResult& result, Json options, bool stopped);

[[nodiscard]] std::size_t points_of(const PlaneMesh& mesh);

}  // namespace holdfast::reports
