// The report of `holdfast plane`.
#pragma once

#include <optional>

#include "holdfast/plane_repair.h"
#include "reports.h"

namespace holdfast::reports {

/// `options`: what the user asked for. `stopped`: also reports the intermediate state after the stage where
/// the run ended. `repaired`: what a repair before it did.
[[nodiscard]] Json to_json(const PlaneResult& result, Json options, bool stopped,
                           const std::optional<PlaneRepairReport>& repaired = std::nullopt);

[[nodiscard]] std::size_t points_of(const PlaneMesh& mesh);

}  // namespace holdfast::reports
