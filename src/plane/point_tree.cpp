// Points of which those in a triangle are asked for.
#include "plane/point_tree.h"

#include "plane/order.h"

namespace holdfast::plane {

PointTree::PointTree(const Points& points, std::span<const Vertex> vertices) : points_(points) {
  if (vertices.empty()) return;
  std::vector<Position> positions;
  positions.reserve(vertices.size());
  for (const Vertex v : vertices) positions.push_back(points[v]);
  order_ = curve_order(positions);
  place_.resize(order_.size());
  at_.reserve(order_.size());
  for (std::uint32_t i = 0; i < order_.size(); ++i) {
    place_[order_[i]] = i;
    at_.push_back(positions[order_[i]]);
  }
  standing_.assign(order_.size(), 1);

  const auto add = [](Node& node, const Box& box, std::uint32_t items) {
    for (std::size_t k = 0; k < 2; ++k) {
      node.box.low[k] = node.left == 0 ? box.low[k] : std::min(node.box.low[k], box.low[k]);
      node.box.high[k] = node.left == 0 ? box.high[k] : std::max(node.box.high[k], box.high[k]);
    }
    node.left += items;
  };
  std::vector<Node> nodes((at_.size() + kFan - 1) / kFan);
  for (std::size_t i = 0; i < at_.size(); ++i) add(nodes[i / kFan], {at_[i], at_[i]}, 1);
  while (nodes.size() > kFan) {
    std::vector<Node> above((nodes.size() + kFan - 1) / kFan);
    for (std::size_t i = 0; i < nodes.size(); ++i) add(above[i / kFan], nodes[i].box, nodes[i].left);
    levels_.push_back(std::move(nodes));
    nodes = std::move(above);
  }
  levels_.push_back(std::move(nodes));
}

void PointTree::erase(std::uint32_t item) {
  std::size_t i = place_[item];
  if (standing_[i] == 0) return;
  standing_[i] = 0;
  for (std::vector<Node>& nodes : levels_) --nodes[i /= kFan].left;
}

PointTree::Query::Query(const Points& points, Vertex a, Vertex b, Vertex c)
    : corners_{points[a], points[b], points[c]}, certain_(points.all_explicit()) {
  const auto& [p, q, r] = corners_;
  for (std::size_t k = 0; k < 2; ++k) {
    box_.low[k] = std::min({p[k], q[k], r[k]});
    box_.high[k] = std::max({p[k], q[k], r[k]});
  }
}

}  // namespace holdfast::plane
