// The ways to improve an element by energy, from the cheapest to the most expensive (paper §6.4).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "optimise/add_point.h"
#include "optimise/contract.h"
#include "optimise/exchange_for_energy.h"
#include "optimise/improve.h"
#include "optimise/refill.h"
#include "optimise/smooth.h"
#include "optimise/volume.h"

namespace holdfast {

/// Each changes the volume only where the sum of the energies falls.
class EnergyWays {
 public:
  /// Elements worse than one whose least angle has the sine `very_bad` are worth patience.
  EnergyWays(ImprovedVolume& volume, double very_bad);

  /// Improved elements, and the way that made them.
  struct Outcome {
    std::span<const Tet> changed;  // until the next call; none where no way helped
    std::size_t ImproveStats::*count = nullptr;
  };
  enum class Patience : std::uint8_t { usual, contractions, all_ways };
  /// Tries one way after the other on an element until one helps, usually without the ways that seldom help
  /// for their cost. Adds to `work`, in elements tried.
  Outcome try_all(Tet t, Patience patience, double& work);

  /// From now on, whether points may be added.
  void allow_points(bool may) { may_add_ = may; }
  /// From now on, whether points for single elements must pay (add_point.h).
  void points_must_pay(bool must) { adder_.must_pay(must); }

  /// One way alone, for passes over the volume: whether it helped.
  bool swap_as_worst(Tet t) {
    volume_.turn_to(t);
    return !swapper_.improve(t, true).empty();
  }
  bool smooth(Vertex v) { return smoother_.smooth(v, false); }

 private:
  struct Way;
  [[nodiscard]] bool is_very_bad(Tet t) const {
    return volume_.energy(t) > volume_.energy_of_sine(very_bad_);
  }
  void swap(Tet t, Outcome& out, double& work);
  void smooth_a_corner(Tet t, Outcome& out, double& work);
  void contract_a_corner(Tet t, Outcome& out, double& work);
  void add_point(Tet t, Outcome& out, double& work);
  void refill(Tet t, Outcome& out, double& work);

  ImprovedVolume& volume_;
  const double very_bad_;
  bool may_add_ = true;
  VertexSmoother smoother_;
  EnergySwapper swapper_;
  VertexContractor contractor_;
  PointAdder adder_;
  CavityRefiller refiller_;
};

}  // namespace holdfast
