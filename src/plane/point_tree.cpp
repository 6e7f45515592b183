// Points of which those in a triangle are asked for.
#include "plane/point_tree.h"

#include "plane/order.h"

namespace holdfast::plane {
namespace {

constexpr std::uint32_t kCells = 1u << 14;  // along an axis

std::vector<Position> positions_of(const Points& points, std::span<const Vertex> vertices) {
  std::vector<Position> positions;
  positions.reserve(vertices.size());
  for (const Vertex v : vertices) positions.push_back(points[v]);
  return positions;
}

}  // namespace

PointTree::PointTree(const Points& points, std::span<const Vertex> vertices) : points_(points) {
  if (vertices.empty()) return;
  const std::vector<Position> positions = positions_of(points, vertices);
  grid_ = Grid(positions, kCells);
  order_ = curve_order(positions);
  place_.resize(order_.size());
  at_.reserve(order_.size());
  for (std::uint32_t i = 0; i < order_.size(); ++i) {
    place_[order_[i]] = i;
    at_.push_back(positions[order_[i]]);
  }
  add_groups(at_.size(), [&](std::size_t i) { return Box{at_[i], at_[i]}; });
  while (groups_.back().size() > 1) add_level();
}

template <typename BoxOf>
void PointTree::add_groups(std::size_t count, BoxOf&& box_of) {
  std::vector<Group>& groups = groups_.emplace_back((count + kFan - 1) / kFan);
  for (std::size_t i = 0; i < groups.size() * kFan; ++i) {
    if (i < count) {
      const Box box = box_of(i);
      groups[i / kFan].set(i % kFan, cell(box.low), cell(box.high));
    } else {
      groups[i / kFan].clear(i % kFan);
    }
  }
}

/// Boxes over the groups of the level below.
void PointTree::add_level() {
  const std::size_t below = levels_.empty() ? at_.size() : levels_.back().size();
  std::vector<Node> nodes(groups_.back().size());
  for (std::size_t i = 0; i < below; ++i) {
    const Node part = levels_.empty() ? Node{{at_[i], at_[i]}, 1} : levels_.back()[i];
    Node& node = nodes[i / kFan];
    for (std::size_t k = 0; k < 2; ++k) {
      node.box.low[k] = node.left == 0 ? part.box.low[k] : std::min(node.box.low[k], part.box.low[k]);
      node.box.high[k] = node.left == 0 ? part.box.high[k] : std::max(node.box.high[k], part.box.high[k]);
    }
    node.left += part.left;
  }
  levels_.push_back(std::move(nodes));
  add_groups(levels_.back().size(), [&](std::size_t i) { return levels_.back()[i].box; });
}

void PointTree::erase(std::uint32_t item) {
  std::size_t i = place_[item];
  if (!groups_[0][i / kFan].stands(i % kFan)) return;
  groups_[0][i / kFan].clear(i % kFan);
  for (std::size_t level = 0; level < levels_.size(); ++level) {
    i /= kFan;
    if (--levels_[level][i].left == 0) groups_[level + 1][i / kFan].clear(i % kFan);
  }
}

PointTree::Query::Query(const PointTree& tree, Vertex a, Vertex b, Vertex c)
    : corners_{tree.points_[a], tree.points_[b], tree.points_[c]}, certain_(tree.points_.all_explicit()) {
  const auto& [p, q, r] = corners_;
  for (std::size_t k = 0; k < 2; ++k) {
    box_.low[k] = std::min({p[k], q[k], r[k]});
    box_.high[k] = std::max({p[k], q[k], r[k]});
  }
  const std::array<std::int16_t, 2> low = tree.cell(box_.low), high = tree.cell(box_.high);
  for (std::size_t k = 0; k < 2; ++k) {
    low_[k] = Lanes{} + low[k];
    high_[k] = Lanes{} + high[k];
  }
}

}  // namespace holdfast::plane
