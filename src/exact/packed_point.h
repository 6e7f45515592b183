// A SpacePoint in the memory that its numbers need: a third of it for the crossing of three planes, as a
// rule.
#pragma once

#include <memory>

#include "exact/space_point.h"

namespace holdfast::exact {

class PackedPoint {
 public:
  explicit PackedPoint(const SpacePoint& p);
  [[nodiscard]] SpacePoint point() const;

 private:
  /// The sizes of x, y, z and w, with a bit for the sign; then their limbs, the least significant one first.
  std::unique_ptr<Limb[]> limbs_;
};

}  // namespace holdfast::exact
