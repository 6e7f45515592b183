// Makes the fillings of polyhedra that an optimisation asks for one by one on several threads: while one
// thread makes the requested filling, the others make those likely to be requested next.
#pragma once

#include <exception>
#include <optional>
#include <vector>

#include "holdfast/holdfast.h"
#include "mesh/monitor.h"
#include "mesh/parallel.h"
#include "optimise/optimise.h"

namespace holdfast {

/// A filling depends only on its polyhedron, so the time at which it is made does not matter.
class Fillings {
 public:
  /// The arguments must outlive it.
  Fillings(const Limits& limits, Monitor& monitor, const Threads& threads)
      : limits_(limits), monitor_(monitor), threads_(threads) {}

  /// As fill_polyhedron. On one thread, only requested fillings are made.
  [[nodiscard]] std::optional<Filling> fill(const ToFill& asked, const LikelyToFill& likely);

 private:
  struct Made {
    ToFill asked;
    std::optional<Filling> filling;
    std::exception_ptr error;  // thrown when the filling is requested
  };
  [[nodiscard]] std::vector<Made>::iterator find(const ToFill& asked);
  void make_with_likely(const ToFill& asked, const LikelyToFill& likely);

  const Limits& limits_;
  Monitor& monitor_;
  const Threads& threads_;
  std::vector<Made> made_;  // and not requested yet
};

}  // namespace holdfast
