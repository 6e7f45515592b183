#include "api/part_components.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "mesh/disjoint_sets.h"

namespace holdfast {
namespace {

struct Component {
  double volume = 0;  // six times the enclosed volume
  Point low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
            std::numeric_limits<double>::infinity()};
  Point high{-low[0], -low[1], -low[2]};

  void add(const Point& origin, const Point& a, const Point& b, const Point& c) {
    Point u{}, v{}, w{};
    for (std::size_t k = 0; k < 3; ++k) {
      u[k] = a[k] - origin[k];
      v[k] = b[k] - origin[k];
      w[k] = c[k] - origin[k];
      low[k] = std::min({low[k], a[k], b[k], c[k]});
      high[k] = std::max({high[k], a[k], b[k], c[k]});
    }
    volume += u[0] * (v[1] * w[2] - v[2] * w[1]) + u[1] * (v[2] * w[0] - v[0] * w[2]) +
              u[2] * (v[0] * w[1] - v[1] * w[0]);
  }
  [[nodiscard]] bool holds(const Component& other) const {
    for (std::size_t k = 0; k < 3; ++k)
      if (other.low[k] < low[k] || other.high[k] > high[k]) return false;
    return true;
  }
};

/// The component that owns a cavity, or the component itself.
Index owner_of(Index root, const std::map<Index, Component>& components) {
  const Component& cavity = components.at(root);
  if (!(cavity.volume < 0)) return root;
  Index best = root;
  for (const auto& [other, component] : components)
    if (other != root && component.volume >= -cavity.volume && component.holds(cavity) &&
        (best == root || component.volume < components.at(best).volume))
      best = other;
  return best;
}

}  // namespace

std::vector<Index> parts_by_components(const Surface& surface) {
  DisjointSets sets(surface.vertices.size());
  const auto exists = [&](const Triangle& t) {
    return std::all_of(t.begin(), t.end(), [&](Index v) { return v < surface.vertices.size(); });
  };
  for (const Triangle& t : surface.facets) {
    if (!exists(t)) continue;
    sets.unite(t[0], t[1]);
    sets.unite(t[1], t[2]);
  }
  std::map<Index, Component> components;
  for (const Triangle& t : surface.facets) {
    if (!exists(t)) continue;
    const Index root = sets.root(t[0]);
    components[root].add(surface.vertices[root], surface.vertices[t[0]], surface.vertices[t[1]],
                         surface.vertices[t[2]]);
  }
  std::map<Index, Index> owner, number;
  for (const auto& [root, component] : components) owner[root] = owner_of(root, components);
  std::vector<Index> part;
  part.reserve(surface.facets.size());
  for (const Triangle& t : surface.facets) {
    if (!exists(t)) {
      part.push_back(0);
      continue;
    }
    const auto [at, is_new] = number.try_emplace(owner[sets.root(t[0])], static_cast<Index>(number.size()));
    part.push_back(at->second);
  }
  return part;
}

}  // namespace holdfast
