// Counts the rounds of cutting and rounding in the report.
#pragma once

#include "arrange/arrange.h"
#include "holdfast/repair.h"

namespace holdfast::repairing {

/// The sizes of an arrangement.
struct RoundSizes {
  explicit RoundSizes(const arrange::Arrangement& arrangement)
      : pairs(arrangement.pairs), sheets(arrangement.sheets), points(arrangement.nearest.size()) {}
  std::size_t pairs, sheets, points;
};

/// Adds a round.
inline void tell_round(RepairReport& report, const RoundSizes& sizes) {
  if (++report.rounds == 1) {
    report.pairs = sizes.pairs;
    report.sheets = sizes.sheets;
    report.points = sizes.points;
    if (sizes.points > 0) report.rung = Rung::nearest;
  } else if (report.rung < Rung::again) {
    report.rung = Rung::again;
  }
}

}  // namespace holdfast::repairing
