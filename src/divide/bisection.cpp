#include "divide/bisection.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace holdfast::division {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double total(std::span<const Work> work) {
  double sum = 0;
  for (const Work& w : work) sum += w.amount;
  return sum;
}

/// The axis along which the places lie furthest apart: walls across it are smallest.
std::size_t longest_axis(std::span<const Work> work) {
  Point low = work[0].where, high = low;
  for (const Work& w : work)
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], w.where[k]);
      high[k] = std::max(high[k], w.where[k]);
    }
  std::size_t longest = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (high[k] - low[k] > high[longest] - low[longest]) longest = k;
  return longest;
}

}  // namespace

Bisection::Bisection(std::vector<Work> work, std::size_t cells) {
  const Box everywhere{{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}};
  build(work, everywhere, cells);
}

std::size_t Bisection::build(std::span<Work> work, const Box& box, std::size_t cells) {
  const std::size_t at = nodes_.size();
  nodes_.push_back({box});
  if (cells <= 1 || work.size() < 2) {
    nodes_[at].cell = cells_++;
    return at;
  }
  const std::size_t axis = longest_axis(work);
  std::sort(work.begin(), work.end(), [axis](const Work& a, const Work& b) {
    return a.where[axis] != b.where[axis] ? a.where[axis] < b.where[axis] : a.where < b.where;
  });
  const std::size_t cells_below = cells / 2;
  const double share = total(work) * static_cast<double>(cells_below) / static_cast<double>(cells);
  double sum = work[0].amount;
  std::size_t middle = 1;
  while (middle + 1 < work.size() && sum + work[middle].amount / 2 < share) sum += work[middle++].amount;
  const double wall =
      work[middle - 1].where[axis] + (work[middle].where[axis] - work[middle - 1].where[axis]) / 2;
  Box box_below = box, box_above = box;
  box_below.high[axis] = box_above.low[axis] = wall;
  const std::size_t below = build(work.first(middle), box_below, cells_below);
  const std::size_t above = build(work.subspan(middle), box_above, cells - cells_below);
  nodes_[at].axis = axis;
  nodes_[at].wall = wall;
  nodes_[at].below = below;
  nodes_[at].above = above;
  return at;
}

std::size_t Bisection::cell_of(const Point& p) const {
  std::size_t at = 0;
  while (nodes_[at].below != 0)
    at = p[nodes_[at].axis] < nodes_[at].wall ? nodes_[at].below : nodes_[at].above;
  return nodes_[at].cell;
}

double Bisection::distance_to_wall_of(const Node& node, const Point& p) {
  double squares = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double away =
        k == node.axis ? p[k] - node.wall : std::max({node.box.low[k] - p[k], p[k] - node.box.high[k], 0.0});
    squares += away * away;
  }
  return std::sqrt(squares);
}

double Bisection::distance_to_wall(const Point& p) const {
  double least = kInfinity;
  std::vector<std::size_t> open{0};
  while (!open.empty()) {
    const Node& node = nodes_[open.back()];
    open.pop_back();
    if (node.below == 0) continue;
    least = std::min(least, distance_to_wall_of(node, p));
    const bool is_below = p[node.axis] < node.wall;
    if (std::abs(p[node.axis] - node.wall) < least) open.push_back(is_below ? node.above : node.below);
    open.push_back(is_below ? node.below : node.above);
  }
  return least;
}

}  // namespace holdfast::division
