// Makes regions have nearly as many elements as the user's sizes ask for.
//
// Beside triangles that are much larger than the size elements stay large, and thin walls between such
// triangles get no points: on such surfaces a size gives far fewer elements than the volume takes of it, most
// of them bad ones. Then the sizes of a region are made smaller, and there is room for good ones beside those
// that the surface forces (docs/decisions/as-many-elements-as-a-size-asks-for.md).
#pragma once

#include <span>
#include <vector>

namespace holdfast {

/// Whether so many elements by region may be too few. `asked` are those of `regular_elements`.
[[nodiscard]] bool are_too_few_elements(std::span<const double> elements, std::span<const double> asked);

/// Looks for sizes of regions that give enough elements, by what others gave.
class SizesForEnough {
 public:
  explicit SizesForEnough(std::vector<double> asked);

  /// By region, what the user's size is multiplied by: 1 at first.
  [[nodiscard]] const std::vector<double>& factors() const { return factors_; }
  /// Records the elements by region that these factors gave. Returns whether other factors are left to try.
  bool goes_on(std::span<const double> made);

 private:
  [[nodiscard]] double next(std::size_t region, double made);
  [[nodiscard]] double last(std::size_t region, double made) const;

  std::vector<double> asked_, factors_;
  std::vector<double> too_large_, too_small_;  // factors by region, as far as known
  unsigned tries_ = 0;
};

}  // namespace holdfast
