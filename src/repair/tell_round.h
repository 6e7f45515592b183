// Counts the rounds of cutting and rounding in the report.
#pragma once

#include "arrange/arrange.h"
#include "holdfast/repair.h"

namespace holdfast::repairing {

/// Adds a round, with its arrangement.
inline void tell_round(RepairReport& report, const arrange::Arrangement& arrangement) {
  if (++report.rounds == 1) {
    report.pairs = arrangement.pairs;
    report.sheets = arrangement.sheets;
    report.points = arrangement.points.size();
    if (!arrangement.points.empty()) report.rung = Rung::nearest;
  } else if (report.rung < Rung::again) {
    report.rung = Rung::again;
  }
}

}  // namespace holdfast::repairing
