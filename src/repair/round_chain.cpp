#include "repair/round_chain.h"

#include <algorithm>
#include <map>
#include <set>

#include "numbers/sorted.h"
#include "surface/complex.h"

namespace holdfast::repairing {
namespace {

using Edge = std::array<Index, 2>;  // ascending

bool has(std::span<const Edge> edges, const Edge& edge) {
  return std::binary_search(edges.begin(), edges.end(), edge);
}

std::vector<Edge> ascending_edges(std::span<const RoundChain::Step> steps) {
  std::vector<Edge> edges;
  for (const auto& step : steps) edges.push_back(ascending(step));
  std::sort(edges.begin(), edges.end());
  return edges;
}

/// One step along each edge that has an odd number of steps.
std::vector<RoundChain::Step> odd_steps(std::span<const RoundChain::Step> chain) {
  std::map<Edge, std::vector<RoundChain::Step>> along;
  for (const RoundChain::Step& step : chain) along[ascending(step)].push_back(step);
  std::vector<RoundChain::Step> odd;
  for (const auto& [edge, steps] : along) {
    if (steps.size() % 2 == 0) continue;
    const auto forth = std::count(steps.begin(), steps.end(), edge);
    odd.push_back(2 * static_cast<std::size_t>(forth) > steps.size() ? edge : Edge{edge[1], edge[0]});
  }
  return odd;
}

}  // namespace

RoundChain::RoundChain(std::span<const Triangle> triangles)
    : triangles_(triangles), beside_(3 * triangles.size(), no_index) {
  edges_.reserve(beside_.size());
  for (Index t = 0; t < triangles.size(); ++t)
    for (Index i = 0; i < 3; ++i) edges_.push_back({{triangles[t][i], triangles[t][(i + 1) % 3]}, 3 * t + i});
  std::sort(edges_.begin(), edges_.end(), [](const EdgeOf& a, const EdgeOf& b) { return a.edge < b.edge; });
  for (const EdgeOf& e : edges_) beside_[e.code] = triangle_left_of({e.edge[1], e.edge[0]});
}

Index RoundChain::triangle_left_of(const Step& edge) const {
  const auto found = std::lower_bound(edges_.begin(), edges_.end(), edge,
                                      [](const EdgeOf& e, const Step& wanted) { return e.edge < wanted; });
  return found == edges_.end() || found->edge != edge ? no_index : found->code / 3;
}

std::vector<Index> RoundChain::inside(std::span<const Step> chain) const {
  const std::vector<Step> odd = odd_steps(chain);
  std::vector<Index> inside;
  if (!flood(odd, inside)) return by_parity(odd);
  return inside;
}

bool RoundChain::flood(std::span<const Step> odd, std::vector<Index>& inside) const {
  const std::vector<Edge> walls = ascending_edges(odd);
  std::set<Index> reached;
  std::vector<Index> open;
  const auto reach = [&](Index t) {
    if (reached.insert(t).second) open.push_back(t);
  };
  for (const Step& step : odd) {
    const Index t = triangle_left_of(step);
    if (t == no_index) return false;
    reach(t);
  }
  while (!open.empty()) {
    const Index t = open.back();
    open.pop_back();
    for (Index i = 0; i < 3; ++i) {
      if (has(walls, ascending(Step{triangles_[t][i], triangles_[t][(i + 1) % 3]}))) continue;
      if (beside_[3 * t + i] == no_index) return false;  // outside
      reach(beside_[3 * t + i]);
    }
  }
  for (const Step& step : odd)
    if (const Index t = triangle_left_of({step[1], step[0]}); t != no_index && reached.count(t) != 0)
      return false;
  inside.assign(reached.begin(), reached.end());
  return true;
}

std::vector<Index> RoundChain::by_parity(std::span<const Step> odd) const {
  const std::vector<Edge> walls = ascending_edges(odd);
  enum State : std::uint8_t { unknown, outside, within };
  std::vector<State> state(triangles_.size(), unknown);
  std::vector<Index> open;
  const auto reach = [&](Index t, bool is_within) {
    if (state[t] != unknown) return;
    state[t] = is_within ? within : outside;
    open.push_back(t);
  };
  const auto is_wall = [&](Index t, Index i) {
    return has(walls, ascending(Step{triangles_[t][i], triangles_[t][(i + 1) % 3]}));
  };
  for (Index t = 0; t < triangles_.size(); ++t)
    for (Index i = 0; i < 3; ++i)
      if (beside_[3 * t + i] == no_index) reach(t, is_wall(t, i));
  while (!open.empty()) {
    const Index t = open.back();
    open.pop_back();
    for (Index i = 0; i < 3; ++i)
      if (const Index other = beside_[3 * t + i]; other != no_index)
        reach(other, (state[t] == within) != is_wall(t, i));
  }
  std::vector<Index> inside;
  for (Index t = 0; t < state.size(); ++t)
    if (state[t] == within) inside.push_back(t);
  return inside;
}

}  // namespace holdfast::repairing
