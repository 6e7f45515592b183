#include "repair/near_bodies.h"

#include <algorithm>
#include <vector>

#include "repair/clusters.h"
#include "repair/passings.h"

namespace holdfast::repairing {

NearBodies near_bodies(const State& state, double widest, const Step& step) {
  NearBodies near;
  const std::vector<Index> bodies = bodies_of(state);
  Work work;
  for (const SidesPass& place :
       passings_of(state, everything(state), Passings::bodies, bodies, widest, work, step)) {
    if (!(place.distance > 0)) continue;
    ++near.edges;
    near.distance = place.distance;  // in ascending order
  }
  for (const Cluster& cluster : find_clusters(state, widest, {}, step).all) {
    const Index body = bodies[cluster.facets[0]];
    const bool is_of_one =
        std::all_of(cluster.facets.begin(), cluster.facets.end(), [&](Index f) { return bodies[f] == body; });
    if (!is_of_one) near.facets += cluster.facets.size();
  }
  return near;
}

}  // namespace holdfast::repairing
