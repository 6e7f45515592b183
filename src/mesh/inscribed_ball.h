// The largest ball inside an intersection of half-spaces: a linear programme in four variables.
#pragma once

#include <array>
#include <span>
#include <vector>

namespace holdfast {

/// The points y with n.y <= b, |n| = 1, b >= 0: the origin belongs to the closed half-space.
struct HalfSpace {
  std::array<double, 3> n{};
  double b = 0;
};

struct InscribedBall {
  std::array<double, 3> centre{};
  double radius = 0;
};

/// Maximises the least distance to the half-spaces' planes (simplex method, floating point: a guess that
/// the caller verifies exactly). Radius 0 when no ball was found or the set is unbounded.
[[nodiscard]] InscribedBall inscribed_ball(std::span<const HalfSpace> half_spaces);

}  // namespace holdfast
