// Surface layer: construction of the tree of boxes.
#include "surface/aabb_tree.h"

#include <algorithm>

#include "mesh/parallel.h"
#include "numbers/release.h"
#include "surface/complex.h"

namespace holdfast {

void Box::extend(const Box& other) {
  for (std::size_t k = 0; k < 3; ++k) {
    low[k] = std::min(low[k], other.low[k]);
    high[k] = std::max(high[k], other.high[k]);
  }
}

AabbTree::AabbTree(std::span<const Box> boxes, std::span<const Index> group, const Threads& threads) {
  if (boxes.empty()) return;
  building_ = {boxes, group, {}, {}};
  building_.items.reserve(boxes.size());
  for (const Box& box : boxes)
    building_.items.push_back(
        {{box.centre(0), box.centre(1), box.centre(2)}, static_cast<Index>(building_.items.size())});
  std::vector<Box>& group_boxes = building_.group_boxes;
  std::vector<char> seen;
  for (Index i = 0; i < group.size(); ++i) {
    const Index g = group[i];
    if (g == no_index) continue;
    if (g >= group_boxes.size()) {
      group_boxes.resize(g + std::size_t{1});
      seen.resize(g + std::size_t{1}, 0);
    }
    if (seen[g]) {
      group_boxes[g].extend(boxes[i]);
    } else {
      group_boxes[g] = boxes[i];
      seen[g] = 1;
    }
  }
  items_.resize(boxes.size());
  nodes_.reserve(boxes.size());
  nodes_.push_back({boxes[0], 0, static_cast<Index>(boxes.size()), 0, group_boxes.empty()});
  build_all(threads);
  building_ = {};
  for (std::size_t k = nodes_.size(); k-- > 0;) {  // children come after their parents
    Node& node = nodes_[k];
    if (node.left == 0) continue;
    node.box = nodes_[node.left].box;
    node.box.extend(nodes_[node.left + 1].box);
  }
}

// Builds nodes from the root down until there are enough subtrees for all threads, then each subtree on one
// thread.
void AabbTree::build_all(const Threads& threads) {
  constexpr Index kLeastSubtree = 2048;  // items that are worth a thread
  std::vector<Index> roots{0};
  while (threads.count() > 1 && roots.size() < 4 * std::size_t{threads.count()}) {
    std::vector<Index> below;
    for (const Index root : roots) {
      build(nodes_, root);
      if (nodes_[root].left != 0) below.insert(below.end(), {nodes_[root].left, nodes_[root].left + 1});
    }
    roots = std::move(below);
    if (roots.empty() || nodes_[roots[0]].count < kLeastSubtree) break;
  }
  if (roots.size() == 1) return build_below(nodes_, roots[0]);
  std::vector<Nodes> subtrees(roots.size());
  parallel(threads, roots.size(), [&](std::size_t k) {
    subtrees[k].reserve(nodes_[roots[k]].count);
    subtrees[k].push_back(nodes_[roots[k]]);
    build_below(subtrees[k], 0);
  });
  for (std::size_t k = 0; k < roots.size(); ++k) {
    const auto moved_by = static_cast<Index>(nodes_.size() - 1);
    for (Node& node : subtrees[k])
      if (node.left != 0) node.left += moved_by;
    nodes_[roots[k]] = subtrees[k][0];
    nodes_.insert(nodes_.end(), subtrees[k].begin() + 1, subtrees[k].end());
    release(subtrees[k]);
  }
}

void AabbTree::build_below(Nodes& nodes, Index node) {
  std::vector<Index> stack{node};
  while (!stack.empty()) {
    const Index next = stack.back();
    stack.pop_back();
    build(nodes, next);
    if (nodes[next].left != 0) stack.insert(stack.end(), {nodes[next].left + 1, nodes[next].left});
  }
}

bool AabbTree::overlaps_any(const Box& box) const {
  const auto overlaps = [&](const auto& self, Index k) -> bool {
    const Node& node = nodes_[k];
    if (!node.box.overlaps(box)) return false;
    if (node.left != 0) return self(self, node.left) || self(self, node.left + 1);
    return std::any_of(items_.begin() + node.first, items_.begin() + node.first + node.count,
                       [&](const Item& item) { return item.box.overlaps(box); });
  };
  return !items_.empty() && overlaps(overlaps, 0);
}

std::vector<AabbTree::NodePair> AabbTree::divided(std::size_t count) const {
  std::vector<NodePair> pairs;
  if (!items_.empty()) pairs.push_back({0, 0});
  for (bool divisible = true; divisible && pairs.size() < count;) {
    std::vector<NodePair> parts;
    divisible = false;
    for (const auto& [a, b] : pairs) {
      if (!nodes_[a].box.overlaps(nodes_[b].box)) continue;
      if (nodes_[a].left != 0 || nodes_[b].left != 0) {
        for_each_part({a, b}, [&](Index c, Index d) { parts.emplace_back(c, d); });
        divisible = true;
      } else {
        parts.push_back({a, b});
      }
    }
    pairs = std::move(parts);
  }
  return pairs;
}

// Splits a node that holds more than a leaf may; else fills the leaf.
void AabbTree::build(Nodes& nodes, Index node) {
  Node current = nodes[node];
  if (current.count > kLeafItems) {
    const Index middle = partition(current);
    current.left = static_cast<Index>(nodes.size());
    Node part = current;
    part.left = 0;
    part.count = middle - current.first;
    nodes.push_back(part);
    part.first = middle;
    part.count = current.count - (middle - current.first);
    nodes.push_back(part);
  } else {
    fill_leaf(current);
  }
  nodes[node] = current;
}

void AabbTree::fill_leaf(Node& leaf) {
  const auto begin = building_.items.begin() + leaf.first, end = begin + leaf.count;
  // The order of the items depends on how a library partitions; their set does not.
  std::sort(begin, end, [](const Centred& a, const Centred& b) { return a.id < b.id; });
  leaf.box = building_.boxes[begin->id];
  auto item = items_.begin() + leaf.first;
  for (auto from = begin; from != end; ++from, ++item) {
    *item = {building_.boxes[from->id], from->id};
    leaf.box.extend(item->box);
  }
}

double AabbTree::centre(const Node& node, const Centred& item, std::size_t k) const {
  if (node.one_group || building_.group[item.id] == no_index) return item.centre[k];
  return building_.group_boxes[building_.group[item.id]].centre(k);
}

// Divides the node's items along the longest axis of their centres' box; returns the first item of the second
// part.
Index AabbTree::partition(Node& node) {
  const auto begin = building_.items.begin() + node.first, end = begin + node.count;
  Box centres;
  const auto bound_centres = [&] {
    for (std::size_t k = 0; k < 3; ++k) centres.low[k] = centres.high[k] = centre(node, *begin, k);
    if (node.one_group) {
      for (auto item = begin + 1; item != end; ++item)
        for (std::size_t k = 0; k < 3; ++k) {
          const double c = item->centre[k];
          centres.low[k] = std::min(centres.low[k], c);
          centres.high[k] = std::max(centres.high[k], c);
        }
      return;
    }
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
  const auto half = [&](std::size_t k) { return centres.high[k] / 2 - centres.low[k] / 2; };
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    // Half of the smallest double is 0.
    if (half(k) > half(axis) || centres.low[axis] == centres.high[axis]) axis = k;
  }
  const double cut = centres.centre(axis);
  const auto is_first = [&](const Centred& item) { return centre(node, item, axis) < cut; };
  const auto is_first_alone = [&](const Centred& item) { return item.centre[axis] < cut; };
  auto middle =
      node.one_group ? std::partition(begin, end, is_first_alone) : std::partition(begin, end, is_first);
  const Index least = node.count / 8;
  if (static_cast<Index>(middle - begin) <= least || static_cast<Index>(end - middle) <= least) {
    const auto key = [&](const Centred& item) {
      return std::pair(centre(node, item, axis), node.one_group ? item.id : building_.group[item.id]);
    };
    middle = begin + node.count / 2;
    std::nth_element(begin, middle, end, [&](const Centred& a, const Centred& b) { return key(a) < key(b); });
    if (!node.one_group) {  // at the border of a group
      const auto pivot = key(*middle);
      middle = std::partition(begin, end, [&](const Centred& item) { return key(item) < pivot; });
      if (middle == begin)
        middle = std::partition(begin, end, [&](const Centred& item) { return !(pivot < key(item)); });
    }
  }
  return static_cast<Index>(middle - building_.items.begin());
}

}  // namespace holdfast
