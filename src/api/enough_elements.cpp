#include "api/enough_elements.h"

#include <algorithm>
#include <utility>

#include "numbers/elementary.h"

namespace holdfast {
namespace {

// Shares of the number of regular elements.
constexpr double kEnough = 0.65, kMany = 1.1;
constexpr double kOfUniform = 0.8;
constexpr double kLeastFactor = 0.5;
constexpr double kLeastScale = 0.25;  // where facets may need half as much
constexpr unsigned kMostTries = 4;
constexpr double kCostly = 100'000, kLeastCostlyStep = 0.65;

}  // namespace

bool are_too_few_elements(std::span<const double> elements, std::span<const double> asked) {
  return !std::equal(elements.begin(), elements.end(), asked.begin(),
                     [](double e, double a) { return e >= kEnough * a; });
}

SizesForEnough::SizesForEnough(std::vector<double> asked)
    : asked_(std::move(asked)),
      scales_(asked_.size(), 1),
      too_large_(asked_.size(), {1, 0}),
      too_small_(asked_.size(), {0, 0}) {}

std::vector<double> SizesForEnough::factors() const {
  std::vector<double> factors(scales_);
  for (double& f : factors) f = std::max(f, kLeastFactor);
  return factors;
}

double SizesForEnough::part_of_most_need() const {
  double part = 1;
  for (const double s : scales_) part = std::min(part, s / kLeastFactor);
  return part;
}

bool SizesForEnough::goes_on(std::span<const double> made) {
  if (tries_ > kMostTries) return false;
  const bool is_last = tries_++ == kMostTries;
  bool changes = false;
  for (std::size_t r = 0; r < scales_.size(); ++r) {
    const double scale = is_last ? last(r, made[r]) : next(r, made[r]);
    changes |= scale != scales_[r];
    scales_[r] = scale;
  }
  return changes;
}

// If no better scale was found, too many elements are better than too few.
double SizesForEnough::last(std::size_t region, double made) const {
  const bool are_few = made < kNearlyEnough * asked_[region];
  return are_few && too_small_[region].scale > 0 ? too_small_[region].scale : scales_[region];
}

// At the user's own size, any greater number is accepted.
double SizesForEnough::next(std::size_t region, double made) {
  const double scale = scales_[region], asked = asked_[region];
  const bool is_own = scale == 1;
  if (made >= (is_own ? kEnough : kNearlyEnough) * asked && (is_own || made <= kMany * asked)) return scale;
  if (made > kMany * asked) {
    too_small_[region] = {scale, made};
    return between(region);
  }
  too_large_[region] = {scale, made};
  const double least = scale > kLeastFactor ? kLeastFactor : kLeastScale;
  // A filling with too many elements takes the longest.
  const double least_step = asked > kCostly ? kLeastCostlyStep : 0;
  const double step = std::max(least_step, numbers::cbrt(made / (kEnough * asked)));
  const double wanted = std::max(least, scale * step);
  return wanted > too_small_[region].scale ? wanted : between(region);
}

// The number of elements jumps where walls begin to get points. Between two scales it is taken to be linear
// in the density of the points.
double SizesForEnough::between(std::size_t region) const {
  constexpr double kNearAnEnd = 0.15;
  const auto density = [](double scale) { return 1 / (scale * scale * scale); };
  const Try &large = too_large_[region], &small = too_small_[region];
  const double part = std::clamp((kOfUniform * asked_[region] - large.made) / (small.made - large.made),
                                 kNearAnEnd, 1 - kNearAnEnd);
  return 1 / numbers::cbrt(density(large.scale) + part * (density(small.scale) - density(large.scale)));
}

}  // namespace holdfast
