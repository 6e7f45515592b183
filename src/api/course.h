// How far a call has come: what its steps usually cost, beside each other.
#pragma once

#include <array>
#include <cstddef>

#include "holdfast/holdfast.h"

namespace holdfast {

/// The steps of a call in order: stages, but that validation goes on after Delaunay and that the volume is
/// taken out of the mesh in the end.
enum class CallStep : std::size_t {
  validate,
  delaunay,
  validate_missing,
  flips,
  partition,
  classify,
  suppress,
  field_points,
  optimise,
  deliver
};

/// The part of the whole call that a step is, where so much was done when it began: of what is left, as much
/// as it usually takes beside the steps after it. So another attempt goes on from where the last one ended,
/// and progress never goes back.
[[nodiscard]] std::array<double, 2> part_of_call(CallStep step, double done, const Options& options);

}  // namespace holdfast
