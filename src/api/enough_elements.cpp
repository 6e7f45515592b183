#include "api/enough_elements.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "numbers/elementary.h"

namespace holdfast {
namespace {

// Shares of the number of regular elements. Uniform meshes have 0.8.
constexpr double kEnough = 0.65, kNearlyEnough = 0.58, kMany = 1.25;
constexpr double kLeastFactor = 0.5;
constexpr unsigned kMostTries = 3;

}  // namespace

bool are_too_few_elements(std::span<const double> elements, std::span<const double> asked) {
  return !std::equal(elements.begin(), elements.end(), asked.begin(),
                     [](double e, double a) { return e >= kEnough * a; });
}

SizesForEnough::SizesForEnough(std::vector<double> asked)
    : asked_(std::move(asked)),
      factors_(asked_.size(), 1),
      too_large_(asked_.size(), 1),
      too_small_(asked_.size(), 0) {}

bool SizesForEnough::goes_on(std::span<const double> made) {
  if (tries_ > kMostTries) return false;
  const bool is_last = tries_++ == kMostTries;
  bool changes = false;
  for (std::size_t r = 0; r < factors_.size(); ++r) {
    const double factor = is_last ? last(r, made[r]) : next(r, made[r]);
    changes |= factor != factors_[r];
    factors_[r] = factor;
  }
  return changes;
}

// If no better factor was found, too many elements are better than too few.
double SizesForEnough::last(std::size_t region, double made) const {
  const bool are_few = made < kNearlyEnough * asked_[region];
  return are_few && too_small_[region] > 0 ? too_small_[region] : factors_[region];
}

// The number of elements jumps where walls begin to get points; then a factor between two known ones is
// tried. At the user's own size, any greater number is accepted.
double SizesForEnough::next(std::size_t region, double made) {
  const double factor = factors_[region], asked = asked_[region];
  const bool is_own = factor == 1;
  if (made >= (is_own ? kEnough : kNearlyEnough) * asked && (is_own || made <= kMany * asked)) return factor;
  if (made > kMany * asked) {
    too_small_[region] = factor;
    return std::sqrt(factor * too_large_[region]);
  }
  too_large_[region] = factor;
  const double wanted = std::max(kLeastFactor, factor * numbers::cbrt(made / (kEnough * asked)));
  return wanted > too_small_[region] ? wanted : std::sqrt(too_small_[region] * factor);
}

}  // namespace holdfast
