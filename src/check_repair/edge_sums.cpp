#include "check_repair/edge_sums.h"

#include <deque>
#include <utility>

namespace holdfast::checking {

std::vector<Segment> path(const Neighbours& neighbours, const std::set<Segment>& cheap, Index a, Index b) {
  std::map<Index, std::pair<std::size_t, Index>> reached{{a, {0, a}}};  // by vertex the cost, and from where
  std::deque<std::pair<Index, std::size_t>> open{{a, 0}};
  while (!open.empty()) {
    const auto [v, cost] = open.front();
    open.pop_front();
    if (v == b) break;
    const auto at = neighbours.find(v);
    if (at == neighbours.end() || reached[v].first < cost) continue;
    for (const Index w : at->second) {
      const bool is_cheap = cheap.contains(edge_of(v, w));
      const std::size_t more = cost + (is_cheap ? 0 : 1);
      const auto [known, is_new] = reached.try_emplace(w, more, v);
      if (!is_new && known->second.first <= more) continue;
      known->second = {more, v};
      if (is_cheap)
        open.emplace_front(w, more);
      else
        open.emplace_back(w, more);
    }
  }
  std::vector<Segment> edges;
  if (!reached.contains(b)) return edges;
  for (Index v = b; v != a; v = reached[v].second) edges.push_back(edge_of(v, reached[v].second));
  return edges;
}

}  // namespace holdfast::checking
