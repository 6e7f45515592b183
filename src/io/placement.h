// The transform by which a file places a copy of an object.
#pragma once

#include <array>

#include "holdfast/types.h"

namespace holdfast::io {

/// x' = x m[0] + y m[3] + z m[6] + m[9], and so on: the rows of 3MF's transforms.
struct Placement {
  std::array<double, 12> m = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};

  [[nodiscard]] static Placement moved_by(const Point& shift);
  /// A rotation about an axis through `a`, counterclockwise as seen against the unit vector `axis`. Exact for
  /// right angles and axes along the coordinates.
  [[nodiscard]] static Placement turned(const Point& a, const Point& axis, double degrees);

  [[nodiscard]] Point of(const Point& p) const;
  /// This placement applied after `inner`.
  [[nodiscard]] Placement after(const Placement& inner) const;
  /// Whether the placement is a reflection, which turns surfaces inside out.
  [[nodiscard]] bool mirrors() const;
  bool operator==(const Placement&) const = default;
};

}  // namespace holdfast::io
