// The report of `holdfast plane`.
#pragma once

#include "holdfast/plane.h"
#include "reports.h"

namespace holdfast::reports {

/// `options`: what the user asked for. `stopped`: also reports the intermediate state after the stage where
/// the run ended.
[[nodiscard]] Json to_json(const PlaneResult& result, Json options, bool stopped);

[[nodiscard]] std::size_t points_of(const PlaneMesh& mesh);

}  // namespace holdfast::reports
