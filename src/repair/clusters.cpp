#include "repair/clusters.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "exact/predicates.h"
#include "mesh/disjoint_sets.h"
#include "surface/aabb_tree.h"
#include "surface/intersect.h"

namespace holdfast::repairing {
namespace {

double height(const Point& p, const Point& a, const Vector& n) {
  return std::fabs(dot(minus(p, a), n)) / length(n);
}

/// The coordinate axis that is steepest to the plane of a facet.
unsigned axis_of(const State& state, Index f) {
  const Vector n = normal_of(state, f);
  unsigned axis = 0;
  for (unsigned k = 1; k < 3; ++k)
    if (std::fabs(n[k]) > std::fabs(n[axis])) axis = k;
  return axis;
}

/// Whether two facets share area in the projection along the axis of the second.
bool overlap(const State& state, Index f, Index g) {
  const unsigned axis = axis_of(state, g);
  std::array<std::array<Point, 3>, 2> corners{};
  std::array<Simplex, 2> flat;
  for (std::size_t k = 0; k < 2; ++k) {
    const Triangle& t = state.facets[k == 0 ? f : g];
    flat[k].corners = 3;
    for (std::size_t i = 0; i < 3; ++i) {
      corners[k][i] = state.vertices[t[i]];
      corners[k][i][axis] = 0;
      flat[k].vertex[i] = t[i];
      flat[k].point[i] = corners[k][i].data();
    }
    if (!set_projection(flat[k])) return false;
  }
  return facets_meet(flat[0], flat[1]) == Meet::area;
}

/// Whether all of the first facet is near to the plane of the second.
bool lies_in(const State& state, Index f, Index g, double gap) {
  const Vector n = normal_of(state, g);
  if (!(length(n) > 0)) return false;
  const Point& origin = state.vertices[state.facets[g][0]];
  return std::all_of(state.facets[f].begin(), state.facets[f].end(),
                     [&](Index v) { return height(state.vertices[v], origin, n) <= gap; });
}

/// Takes the axis that is steepest to the largest facet, and leaves out what has no area along it.
void keep_projected(const State& state, Cluster& cluster) {
  const Index largest = *std::max_element(
      cluster.facets.begin(), cluster.facets.end(),
      [&](Index f, Index g) { return length(normal_of(state, f)) < length(normal_of(state, g)); });
  cluster.axis = axis_of(state, largest);
  std::erase_if(cluster.facets, [&](Index f) {
    std::array<std::array<double, 2>, 3> p{};
    for (std::size_t i = 0; i < 3; ++i) {
      const Point& corner = state.vertices[state.facets[f][i]];
      p[i] = {corner[(cluster.axis + 1) % 3], corner[(cluster.axis + 2) % 3]};
    }
    return exact::orient2d(p[0].data(), p[1].data(), p[2].data()) == 0;
  });
}

}  // namespace

Vector normal_of(const State& state, Index facet) {
  const auto& [a, b, c] = state.facets[facet];
  const std::vector<Point>& at = state.vertices;
  return cross(minus(at[b], at[a]), minus(at[c], at[a]));
}

std::vector<Cluster> find_clusters(const State& state, double gap, std::span<const Index> some,
                                   const Step& step) {
  std::vector<std::uint8_t> is_some(state.facets.size(), some.empty() ? 1 : 0);
  for (const Index f : some) is_some[f] = 1;
  std::vector<Box> boxes;
  std::vector<Index> facet;
  for (Index f = 0; f < state.facets.size(); ++f) {
    const Triangle& t = state.facets[f];
    if (std::any_of(t.begin(), t.end(),
                    [&](Index v) { return v >= state.vertices.size() || !is_finite(state.vertices[v]); }))
      continue;
    facet.push_back(f);
    boxes.push_back(box_round(state, t, gap));
  }
  DisjointSets sets(state.facets.size());
  std::set<Index> together;
  AabbTree(boxes).for_each_overlap(
      [&](Index i, Index j) {
        const Index f = facet[i], g = facet[j];
        if (is_some[f] + is_some[g] == 0) return true;
        if ((lies_in(state, f, g, gap) && overlap(state, f, g)) ||
            (lies_in(state, g, f, gap) && overlap(state, g, f))) {
          sets.unite(f, g);
          together.insert(f);
          together.insert(g);
        }
        return true;
      },
      [](Index, Index) { return false; }, step);
  std::map<Index, Cluster> by_first;
  for (const Index f : together) by_first[sets.root(f)].facets.push_back(f);
  std::vector<Cluster> found;
  for (auto& [first, cluster] : by_first) {
    keep_projected(state, cluster);
    if (cluster.facets.size() > 1) found.push_back(std::move(cluster));
  }
  return found;
}

}  // namespace holdfast::repairing
