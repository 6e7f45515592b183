#include "repair/near_bodies.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <vector>

#include "repair/clusters.h"
#include "repair/near.h"
#include "repair/passings.h"
#include "surface/aabb_tree.h"

namespace holdfast::repairing {
namespace {

/// What the boxes of two bodies have in common, for all pairs of bodies.
std::vector<Box> common_boxes(const State& state, std::span<const Index> facets,
                              std::span<const Index> bodies, double widest, const Step& step) {
  std::map<Index, Box> box_of;
  for (const Index f : facets) {
    const Box box = box_round(state, state.facets[f], widest);
    const auto [at, is_new] = box_of.try_emplace(bodies[f], box);
    if (!is_new) at->second.extend(box);
  }
  std::vector<Box> boxes;
  boxes.reserve(box_of.size());
  for (const auto& [body, box] : box_of) boxes.push_back(box);
  std::vector<Box> common;
  AabbTree(boxes).for_each_overlap(
      [&](Index i, Index j) {
        Box box;
        for (std::size_t k = 0; k < 3; ++k) {
          box.low[k] = std::max(boxes[i].low[k], boxes[j].low[k]);
          box.high[k] = std::min(boxes[i].high[k], boxes[j].high[k]);
        }
        common.push_back(box);
        return true;
      },
      [](Index, Index) { return false; }, step);
  return common;
}

/// The facets that another body may be near to.
Trouble near_others(const State& state, std::span<const Index> bodies, double widest, const Step& step) {
  Trouble near;
  const std::vector<Index> facets = everything(state).facets;
  const AabbTree tree(common_boxes(state, facets, bodies, widest, step));
  for (const Index f : facets)
    if (tree.overlaps_any(box_round(state, state.facets[f], widest))) near.facets.push_back(f);
  return near;
}

/// The largest distance of a corner from the plane of the largest facet.
double thickness_of(const State& state, const Cluster& cluster) {
  const auto area = [&](Index f) { return length(normal_of(state, f)); };
  const Index largest = *std::max_element(cluster.facets.begin(), cluster.facets.end(),
                                          [&](Index f, Index g) { return area(f) < area(g); });
  const Vector normal = normal_of(state, largest);
  const Point& origin = state.vertices[state.facets[largest][0]];
  double most = 0;
  for (const Index f : cluster.facets)
    for (const Index v : state.facets[f])
      most = std::max(most, std::fabs(dot(state.vertices[v] - origin, normal)) / length(normal));
  return most;
}

}  // namespace

NearBodies near_bodies(const State& state, double widest, const Step& step) {
  NearBodies near;
  const std::vector<Index> bodies = bodies_of(state);
  const Trouble others = near_others(state, bodies, widest, step);
  if (others.none()) return near;
  Work work;
  for (const SidesPass& place : passings_of(state, others, Passings::bodies, bodies, widest, work, step)) {
    if (!(place.distance > 0)) continue;
    ++near.edges;
    near.edge_distance = place.distance;  // in ascending order
  }
  for (const Cluster& cluster : find_clusters(state, widest, others.facets, step).all) {
    const Index body = bodies[cluster.facets[0]];
    const bool is_of_one =
        std::all_of(cluster.facets.begin(), cluster.facets.end(), [&](Index f) { return bodies[f] == body; });
    if (is_of_one) continue;
    near.facets += cluster.facets.size();
    near.thickness = std::max(near.thickness, std::min(widest, thickness_of(state, cluster)));
  }
  return near;
}

}  // namespace holdfast::repairing
