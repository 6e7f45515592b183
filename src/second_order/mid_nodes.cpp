// Straight elements of second order.
#include <stdexcept>

#include "holdfast/second_order.h"
#include "mesh/plain_monitor.h"
#include "numbers/float_environment.h"
#include "second_order/edge_numbers.h"
#include "second_order/edges_of.h"

namespace holdfast {
namespace {

class MidNodeMaker {
 public:
  MidNodeMaker(Volume& volume, PlainMonitor& monitor)
      : volume_(volume), monitor_(monitor), numbers_(kEdgesATet * volume.tetrahedra.size()) {}

  void run() {
    MidNodes nodes;
    nodes.tetrahedra = nodes_of<6>(volume_.tetrahedra, kTetrahedronEdges);
    nodes.facets = nodes_of<3>(volume_.facets, kFacetEdges);
    for (const auto& node : nodes_of<1>(volume_.segments, kSegmentEdges)) nodes.segments.push_back(node[0]);
    nodes.points.reserve(numbers_.edges().size());
    for (const Segment& edge : numbers_.edges())
      nodes.points.push_back(middle(volume_.vertices[edge[0]], volume_.vertices[edge[1]]));
    volume_.mid_nodes = std::move(nodes);
  }

 private:
  static constexpr std::size_t kEdgesATet = 2;  // inside a mesh there are 1.2

  template <std::size_t N, typename Entity, std::size_t Edges>
  std::vector<std::array<Index, N>> nodes_of(const std::vector<Entity>& entities,
                                             const std::array<std::array<std::size_t, 2>, Edges>& edges) {
    static_assert(N == Edges);
    const std::size_t first = volume_.vertices.size();
    std::vector<std::array<Index, N>> nodes(entities.size());
    for (std::size_t i = 0; i < entities.size(); ++i) {
      monitor_.poll_again();
      for (const Index v : entities[i])
        if (v >= first) throw std::out_of_range("holdfast: an element names a vertex that does not exist");
      for (std::size_t e = 0; e < N; ++e)
        nodes[i][e] = static_cast<Index>(
            first + numbers_.of(entities[i][edges[e][0]], entities[i][edges[e][1]], first));
    }
    return nodes;
  }

  Volume& volume_;
  PlainMonitor& monitor_;
  EdgeNumbers numbers_;
};

}  // namespace

void add_mid_nodes(Volume& volume, const Limits& limits) {
  const FloatEnvironment environment;
  PlainMonitor monitor(limits, {});
  MidNodeMaker(volume, monitor).run();
}

}  // namespace holdfast
