#include "repair/clusters.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "mesh/disjoint_sets.h"
#include "repair/flat_fans.h"
#include "repair/projection.h"
#include "surface/aabb_tree.h"
#include "surface/node_groups.h"

namespace holdfast::repairing {
namespace {

/// The planes of some facets, computed when first asked for.
struct Planes {
  std::vector<Vector> normal;  // by facet
  std::vector<double> size;    // of each normal

  Planes(const State& state, std::span<const Index> facets)
      : normal(state.facets.size()), size(state.facets.size()) {
    for (const Index f : facets) {
      normal[f] = normal_of(state, f);
      size[f] = length(normal[f]);
    }
  }

  /// The axes along which the facets are projected.
  [[nodiscard]] std::vector<std::uint8_t> axes_of(std::span<const Index> facets) const {
    std::vector<std::uint8_t> axes;
    axes.reserve(facets.size());
    for (const Index f : facets) axes.push_back(static_cast<std::uint8_t>(axis_of(normal[f])));
    return axes;
  }
};

/// Whether two facets share area in the projection along an axis. If not, a side of one of them separates it
/// from the other.
bool overlap(const State& state, Index f, Index g, unsigned axis) {
  const auto turn = [&](Index a, Index b, Index c) {
    return turn_of(state.vertices[a], state.vertices[b], state.vertices[c], axis);
  };
  // Common sides first: most pairs are neighbours and lie on opposite sides of them.
  const auto is_parted = [&](const Triangle& t, int turn_t, const Triangle& other) {
    const auto is_beyond = [&](Index a, Index b) {
      return std::all_of(other.begin(), other.end(),
                         [&](Index v) { return v == a || v == b || turn(a, b, v) * turn_t <= 0; });
    };
    const auto has = [&](Index v) { return v == other[0] || v == other[1] || v == other[2]; };
    const std::array is_shared{has(t[0]), has(t[1]), has(t[2])};
    for (const bool sides_shared : {true, false})
      for (std::size_t i = 0; i < 3; ++i)
        if ((is_shared[i] && is_shared[(i + 1) % 3]) == sides_shared && is_beyond(t[i], t[(i + 1) % 3]))
          return true;
    return false;
  };
  const Triangle &t = state.facets[f], &u = state.facets[g];
  const int turn_t = turn(t[0], t[1], t[2]);
  if (turn_t == 0) return false;
  if (is_parted(t, turn_t, u)) return false;
  const int turn_u = turn(u[0], u[1], u[2]);
  return turn_u != 0 && !is_parted(u, turn_u, t);
}

/// Whether the first facet lies entirely near the plane of the second.
bool lies_in(const State& state, const Planes& planes, Index f, Index g, double gap) {
  const Vector& n = planes.normal[g];
  const double size = planes.size[g];
  if (!(size > 0)) return false;
  const Triangle& corners = state.facets[g];
  const Point& origin = state.vertices[corners[0]];
  const auto is_near = [&](Index v) { return std::fabs(dot(state.vertices[v] - origin, n)) / size <= gap; };
  // Most pairs are neighbours: their unshared corners come first.
  const auto is_shared = [&](Index v) { return v == corners[0] || v == corners[1] || v == corners[2]; };
  for (const bool shared : {false, true})
    for (const Index v : state.facets[f])
      if (is_shared(v) == shared && !is_near(v)) return false;
  return true;
}

/// Whether two facets share area, up to the gap.
bool share_area(const State& state, const Planes& planes, Index f, Index g, double gap) {
  const bool are_parts_of_one =
      !state.sheet.empty() && state.sheet[f] != no_index && state.sheet[f] == state.sheet[g];
  if (are_parts_of_one) return false;
  const bool in_g = lies_in(state, planes, f, g, gap), in_f = lies_in(state, planes, g, f, gap);
  if (!in_g && !in_f) return false;
  const unsigned axis = axis_of(planes.normal[in_g ? g : f]);
  if (overlap(state, f, g, axis)) return true;
  const unsigned other = axis_of(planes.normal[f]);
  return in_g && in_f && other != axis && overlap(state, f, g, other);
}

/// Whether these are a small share of all facets.
bool is_few(const State& state, std::span<const Index> some) {
  constexpr std::size_t kFew = 4;
  return !some.empty() && some.size() < state.facets.size() / kFew;
}

/// Facets whose corners exist and are finite, and boxes round them. If `some` are few, only the facets near
/// them.
std::pair<std::vector<Index>, std::vector<Box>> boxes_near(const State& state, double gap,
                                                           std::span<const Index> some) {
  const auto box_of = [&](Index f) { return box_round(state, state.facets[f], gap); };
  const auto is_whole = [&](Index f) {
    const Triangle& t = state.facets[f];
    return std::all_of(t.begin(), t.end(),
                       [&](Index v) { return v < state.vertices.size() && is_finite(state.vertices[v]); });
  };
  const bool are_few = is_few(state, some);
  AabbTree near;
  if (are_few) {
    std::vector<Box> boxes;
    for (const Index f : some)
      if (is_whole(f)) boxes.push_back(box_of(f));
    near = AabbTree(boxes);
  }
  std::pair<std::vector<Index>, std::vector<Box>> found;
  for (Index f = 0; f < state.facets.size(); ++f) {
    if (!is_whole(f)) continue;
    const Box box = box_of(f);
    if (are_few && !near.overlaps_any(box)) continue;
    found.first.push_back(f);
    found.second.push_back(box);
  }
  return found;
}

/// Calls compare(f, g) for facets whose boxes overlap, of which g is one of some. The boxes of all others are
/// not compared with each other: there may be millions of such pairs.
template <class Compare>
void for_each_near(std::span<const Index> facet, std::span<const Box> boxes,
                   std::span<const std::uint8_t> is_some, Compare&& compare, const Step& step) {
  std::vector<Index> some;
  std::vector<Box> boxes_of_some;
  for (std::size_t i = 0; i < facet.size(); ++i) {
    if (is_some[facet[i]] == 0) continue;
    some.push_back(facet[i]);
    boxes_of_some.push_back(boxes[i]);
  }
  const AabbTree tree(boxes_of_some);
  for (std::size_t i = 0; i < facet.size(); ++i) {
    if (i % 1024 == 0) step(static_cast<double>(i) / static_cast<double>(facet.size()));
    tree.for_each_item([&](const Box& box) { return !box.overlaps(boxes[i]); },
                       [&](const AabbTree::Item& item) {
                         if (some[item.id] != facet[i]) compare(facet[i], some[item.id]);
                       });
  }
}

/// Projects along the axis closest to the normal of the largest facet, and leaves out facets without area in
/// that projection.
void keep_projected(const State& state, const Planes& planes, Cluster& cluster) {
  const Index largest = *std::max_element(cluster.facets.begin(), cluster.facets.end(),
                                          [&](Index f, Index g) { return planes.size[f] < planes.size[g]; });
  cluster.axis = axis_of(planes.normal[largest]);
  std::erase_if(cluster.facets, [&](Index f) {
    const auto& [a, b, c] = state.facets[f];
    return turn_of(state.vertices[a], state.vertices[b], state.vertices[c], cluster.axis) == 0;
  });
}

/// The sets of facets that share area, each projected.
Clusters clusters_of(const State& state, const Planes& planes, const std::set<Index>& together,
                     DisjointSets& sets) {
  std::map<Index, Cluster> by_first;
  for (const Index f : together) by_first[sets.root(f)].facets.push_back(f);
  Clusters found;
  found.facets.assign(together.begin(), together.end());
  for (auto& [first, cluster] : by_first) {
    keep_projected(state, planes, cluster);
    if (cluster.facets.size() > 1) found.all.push_back(std::move(cluster));
  }
  return found;
}

}  // namespace

Vector normal_of(const State& state, Index facet) {
  const auto& [a, b, c] = state.facets[facet];
  const std::vector<Point>& at = state.vertices;
  return cross(at[b] - at[a], at[c] - at[a]);
}

Clusters find_clusters(const State& state, double gap, std::span<const Index> some, const Step& step) {
  std::vector<std::uint8_t> is_some(state.facets.size(), some.empty() ? 1 : 0);
  for (const Index f : some) is_some[f] = 1;
  const auto near = boxes_near(state, gap, some);
  const std::vector<Index>& facet = near.first;
  const std::vector<Box>& boxes = near.second;
  const Planes planes(state, facet);
  DisjointSets sets(state.facets.size());
  std::set<Index> together;
  const auto compare = [&](Index f, Index g) {
    if (sets.root(f) == sets.root(g) || !share_area(state, planes, f, g, gap)) return;
    sets.unite(f, g);
    together.insert(f);
    together.insert(g);
  };
  constexpr std::size_t kVeryFew = 256;  // with more of them, fans matter
  if (is_few(state, some) && some.size() <= kVeryFew) {
    for_each_near(facet, boxes, is_some, compare, step);
    return clusters_of(state, planes, together, sets);
  }
  const FlatFans fans(state, facet, planes.axes_of(facet));
  const AabbTree tree(boxes, fans.first());
  NodeGroups in_fans(tree, fans.of());
  const auto visit = [&](Index i, Index j) {
    if (is_some[facet[i]] + is_some[facet[j]] == 0) return true;
    if (!fans.of().empty() && NodeGroups::share_any(fans.of()[i], fans.of()[j])) return true;
    compare(facet[i], facet[j]);
    return true;
  };
  tree.for_each_overlap(
      visit, [&](Index a, Index b) { return in_fans.share(a, b); }, step);
  return clusters_of(state, planes, together, sets);
}

}  // namespace holdfast::repairing
