// Where a file places a copy of what it describes once.
#pragma once

#include <array>

#include "holdfast/types.h"

namespace holdfast::io {

/// x' = x m[0] + y m[3] + z m[6] + m[9], and so on: the rows of 3MF's transforms.
struct Placement {
  std::array<double, 12> m = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};

  [[nodiscard]] static Placement moved_by(const Point& shift);
  /// Turned about an axis through `a`, seen against the unit vector `axis` counterclockwise. Right angles and
  /// axes along the coordinates are exact.
  [[nodiscard]] static Placement turned(const Point& a, const Point& axis, double degrees);

  [[nodiscard]] Point of(const Point& p) const;
  /// This placement of what `inner` has placed.
  [[nodiscard]] Placement after(const Placement& inner) const;
  /// Whether it turns what is seen from outside inside out.
  [[nodiscard]] bool mirrors() const;
  bool operator==(const Placement&) const = default;
};

}  // namespace holdfast::io
