// Surface layer: groups to which all items below a node of a tree of boxes belong.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "surface/aabb_tree.h"

namespace holdfast {

class NodeGroups {
 public:
  /// `of` has up to three groups for each item of the tree; unused places hold `no_index`. Empty: no item is
  /// in a group.
  NodeGroups(const AabbTree& tree, std::span<const std::array<Index, 3>> of)
      : tree_(tree), of_(of), common_(of.empty() ? 0 : tree.nodes()) {}

  /// Whether a group holds all items of both nodes.
  bool share(Index a, Index b) {
    if (of_.empty()) return false;
    return share_any(common(a), common(b));
  }

  /// Whether two items, or two nodes with these groups, have a group in common.
  [[nodiscard]] static bool share_any(const std::array<Index, 3>& a, const std::array<Index, 3>& b);

 private:
  const std::array<Index, 3>& common(Index node) {
    std::optional<std::array<Index, 3>>& groups = common_[node];
    if (!groups) groups = find_common(node);
    return *groups;
  }
  [[nodiscard]] std::array<Index, 3> find_common(Index node) const;

  const AabbTree& tree_;
  std::span<const std::array<Index, 3>> of_;
  std::vector<std::optional<std::array<Index, 3>>> common_;  // by node, found when first asked for
};

}  // namespace holdfast
