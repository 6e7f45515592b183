// Fillings of polyhedra as optional work: together they take at most half of the time that is left, and what
// ends one early leaves the mesh as it is.
#pragma once

#include <optional>

#include "api/fillings.h"

namespace holdfast {

class OptionalFillings {
 public:
  /// The arguments must outlive it. Errors become warnings of `result`.
  OptionalFillings(Limits& limits, Monitor& monitor, const Threads& threads, Result& result)
      : limits_(limits), result_(result), fillings_(limits, monitor, threads) {}

  /// As Fillings::fill; also returns nullopt if the time ends or an error occurs.
  [[nodiscard]] std::optional<Filling> fill(const ToFill& asked, const LikelyToFill& likely);

 private:
  Limits& limits_;
  Result& result_;
  std::optional<double> end_;  // time limit for all fillings, set by the first
  Fillings fillings_;
};

}  // namespace holdfast
