#include "surface/node_groups.h"

#include <algorithm>

#include "surface/complex.h"

namespace holdfast {

bool NodeGroups::share_any(const std::array<Index, 3>& a, const std::array<Index, 3>& b) {
  return std::any_of(a.begin(), a.end(), [&](Index group) {
    return group != no_index && std::find(b.begin(), b.end(), group) != b.end();
  });
}

std::array<Index, 3> NodeGroups::find_common(Index node) const {
  const auto items = tree_.items(node);
  std::array<Index, 3> common = of_[items[0].id];
  for (const AabbTree::Item& item : items) {
    const std::array<Index, 3>& groups = of_[item.id];
    bool none = true;
    for (Index& group : common) {
      if (std::find(groups.begin(), groups.end(), group) == groups.end()) group = no_index;
      none = none && group == no_index;
    }
    if (none) break;
  }
  return common;
}

}  // namespace holdfast
