#include "refine/cuts.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace holdfast {
namespace {

// Along one axis: the samples in their order, where half of the weight is on each side, and the weight there.
struct Halves {
  std::vector<Cuts::Sample> samples;
  Cuts::Plane plane{0, 0};
  std::size_t below = 0;
  double close = 0;
};

Halves halves(std::span<const Cuts::Sample> samples, std::size_t axis, double margin) {
  Halves half{{samples.begin(), samples.end()}, {axis, 0}};
  std::sort(half.samples.begin(), half.samples.end(),
            [&](const Cuts::Sample& x, const Cuts::Sample& y) { return x.at[axis] < y.at[axis]; });
  double total = 0, sum = 0;
  for (const Cuts::Sample& s : half.samples) total += s.weight;
  while (half.below < samples.size() && sum + half.samples[half.below].weight <= 0.5 * total)
    sum += half.samples[half.below++].weight;
  if (half.below < samples.size()) half.plane.at = half.samples[half.below].at[axis];
  for (const Cuts::Sample& s : half.samples)
    if (std::abs(s.at[axis] - half.plane.at) <= margin) half.close += s.weight;
  return half;
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

Cuts::Cuts(std::vector<Sample> samples, int levels) : planes_((std::size_t{1} << levels) - 1) {
  if (!planes_.empty()) cut(samples, 0);
}

void Cuts::cut(std::span<Sample> samples, std::size_t node) {
  constexpr double kClose = 0.02;  // of the longest extent
  const double margin = kClose * longest_extent(samples);
  Halves best = halves(samples, 0, margin);
  for (std::size_t axis = 1; axis < 3; ++axis)
    if (Halves half = halves(samples, axis, margin); half.close < best.close) best = std::move(half);
  planes_[node] = best.plane;
  if (2 * node + 2 >= planes_.size()) return;
  std::copy(best.samples.begin(), best.samples.end(), samples.begin());
  cut(samples.first(best.below), 2 * node + 1);
  cut(samples.subspan(best.below), 2 * node + 2);
}

std::uint32_t Cuts::part_of(const Point& p) const {
  std::size_t node = 0;
  while (node < planes_.size()) node = 2 * node + (p[planes_[node].axis] < planes_[node].at ? 1 : 2);
  return static_cast<std::uint32_t>(node - planes_.size());
}

int levels_for(double tets) {
  constexpr double kWorthCutting = 60'000;
  constexpr int kMostLevels = 4;
  int levels = 0;
  for (double least = kWorthCutting; tets > least && levels < kMostLevels; least *= 4) ++levels;
  return levels;
}

}  // namespace holdfast
