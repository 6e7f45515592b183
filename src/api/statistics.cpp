// Counts and measures of surfaces and volumes.
#include "holdfast/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "exact/predicates.h"
#include "holdfast/holdfast.h"
#include "mesh/plain_monitor.h"
#include "mesh/shape_counts.h"
#include "numbers/float_environment.h"
#include "numbers/vector.h"
#include "second_order/edge_numbers.h"
#include "second_order/edges_of.h"

namespace holdfast {
namespace {

using Groups = std::vector<Statistics::Group>;

double area_of(const Point& a, const Point& b, const Point& c) { return length(cross(b - a, c - a)) / 2; }

/// Groups by id, created on first use.
class ById {
 public:
  Statistics::Group& operator[](int id) {
    return groups_.try_emplace(id, Statistics::Group{id, {}}).first->second;
  }
  [[nodiscard]] Groups take(const std::map<int, std::string>& names) {
    Groups groups;
    for (auto& [id, group] : groups_) {
      if (const auto name = names.find(id); name != names.end()) group.name = name->second;
      groups.push_back(std::move(group));
    }
    return groups;
  }

 private:
  std::map<int, Statistics::Group> groups_;
};

class Counter {
 public:
  Counter(const std::vector<Point>& vertices, PlainMonitor& monitor)
      : vertices_(vertices), monitor_(monitor), used_(vertices.size()) {
    counts_.vertices = vertices.size();
    find_box();
  }

  void add_tetrahedra(const Volume& volume) {
    require(volume.regions.empty() || volume.regions.size() == volume.tetrahedra.size());
    const std::vector<Neighbours> sides = neighbours(volume.tetrahedra);
    const auto region_of = [&](std::size_t t) { return volume.regions.empty() ? 0 : volume.regions[t]; };
    ById regions;
    ShapeHistogram shape;
    for (std::size_t t = 0; t < volume.tetrahedra.size(); ++t) {
      const Tetrahedron& v = volume.tetrahedra[t];
      use(v, kTetrahedronEdges);
      const Point &a = vertices_[v[0]], &b = vertices_[v[1]], &c = vertices_[v[2]], &d = vertices_[v[3]];
      const int sign = is_finite(v) ? exact::orient3d(a.data(), b.data(), c.data(), d.data()) : 0;
      if (sign < 0) ++counts_.negative;
      if (sign == 0) ++counts_.null;
      const double measure = dot(b - a, cross(c - a, d - a)) / 6;
      Statistics::Group& region = regions[region_of(t)];
      ++region.count;
      region.measure += measure;
      counts_.volume += measure;
      shape.add(a, b, c, d);
      counts_.worst_quality = std::max(counts_.worst_quality, quality(a, b, c, d));
      for (std::size_t k = 0; k < 4; ++k) {
        const Index other = sides[t][k];
        if (other != no_entity && region_of(other) == region_of(t)) continue;
        const Triangle face = outward_face(v, k);
        const double area = area_of(vertices_[face[0]], vertices_[face[1]], vertices_[face[2]]);
        region.area += area;
        if (other == no_entity) counts_.boundary_area += area;
      }
    }
    counts_.tetrahedra = volume.tetrahedra.size();
    counts_.mid_nodes = volume.mid_nodes.points.size();
    counts_.min_dihedral_deg = shape.counts().min_dihedral_deg;
    counts_.max_dihedral_deg = shape.counts().max_dihedral_deg;
    counts_.least_dihedral = shape.counts().least_dihedral;
    counts_.quality = shape.counts().quality;
    counts_.regions = regions.take(volume.names.regions);
  }

  /// Adds the signed volume if each side of a facet has an opposite one: then the facets bound a volume.
  /// Vertices at one place count as one, as in a mesh.
  void add_enclosed(const Surface& surface, Statistics& counts) const {
    const std::vector<std::int64_t> map = vertex_map(surface.view());
    const auto place = [&](Index v) { return map.empty() ? v : static_cast<Index>(map[v]); };
    EdgeNumbers edges;
    std::vector<std::int64_t> balance;
    double volume = 0;
    for (const Triangle& f : surface.facets) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Index a = place(f[k]), b = place(f[(k + 1) % 3]);
        if (a == b) continue;  // a side of length 0
        const Index edge = edges.of(a, b);
        balance.resize(edges.edges().size());
        balance[edge] += a < b ? 1 : -1;
      }
      const Point& origin = counts.low;
      volume += dot(vertices_[f[0]] - origin, cross(vertices_[f[1]] - origin, vertices_[f[2]] - origin)) / 6;
    }
    counts.closed = !surface.facets.empty() && std::all_of(balance.begin(), balance.end(),
                                                           [](std::int64_t sides) { return sides == 0; });
    if (counts.closed) counts.volume = volume;
  }

