// Surface layer: construction of the tree of boxes.
#include "surface/aabb_tree.h"

#include <algorithm>

#include "surface/complex.h"

namespace holdfast {

void Box::extend(const Box& other) {
  for (std::size_t k = 0; k < 3; ++k) {
    low[k] = std::min(low[k], other.low[k]);
    high[k] = std::max(high[k], other.high[k]);
  }
}

AabbTree::AabbTree(std::span<const Box> boxes, std::span<const Index> group) : group_(group) {
  if (boxes.empty()) return;
  items_.reserve(boxes.size());
  for (const Box& box : boxes) items_.push_back({box, static_cast<Index>(items_.size())});
  std::vector<char> seen;
  for (Index i = 0; i < group.size(); ++i) {
    const Index g = group[i];
    if (g == no_index) continue;
    if (g >= group_boxes_.size()) {
      group_boxes_.resize(g + std::size_t{1});
      seen.resize(g + std::size_t{1}, 0);
    }
    if (seen[g]) {
      group_boxes_[g].extend(boxes[i]);
    } else {
      group_boxes_[g] = boxes[i];
      seen[g] = 1;
    }
  }
  nodes_.reserve(boxes.size());
  nodes_.push_back({items_[0].box, 0, static_cast<Index>(boxes.size()), 0, group_boxes_.empty()});
  std::vector<Index> stack{0};
  while (!stack.empty()) {
    const Index node = stack.back();
    stack.pop_back();
    build(node);
    if (nodes_[node].left != 0) stack.insert(stack.end(), {nodes_[node].left + 1, nodes_[node].left});
  }
  group_ = {};
  group_boxes_.clear();
}

// Sets the node's box, and splits it if it holds more than a leaf may.
void AabbTree::build(Index node) {
  Node current = nodes_[node];
  current.box = items_[current.first].box;
  for (Index i = 1; i < current.count; ++i) current.box.extend(items_[current.first + i].box);
  if (current.count > kLeafItems) {
    const Index middle = partition(current);
    current.left = static_cast<Index>(nodes_.size());
    Node part = current;
    part.left = 0;
    part.count = middle - current.first;
    nodes_.push_back(part);
    part.first = middle;
    part.count = current.count - (middle - current.first);
    nodes_.push_back(part);
  }
  nodes_[node] = current;
}

double AabbTree::centre(const Node& node, const Item& item, std::size_t k) const {
  if (node.one_group || group_[item.id] == no_index) return item.box.centre(k);
  return group_boxes_[group_[item.id]].centre(k);
}

// Divides the node's items along the longest axis of their centres' box; returns the second part's first.
Index AabbTree::partition(Node& node) {
  const auto begin = items_.begin() + node.first, end = begin + node.count;
  Box centres;
  const auto bound_centres = [&] {
    for (std::size_t k = 0; k < 3; ++k) centres.low[k] = centres.high[k] = centre(node, *begin, k);
    for (auto item = begin; item != end; ++item) {
      const std::array<double, 3> c{centre(node, *item, 0), centre(node, *item, 1), centre(node, *item, 2)};
      centres.extend({c, c});
    }
  };
  bound_centres();
  if (!node.one_group && centres.low == centres.high) {
    node.one_group = true;
    bound_centres();
  }
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    if (centres.high[k] / 2 - centres.low[k] / 2 > centres.high[axis] / 2 - centres.low[axis] / 2) axis = k;
  }
  const double cut = centres.centre(axis);
  auto middle = std::partition(begin, end, [&](const Item& item) { return centre(node, item, axis) < cut; });
  const Index least = node.count / 8;
  if (static_cast<Index>(middle - begin) <= least || static_cast<Index>(end - middle) <= least) {
    const auto key = [&](const Item& item) {
      return std::pair(centre(node, item, axis), node.one_group ? item.id : group_[item.id]);
    };
    middle = begin + node.count / 2;
    std::nth_element(begin, middle, end, [&](const Item& a, const Item& b) { return key(a) < key(b); });
    if (!node.one_group) {  // at the border of a group
      const auto pivot = key(*middle);
      middle = std::partition(begin, end, [&](const Item& item) { return key(item) < pivot; });
      if (middle == begin)
        middle = std::partition(begin, end, [&](const Item& item) { return !(pivot < key(item)); });
    }
  }
  return static_cast<Index>(middle - items_.begin());
}

}  // namespace holdfast
