// A mesh with what is known of its tetrahedra and vertices while a volume is filled and improved.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "classify/regions.h"
#include "mesh/tet_mesh.h"
#include "metric/frame.h"
#include "numbers/vector.h"

namespace holdfast {

class Levels;
class Part;

struct VolumeData {
  TetMesh& mesh;
  std::vector<RegionId>& region_of;  ///< by slot
  std::vector<double>& sizes;     ///< by vertex: the wanted length of edges, the largest if there are metrics
  const std::vector<bool>& kept;  ///< by region: whether it is worked on
  Vertex first_free;              ///< vertices from here on lie on no constraint
  const Part* part = nullptr;     ///< that this is, unless the mesh is whole
  std::vector<Metric>* metrics = nullptr;  ///< by vertex: the wanted metric, if there is one
  std::uint64_t seed = 1;                  ///< of the random orders
  /// By region: the most that a tetrahedron may measure, infinite without a bound; none where no region has
  /// one.
  const std::vector<double>* most_volumes = nullptr;
  /// By region: the sizes that the user allows, infinite without a limit; none where there is no limit.
  const std::vector<double>* most_sizes = nullptr;
  const Levels* levels = nullptr;  ///< that edges are not to jump over; no points are added then

  [[nodiscard]] bool is_inside(Tet t) const {
    return mesh.alive(t) && !mesh.is_ghost(t) && kept[region_of[t]];
  }
  [[nodiscard]] double most_volume(RegionId region) const {
    return most_volumes == nullptr ? std::numeric_limits<double>::infinity() : (*most_volumes)[region];
  }
  [[nodiscard]] double most_size(RegionId region) const {
    return most_sizes == nullptr ? std::numeric_limits<double>::infinity() : (*most_sizes)[region];
  }
  /// The mean of the metrics at some vertices.
  [[nodiscard]] Metric mean_metric(std::span<const Vertex> vertices) const {
    Metric sum{};
    for (const Vertex v : vertices) sum = sum + (*metrics)[v];
    return (1 / static_cast<double>(vertices.size())) * sum;
  }
  /// Of the edge between two vertices, in their metrics if there are any.
  [[nodiscard]] double length(Vertex v, Vertex w) const {
    if (metrics != nullptr) [[unlikely]]
      return length_in_metrics(v, w);
    return distance(mesh.position(v), mesh.position(w));
  }
  /// The same over the size that is wanted along it.
  [[nodiscard]] double length_over_size(Vertex v, Vertex w) const {
    if (metrics != nullptr) [[unlikely]]
      return length_in_metrics(v, w);
    return distance(mesh.position(v), mesh.position(w)) / (0.5 * (sizes[v] + sizes[w]));
  }
  /// The wanted length of edges at a vertex in the frame of vertices near it.
  [[nodiscard]] double size_in_frame(Vertex v) const { return metrics == nullptr ? sizes[v] : 1; }
  /// In which lengths among some vertices are to be compared with sizes: space, or that of their mean metric.
  [[nodiscard]] Frame frame_of(std::span<const Vertex> vertices) const {
    if (metrics == nullptr) return {};
    return {mean_metric(vertices), mesh.position(vertices.front())};
  }
  /// Calls act with the corners of a tetrahedron as their frame has them.
  template <typename Act>
  auto see(const TetMesh::Corners& c, Act&& act) const {
    const Point &p = mesh.position(c[0]), &q = mesh.position(c[1]), &r = mesh.position(c[2]),
                &s = mesh.position(c[3]);
    if (metrics == nullptr) return act(p, q, r, s);
    const Frame frame = frame_of(c);
    return act(frame.to(p), frame.to(q), frame.to(r), frame.to(s));
  }
  /// What `length` is if there are metrics.
  [[nodiscard]] double length_in_metrics(Vertex v, Vertex w) const;
};

}  // namespace holdfast
