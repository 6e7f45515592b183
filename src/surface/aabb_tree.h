// Surface layer: a tree of axis-aligned boxes that finds all pairs of overlapping boxes.
//
// It is built top-down: a node is split at the middle of the boxes' centres along the longest axis, or at the
// median if that split would be lopsided. Its depth is O(log n). Boxes are closed and compared without
// rounding, so the boxes of simplices that touch overlap.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "holdfast/types.h"
#include "mesh/parallel.h"

namespace holdfast {

/// A closed box; low <= high in each coordinate, all finite.
struct Box {
  std::array<double, 3> low, high;

  /// Without branches, because they would be unpredictable.
  [[nodiscard]] bool overlaps(const Box& other) const {
    const auto in = [&](std::size_t k) {
      return static_cast<unsigned>(low[k] <= other.high[k]) & static_cast<unsigned>(other.low[k] <= high[k]);
    };
    return (in(0) & in(1) & in(2)) != 0;
  }
  void extend(const Box& other);
  /// The middle in coordinate k.
  [[nodiscard]] double centre(std::size_t k) const { return low[k] / 2 + high[k] / 2; }
};

class AabbTree {
 public:
  struct Item {
    Box box;
    Index id;
  };

  /// Item i is boxes[i]. If `group` is given, items with the same entry other than ~0 get a subtree of their
  /// own (as a rule: groups with the same centre may mix). O(n log n) time, O(n) memory.
  explicit AabbTree(std::span<const Box> boxes, std::span<const Index> group = {},
                    const Threads& threads = 1);
  /// A tree without items.
  AabbTree() = default;

  /// Number of nodes.
  [[nodiscard]] std::size_t nodes() const { return nodes_.size(); }
  /// The items of a node's subtree.
  [[nodiscard]] std::span<const Item> items(Index node) const {
    return {items_.data() + nodes_[node].first, nodes_[node].count};
  }

  /// Calls visit(i, j) once for each pair of items i != j whose boxes overlap, until it returns false. The
  /// order depends on the boxes alone. Pairs within nodes for which skip(node, node) is true are left out.
  /// Calls step(fraction) every few thousand tests with the share of items whose pairs are done.
  template <class Visit, class Skip, class Step>
  void for_each_overlap(Visit&& visit, Skip&& skip, Step&& step) const {
    if (!items_.empty()) for_each_overlap(NodePair{0, 0}, visit, skip, step);
  }

  /// Calls visit(item) for each item, except if skip(box) is true for its box or for a box round it.
  template <class Skip, class Visit>
  void for_each_item(Skip&& skip, Visit&& visit) const;

  /// Whether the box of any item overlaps this one. O(log n) for small boxes of items that do not overlap.
  [[nodiscard]] bool overlaps_any(const Box& box) const;

  /// Two nodes, or one twice.
  using NodePair = std::pair<Index, Index>;
  /// At least `count` pairs of nodes, if there are as many, that together hold all pairs of items.
  [[nodiscard]] std::vector<NodePair> divided(std::size_t count) const;
  /// The same for pairs with one item below each of two nodes. May be called from several threads.
  template <class Visit, class Skip, class Step>
  void for_each_overlap(NodePair top, Visit&& visit, Skip&& skip, Step&& step) const;

 private:
  // Items first .. first + count - 1; children are nodes `left` and left + 1, or none if left is 0.
  struct Node {
    Box box;
    Index first, count, left;
    bool one_group;  // or without groups: split by the items' own centres
  };
  static constexpr Index kLeafItems = 4;

  using Nodes = std::vector<Node>;
  // An item while the tree is built: half as large, and its centre is computed once.
  struct Centred {
    std::array<double, 3> centre;
    Index id;
  };
  // What is needed while the tree is built.
  struct Building {
    std::span<const Box> boxes;
    std::span<const Index> group;
    std::vector<Box> group_boxes;
    std::vector<Centred> items;
  };
  void build_all(const Threads& threads);
  void build_below(Nodes& nodes, Index node);
  void build(Nodes& nodes, Index node);
  Index partition(Node& node);
  template <class Push>
  void for_each_part(NodePair pair, Push&& push) const;
  template <class Skip, class Visit>
  void for_each_item_below(const Node& node, Skip& skip, Visit& visit) const;
  void fill_leaf(Node& leaf);
  [[nodiscard]] double centre(const Node& node, const Centred& item, std::size_t k) const;

  std::vector<Item> items_;
  std::vector<Node> nodes_;
  Building building_;
};

// Calls push(a, b) for the pairs of children that replace a pair of nodes, not both leaves.
template <class Push>
void AabbTree::for_each_part(NodePair pair, Push&& push) const {
  const auto [a, b] = pair;
  const Node& m = nodes_[a];
  const Node& n = nodes_[b];
  if (a == b) {
    push(m.left, m.left + 1);
    push(m.left + 1, m.left + 1);
    push(m.left, m.left);
  } else if (m.left != 0 && (n.left == 0 || m.count >= n.count)) {
    push(m.left + 1, b);
    push(m.left, b);
  } else {
    push(a, n.left + 1);
    push(a, n.left);
  }
}

template <class Skip, class Visit>
void AabbTree::for_each_item(Skip&& skip, Visit&& visit) const {
  if (!nodes_.empty()) for_each_item_below(nodes_[0], skip, visit);
}

template <class Skip, class Visit>
void AabbTree::for_each_item_below(const Node& node, Skip& skip, Visit& visit) const {
  if (skip(node.box)) return;
  if (node.left != 0) {
    for_each_item_below(nodes_[node.left], skip, visit);
    for_each_item_below(nodes_[node.left + 1], skip, visit);
    return;
  }
  for (Index i = node.first; i < node.first + node.count; ++i)
    if (!skip(items_[i].box)) visit(items_[i]);
}

template <class Visit, class Skip, class Step>
void AabbTree::for_each_overlap(NodePair top, Visit&& visit, Skip&& skip, Step&& step) const {
  std::vector<NodePair> stack;
  std::size_t tests = 0, done = 0;
  const auto push = [&](Index a, Index b) {
    ++tests;
    if (nodes_[a].box.overlaps(nodes_[b].box)) stack.emplace_back(a, b);
  };
  push(top.first, top.second);
  constexpr std::size_t kTestsAStep = 4096;
  for (std::size_t next_step = kTestsAStep; !stack.empty();) {
    const auto [a, b] = stack.back();
    stack.pop_back();
    const Node& m = nodes_[a];
    const Node& n = nodes_[b];
    if (tests >= next_step) {
      step(static_cast<double>(done) / static_cast<double>(items_.size()));
      next_step = tests + kTestsAStep;
    }
    if (skip(a, b)) {
      if (a == b) done += m.count;
    } else if (m.left != 0 || n.left != 0) {
      for_each_part({a, b}, push);
    } else {
      if (a == b) done += m.count;
      for (Index i = m.first; i < m.first + m.count; ++i) {
        if (a != b && !items_[i].box.overlaps(n.box)) continue;
        for (Index j = a == b ? i + 1 : n.first; j < n.first + n.count; ++j) {
          if (items_[i].box.overlaps(items_[j].box) && !visit(items_[i].id, items_[j].id)) return;
        }
      }
    }
  }
}

}  // namespace holdfast
