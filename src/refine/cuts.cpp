#include "refine/cuts.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "refine/tuning.h"

namespace holdfast {
namespace {

// The samples along one axis, and a plane across it with `below` samples on its lower side and samples of
// total weight `close` near it.
struct Split {
  std::vector<Cuts::Sample> samples;
  Cuts::Plane plane{0, 0};
  std::size_t below = 0;
  double close = std::numeric_limits<double>::infinity();
};

// Of the planes that leave one of these shares of the weight on their lower side, the one with the least
// weight near it.
Split split_across(std::size_t axis, std::span<const Cuts::Sample> samples, std::span<const double> shares,
                   double margin) {
  Split best{{samples.begin(), samples.end()}, {axis, 0}};
  std::stable_sort(best.samples.begin(), best.samples.end(),
                   [&](const Cuts::Sample& x, const Cuts::Sample& y) { return x.at[axis] < y.at[axis]; });
  std::vector<double> sums{0};  // sum of the weights before each sample
  for (const Cuts::Sample& s : best.samples) sums.push_back(sums.back() + s.weight);
  const auto weight_below = [&](double at) {
    const auto end = std::partition_point(best.samples.begin(), best.samples.end(),
                                          [&](const Cuts::Sample& s) { return s.at[axis] < at; });
    return sums[static_cast<std::size_t>(end - best.samples.begin())];
  };
  for (const double share : shares) {
    const auto end = std::upper_bound(sums.begin() + 1, sums.end(), share * sums.back());
    const auto below = static_cast<std::size_t>(end - sums.begin() - 1);
    const double at = below < samples.size() ? best.samples[below].at[axis] : 0;
    const double close = weight_below(at + margin) - weight_below(at - margin);
    if (close >= best.close) continue;
    best.plane.at = at;
    best.below = below;
    best.close = close;
  }
  return best;
}

double longest_extent(std::span<const Cuts::Sample> samples) {
  double longest = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Cuts::Sample& s : samples) {
      low = std::min(low, s.at[axis]);
      high = std::max(high, s.at[axis]);
    }
    longest = std::max(longest, high - low);
  }
  return longest;
}

}  // namespace

Cuts::Cuts(std::vector<Sample> samples, int levels, double least_share)
    : planes_((std::size_t{1} << levels) - 1) {
  if (planes_.empty()) return;
  std::vector<double> shares{0.5};
  for (int k = 1; 0.5 - k * tuning::kShareStep > least_share - tuning::kShareStep / 2; ++k)
    shares.insert(shares.end(), {0.5 - k * tuning::kShareStep, 0.5 + k * tuning::kShareStep});
  cut(samples, 0, shares);
}

void Cuts::cut(std::span<Sample> samples, std::size_t node, std::span<const double> shares) {
  const double margin = tuning::kCloseToPlane * longest_extent(samples);
  Split best = split_across(0, samples, shares, margin);
  for (std::size_t axis = 1; axis < 3; ++axis)
    if (Split split = split_across(axis, samples, shares, margin); split.close < best.close)
      best = std::move(split);
  planes_[node] = best.plane;
  if (2 * node + 2 >= planes_.size()) return;
  std::copy(best.samples.begin(), best.samples.end(), samples.begin());
  cut(samples.first(best.below), 2 * node + 1, shares);
  cut(samples.subspan(best.below), 2 * node + 2, shares);
}

std::uint32_t Cuts::part_of(const Point& p) const {
  std::size_t node = 0;
  while (node < planes_.size()) node = 2 * node + (p[planes_[node].axis] < planes_[node].at ? 1 : 2);
  return static_cast<std::uint32_t>(node - planes_.size());
}

int levels_for(double tets, double worth_cutting) {
  int levels = 0;
  for (double least = worth_cutting; tets > least && levels < tuning::kMostLevels; least *= 4) ++levels;
  return levels;
}

}  // namespace holdfast