  /// The statistics common to a surface and a volume.
  template <typename Mesh>
  [[nodiscard]] Statistics finish(const Mesh& mesh) {
    add_lower(mesh.facets, mesh.facet_markers, kFacetEdges, mesh.names.facets, counts_.facet_markers,
              [&](const Triangle& f) { return area_of(vertices_[f[0]], vertices_[f[1]], vertices_[f[2]]); });
    add_lower(mesh.segments, mesh.segment_markers, kSegmentEdges, mesh.names.segments,
              counts_.segment_markers,
              [&](const Segment& s) { return distance(vertices_[s[0]], vertices_[s[1]]); });
    require(mesh.vertex_markers.empty() || mesh.vertex_markers.size() == vertices_.size());
    ById markers;
    for (const int marker : mesh.vertex_markers)
      if (marker != 0) ++markers[marker].count;
    counts_.vertex_markers = markers.take(mesh.names.vertices);
    counts_.facets = mesh.facets.size();
    counts_.segments = mesh.segments.size();
    for (const Statistics::Group& group : counts_.facet_markers) counts_.area += group.measure;
    counts_.unused_vertices = static_cast<std::size_t>(std::count(used_.begin(), used_.end(), false));
    measure_edges();
    return std::move(counts_);
  }

 private:
  static void require(bool fits) {
    if (!fits) throw std::invalid_argument("as many ids as entities are needed, or none");
  }

  template <typename Corners>
  [[nodiscard]] bool is_finite(const Corners& corners) const {
    return std::all_of(corners.begin(), corners.end(), [&](Index v) {
      return std::all_of(vertices_[v].begin(), vertices_[v].end(), [](double x) { return std::isfinite(x); });
    });
  }

  void find_box() {
    bool first = true;
    for (const Point& p : vertices_) {
      if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2])) continue;
      if (first) counts_.low = counts_.high = p;
      first = false;
      for (std::size_t k = 0; k < 3; ++k) {
        counts_.low[k] = std::min(counts_.low[k], p[k]);
        counts_.high[k] = std::max(counts_.high[k], p[k]);
      }
    }
  }

  template <typename Corners, std::size_t N>
  void use(const Corners& corners, const std::array<std::array<std::size_t, 2>, N>& edges) {
    monitor_.poll_again();
    for (const Index v : corners) {
      if (v >= vertices_.size()) throw std::out_of_range("an element names a vertex that does not exist");
      used_[v] = true;
    }
    for (const auto& [a, b] : edges) edges_.of(corners[a], corners[b]);
  }

  template <typename Entity, std::size_t N, typename Measure>
  void add_lower(const std::vector<Entity>& entities, const std::vector<int>& markers,
                 const std::array<std::array<std::size_t, 2>, N>& edges,
                 const std::map<int, std::string>& names, Groups& groups, Measure&& measure) {
    require(markers.empty() || markers.size() == entities.size());
    ById by_id;
    for (std::size_t i = 0; i < entities.size(); ++i) {
      use(entities[i], edges);
      Statistics::Group& group = by_id[markers.empty() ? 0 : markers[i]];
      ++group.count;
      group.measure += measure(entities[i]);
    }
    groups = by_id.take(names);
  }

  void measure_edges() {
    counts_.edges = edges_.edges().size();
    if (counts_.edges == 0) return;
    counts_.shortest_edge = std::numeric_limits<double>::infinity();
    double sum = 0;
    for (const Segment& edge : edges_.edges()) {
      const double length = distance(vertices_[edge[0]], vertices_[edge[1]]);
      counts_.shortest_edge = std::min(counts_.shortest_edge, length);
      counts_.longest_edge = std::max(counts_.longest_edge, length);
      sum += length;
    }
    counts_.mean_edge = sum / static_cast<double>(counts_.edges);
  }

  const std::vector<Point>& vertices_;
  PlainMonitor& monitor_;
  std::vector<bool> used_;
  EdgeNumbers edges_;
  Statistics counts_;
};

}  // namespace

Statistics statistics(const Volume& volume, const Limits& limits) {
  const FloatEnvironment environment;
  PlainMonitor monitor(limits, {});
  Counter counter(volume.vertices, monitor);
  counter.add_tetrahedra(volume);
  return counter.finish(volume);
}

Statistics statistics(const Surface& surface, const Limits& limits) {
  const FloatEnvironment environment;
  PlainMonitor monitor(limits, {});
  Counter counter(surface.vertices, monitor);
  Statistics counts = counter.finish(surface);
  counter.add_enclosed(surface, counts);
  for (const Surface::RegionSeed& seed : surface.regions) {
    Statistics::Group region;
    region.id = seed.id;
    if (const auto name = surface.names.regions.find(seed.id); name != surface.names.regions.end())
      region.name = name->second;
    counts.regions.push_back(region);
  }
  return counts;
}

}  // namespace holdfast
