// Surface layer: which pairs of nodes of a tree of boxes may be passed over.
#include "surface/node_skip.h"

#include <algorithm>

namespace holdfast {

NodeSkip::NodeSkip(const Complex& complex, const Elements& elements, std::span<const std::uint8_t> known,
                   std::span<const Index> done, const Hubs& hubs, const AabbTree& tree, const Box& all,
                   std::size_t patience)
    : complex_(complex),
      elements_(elements),
      known_(known),
      done_(done),
      hubs_(hubs),
      tree_(tree),
      frame_(all),
      patience_(patience),
      common_(hubs.all().empty() ? 0 : tree.nodes()),
      all_known_(known.empty() ? 0 : tree.nodes()),
      all_done_(done.empty() ? 0 : tree.nodes()) {}

bool NodeSkip::share_hub(const HubSet& a, const HubSet& b) {
  for (const Index hub : a) {
    if (hub != no_index && std::find(b.begin(), b.end(), hub) != b.end()) return true;
  }
  return false;
}

bool NodeSkip::is_all_known(Index node) const {
  const auto items = tree_.items(node);
  return std::all_of(items.begin(), items.end(),
                     [&](const AabbTree::Item& item) { return known_[item.id] != 0; });
}

bool NodeSkip::is_all_done(Index node) const {
  const auto items = tree_.items(node);
  return std::all_of(items.begin(), items.end(),
                     [&](const AabbTree::Item& item) { return done_[item.id] != no_index; });
}

NodeSkip::HubSet NodeSkip::find_common_hubs(Index node) const {
  const auto items = tree_.items(node);
  HubSet common = hubs_.of(items[0].id);
  for (const AabbTree::Item& item : items) {
    const HubSet& hubs = hubs_.of(item.id);
    bool none = true;
    for (Index& hub : common) {
      if (std::find(hubs.begin(), hubs.end(), hub) == hubs.end()) hub = no_index;
      none = none && hub == no_index;
    }
    if (none) break;
  }
  return common;
}

OrientedBox NodeSkip::box_round(Index node) {
  corners_.clear();
  for (const AabbTree::Item& item : tree_.items(node)) {
    const Element& element = elements_.all[item.id];
    std::array<Point, 3>& corners = corners_.emplace_back();
    for (unsigned i = 0; i < 3; ++i) {
      const Index v = element.vertex[std::min<unsigned>(i, element.corners - 1u)];
      corners[i] = frame_(complex_.vertices[v].data());
    }
  }
  return oriented_box(corners_);
}

}  // namespace holdfast
