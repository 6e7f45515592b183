// A tree of points that finds those in a triangle.
#include "plane/point_tree.h"

#include <algorithm>
#include <cmath>

#include "plane/order.h"

namespace holdfast::plane {
namespace {

constexpr std::uint32_t kCells = 1u << 14;  // along an axis

}  // namespace

PointTree::PointTree(const Points& points, std::span<const Vertex> vertices) : points_(points) {
  if (vertices.empty()) return;
  std::vector<Position> positions;
  positions.reserve(vertices.size());
  for (const Vertex v : vertices) positions.push_back(points[v]);
  grid_ = Grid(positions, kCells);
  order_ = curve_order(positions);
  place_.resize(order_.size());
  std::vector<Box> boxes;
  boxes.reserve(order_.size());
  for (std::uint32_t i = 0; i < order_.size(); ++i) {
    place_[order_[i]] = i;
    const Position at = grid_.place(positions[order_[i]]);
    boxes.push_back({{at, at}, 1});
  }
  add_groups(boxes);
  while (groups_.back().size() > 1) {
    boxes = boxes_over(boxes);
    add_groups(boxes);
    boxes_.push_back(boxes);
  }
}

/// One box over each eight boxes of a level.
std::vector<PointTree::Box> PointTree::boxes_over(const std::vector<Box>& parts) {
  std::vector<Box> boxes;
  boxes.reserve(parts.size() / kFan + 1);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i % kFan == 0) {
      boxes.push_back(parts[i]);
      continue;
    }
    Box& box = boxes.back();
    for (std::size_t axis = 0; axis < 2; ++axis) {
      box.at[kLow][axis] = std::min(box.at[kLow][axis], parts[i].at[kLow][axis]);
      box.at[kHigh][axis] = std::max(box.at[kHigh][axis], parts[i].at[kHigh][axis]);
    }
    box.left += parts[i].left;
  }
  return boxes;
}

void PointTree::add_groups(const std::vector<Box>& boxes) {
  std::vector<Group>& groups = groups_.emplace_back((boxes.size() + kFan - 1) / kFan);
  for (std::size_t i = 0; i < groups.size() * kFan; ++i) {
    if (i < boxes.size())
      groups[i / kFan].set(i % kFan, cell(boxes[i].at[kLow]), cell(boxes[i].at[kHigh]));
    else
      groups[i / kFan].clear(i % kFan);
  }
}

void PointTree::erase(std::uint32_t item) {
  std::size_t i = place_[item];
  if (!groups_[0][i / kFan].stands(i % kFan)) return;
  groups_[0][i / kFan].clear(i % kFan);
  for (std::size_t level = 0; level < boxes_.size(); ++level) {
    i /= kFan;
    if (--boxes_[level][i].left == 0) groups_[level + 1][i / kFan].clear(i % kFan);
  }
}

PointTree::Query::Query(const PointTree& tree, const std::array<Vertex, 3>& corners) : tree_(tree) {
  for (std::size_t i = 0; i < 3; ++i) corners_[i] = tree.grid_.place(tree.points_[corners[i]]);
  const auto& [p, q, r] = corners_;
  Position low, high;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    low[axis] = std::min(std::min(p[axis], q[axis]), r[axis]);
    high[axis] = std::max(std::max(p[axis], q[axis]), r[axis]);
  }
  const std::array<std::int16_t, 2> from = tree.cell(low), to = tree.cell(high);
  for (std::size_t axis = 0; axis < 2; ++axis) {
    low_[axis] = Lanes{} + from[axis];
    high_[axis] = Lanes{} + to[axis];
  }
}

void PointTree::Query::find_sides() {
  has_sides_ = true;
  // The doubles of exact points are not their positions.
  if (!tree_.points_.all_explicit()) return;
  for (std::size_t i = 0; i < 3; ++i) sides_[i] = side(corners_[i], corners_[i < 2 ? i + 1 : 0]);
}

/// A place (X, Y) lies to the right of pq if x X + y Y - (x px + y py) < 0 with (x, y) = (py - qy, qx - px).
/// Let M bound the places of corners and of the grid. Places err by 2^-51 M, so x and y err by 2^-49 M and
/// are at most 2 M; each of the four products errs by 2^-48 M M, sums by less, and the total by less than
/// 2^-45 M M.
PointTree::Query::Side PointTree::Query::side(const Position& p, const Position& q) {
  constexpr double kGrid = kCells, kError = 0x1p-45;
  const double most = std::max({kGrid, std::fabs(p[0]), std::fabs(p[1]), std::fabs(q[0]), std::fabs(q[1])});
  const double x = p[1] - q[1], y = q[0] - p[0];
  // If the bound overflows, nothing is less than it.
  return {x, y, x * p[0] + y * p[1] - kError * most * most, x > 0 ? kHigh : kLow, y > 0 ? kHigh : kLow};
}

}  // namespace holdfast::plane
