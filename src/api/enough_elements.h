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

/// The part of regular elements that is nearly enough: no smaller size is tried, and as many remain when
/// points that do not pay are removed.
inline constexpr double kNearlyEnough = 0.58;

/// Whether the numbers of elements by region may be too small. `asked` is the result of `regular_elements`.
[[nodiscard]] bool are_too_few_elements(std::span<const double> elements, std::span<const double> asked);

/// Searches sizes of regions that give enough elements, guided by the results of earlier ones.
class SizesForEnough {
 public:
  explicit SizesForEnough(std::vector<double> asked);

  /// By region, the factor for the user's size: 1 at first.
  [[nodiscard]] std::vector<double> factors() const;
  /// The part of what large facets may need: 1 until some region has the least factor.
  [[nodiscard]] double part_of_most_need() const;
  /// Records the elements by region that these factors gave. Returns whether other factors remain to try.
  bool goes_on(std::span<const double> made);

 private:
  struct Try {
    double scale, made;
  };
  [[nodiscard]] double next(std::size_t region, double made);
  [[nodiscard]] double last(std::size_t region, double made) const;
  [[nodiscard]] double between(std::size_t region) const;

  // Scales by region: down to the least factor for the size, then the part of what facets may need as well.
  std::vector<double> asked_, scales_;
  std::vector<Try> too_large_, too_small_;  // as far as known
  unsigned tries_ = 0;
};

}  // namespace holdfast
