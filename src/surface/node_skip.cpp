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
      tree_(tree),
      frame_(all),
      patience_(patience),
      common_hubs_(tree, hubs.of()),
      all_known_(known.empty() ? 0 : tree.nodes()),
      all_done_(done.empty() ? 0 : tree.nodes()) {}

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
