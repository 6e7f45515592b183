// What a report says of the rounds of cutting and rounding.
#pragma once

#include "arrange/arrange.h"
#include "holdfast/repair.h"

namespace holdfast::repairing {

/// Tells one more round, whose arrangement this is.
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
