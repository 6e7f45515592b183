// The fillings of polyhedra that an optimisation asks for one by one, made by several threads: while one
// thread makes the present filling, the others make those likely to be asked for next.
#pragma once

#include <exception>
#include <optional>
#include <vector>

#include "holdfast/holdfast.h"
#include "mesh/monitor.h"
#include "mesh/parallel.h"
#include "optimise/optimise.h"

namespace holdfast {

/// A filling depends only on its polyhedron, so it does not matter when it was made.
class Fillings {
 public:
  /// All of these must outlive it.
  Fillings(const Limits& limits, Monitor& monitor, const Threads& threads)
      : limits_(limits), monitor_(monitor), threads_(threads) {}

  /// As fill_polyhedron. On one thread, only requested fillings are made.
  [[nodiscard]] std::optional<Filling> fill(const ToFill& asked, const LikelyToFill& likely);

 private:
  struct Made {
    ToFill asked;
    std::optional<Filling> filling;
    std::exception_ptr error;  // for whoever asks
  };
  [[nodiscard]] std::vector<Made>::iterator find(const ToFill& asked);
  void make_with_likely(const ToFill& asked, const LikelyToFill& likely);

  const Limits& limits_;
  Monitor& monitor_;
  const Threads& threads_;
  std::vector<Made> made_;  // and not asked for yet
};

}  // namespace holdfast
