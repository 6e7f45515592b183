// Surface layer: pairs of nodes of a tree of boxes that the search for offending pairs may skip.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "surface/aabb_tree.h"
#include "surface/complex.h"
#include "surface/elements.h"
#include "surface/hubs.h"
#include "surface/node_groups.h"
#include "surface/oriented_box.h"

namespace holdfast {

class NodeSkip {
 public:
  /// `known`: for each element, whether it is known to fit together with all other elements marked so.
  /// `done`: for each element its sheet, or `no_index`; pairs of facets of sheets are not tested. Both may be
  /// empty. `all` is the box of all elements. After `patience` tests, oriented boxes are used too.
  NodeSkip(const Complex& complex, const Elements& elements, std::span<const std::uint8_t> known,
           std::span<const Index> done, const Hubs& hubs, const AabbTree& tree, const Box& all,
           std::size_t patience);

  /// True if all elements of both nodes are known or belong to done sheets, if all elements of a share a hub
  /// with all of b, or if oriented boxes separate them.
  bool operator()(Index a, Index b) {
    if (!known_.empty() && is_known(a) && is_known(b)) return true;
    if (!done_.empty() && is_done(a) && is_done(b)) return true;
    if (common_hubs_.share(a, b)) return true;
    if (a == b || ++tests_ <= patience_) return false;
    boxes_.resize(tree_.nodes());
    return surely_apart(oriented(a), oriented(b));
  }

  /// Counts a test of a pair of elements.
  void count_pair() { ++tests_; }

 private:
  bool is_known(Index node) {
    std::optional<bool>& all = all_known_[node];
    if (!all) all = is_all_known(node);
    return *all;
  }
  bool is_done(Index node) {
    std::optional<bool>& all = all_done_[node];
    if (!all) all = is_all_done(node);
    return *all;
  }
  const OrientedBox& oriented(Index node) {
    std::optional<OrientedBox>& box = boxes_[node];
    if (!box) box = box_round(node);
    return *box;
  }

  [[nodiscard]] bool is_all_known(Index node) const;
  [[nodiscard]] bool is_all_done(Index node) const;
  [[nodiscard]] OrientedBox box_round(Index node);

  const Complex& complex_;
  const Elements& elements_;
  const std::span<const std::uint8_t> known_;
  const std::span<const Index> done_;
  const AabbTree& tree_;
  UnitFrame frame_;
  std::size_t patience_, tests_ = 0;
  NodeGroups common_hubs_;
  std::vector<std::optional<bool>> all_known_, all_done_;
  std::vector<std::optional<OrientedBox>> boxes_;
  std::vector<std::array<Point, 3>> corners_;
};

}  // namespace holdfast
