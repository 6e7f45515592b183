// Gives regions nearly as many elements as the user's sizes ask for.
//
// Next to triangles much larger than the size, elements stay large, and thin walls between such triangles get
// no points. On such surfaces a size gives far fewer elements than the volume needs at that size, and most of
// them are bad. Then the sizes of a region are reduced, which makes room for good elements
// (docs/decisions/as-many-elements-as-a-size-asks-for.md).
#pragma once

#include <span>
#include <vector>

namespace holdfast {

/// Whether the numbers of elements by region may be too small. `asked` is the result of `regular_elements`.
[[nodiscard]] bool are_too_few_elements(std::span<const double> elements, std::span<const double> asked);

/// Searches sizes of regions that give enough elements, guided by the results of earlier ones.
class SizesForEnough {
 public:
  explicit SizesForEnough(std::vector<double> asked);

  /// By region, the factor for the user's size: 1 at first.
  [[nodiscard]] const std::vector<double>& factors() const { return factors_; }
  /// Records the elements by region that these factors gave. Returns whether other factors remain to try.
  bool goes_on(std::span<const double> made);

 private:
  [[nodiscard]] double next(std::size_t region, double made);
  [[nodiscard]] double last(std::size_t region, double made) const;

  std::vector<double> asked_, factors_;
  std::vector<double> too_large_, too_small_;  // factors by region, as far as known
  unsigned tries_ = 0;
};

}  // namespace holdfast
