// Surface layer: construction of the tree of boxes.
#include "surface/aabb_tree.h"

#include <algorithm>

namespace holdfast {
namespace {

void extend(Box& box, const Box& other) {
  for (unsigned k = 0; k < 3; ++k) {
    box.low[k] = std::min(box.low[k], other.low[k]);
    box.high[k] = std::max(box.high[k], other.high[k]);
  }
}

// Half of each, so that boxes near the end of the range do not overflow.
double centre(const Box& box, unsigned k) { return box.low[k] / 2 + box.high[k] / 2; }

}  // namespace

AabbTree::AabbTree(std::span<const Box> boxes) {
  if (boxes.empty()) return;
  items_.reserve(boxes.size());
  for (const Box& box : boxes) items_.push_back({box, static_cast<Index>(items_.size())});
  nodes_.reserve(boxes.size());
  nodes_.push_back({items_[0].box, 0, static_cast<Index>(boxes.size()), 0});
  std::vector<Index> stack{0};
  while (!stack.empty()) {
    const Index node = stack.back();
    stack.pop_back();
    build(node);
    if (nodes_[node].left != 0) stack.insert(stack.end(), {nodes_[node].left + 1, nodes_[node].left});
  }
}

// Sets the node's box, and splits it if it holds more than a leaf may.
void AabbTree::build(Index node) {
  Node current = nodes_[node];
  current.box = items_[current.first].box;
  for (Index i = 1; i < current.count; ++i) extend(current.box, items_[current.first + i].box);
  if (current.count > kLeafItems) {
    const Index middle = partition(current);
    current.left = static_cast<Index>(nodes_.size());
    nodes_.push_back({current.box, current.first, middle - current.first, 0});
    nodes_.push_back({current.box, middle, current.first + current.count - middle, 0});
  }
  nodes_[node] = current;
}

// Divides the node's items along the longest axis of their centres' box; returns the second part's first.
Index AabbTree::partition(const Node& node) {
  const auto begin = items_.begin() + node.first, end = begin + node.count;
  Box centres{{centre(begin->box, 0), centre(begin->box, 1), centre(begin->box, 2)}, {}};
  centres.high = centres.low;
  for (auto item = begin; item != end; ++item) {
    const std::array<double, 3> c{centre(item->box, 0), centre(item->box, 1), centre(item->box, 2)};
    extend(centres, {c, c});
  }
  unsigned axis = 0;
  for (unsigned k = 1; k < 3; ++k) {
    if (centres.high[k] / 2 - centres.low[k] / 2 > centres.high[axis] / 2 - centres.low[axis] / 2) axis = k;
  }
  const double cut = centre(centres, axis);
  auto middle = std::partition(begin, end, [=](const Item& item) { return centre(item.box, axis) < cut; });
  const auto least = node.count / 8;
  if (static_cast<Index>(middle - begin) <= least || static_cast<Index>(end - middle) <= least) {
    middle = begin + node.count / 2;
    std::nth_element(begin, middle, end, [=](const Item& a, const Item& b) {
      return std::pair(centre(a.box, axis), a.id) < std::pair(centre(b.box, axis), b.id);
    });
  }
  return static_cast<Index>(middle - items_.begin());
}

}  // namespace holdfast
