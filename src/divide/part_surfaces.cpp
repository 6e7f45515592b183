#include "divide/part_surfaces.h"

#include <algorithm>
#include <deque>

#include "divide/numbered_places.h"
#include "mesh/anatomy.h"
#include "numbers/sorted.h"

namespace holdfast::division {
namespace {

/// The side's corners are counterclockwise from outside.
Triangle side_of(const Tetrahedron& t, std::size_t k) {
  const auto [a, b, c] = corners_of_face(t, static_cast<int>(k));
  return {a, c, b};
}

/// A face of the coarse mesh that goes into a part's surface.
struct Wall {
  Triangle corners;         ///< the tetrahedron `inner` is behind
  Index facet = no_entity;  ///< of the volume; none for an interface
  Index inner = no_entity;  ///< a tetrahedron of the part
  Index outer = no_entity;  ///< that on the other side if it is of the part, too
};

class Cutter {
 public:
  Cutter(const Volume& volume, std::span<const Neighbours> neighbours, std::span<const Index> labels,
         int marker)
      : volume_(volume),
        neighbours_(neighbours),
        labels_(labels),
        marker_(marker),
        facets_(volume.facets),
        segments_(volume.segments),
        component_(labels.size(), no_entity) {
    const std::size_t parts =
        labels.empty() ? 0 : *std::max_element(labels.begin(), labels.end()) + std::size_t{1};
    tets_.resize(parts);
    for (std::size_t t = 0; t < labels.size(); ++t) tets_[labels[t]].push_back(static_cast<Index>(t));
  }

  std::vector<CutSurface> run() {
    std::vector<CutSurface> surfaces;
    for (Index part = 0; part < tets_.size(); ++part) surfaces.push_back(surface_of(part));
    return surfaces;
  }

 private:
  CutSurface surface_of(Index part) {
    find_walls(part);
    find_components(part);
    find_depths();
    CutSurface result;
    number_vertices(part, result.part.surface);
    add_walls(result);
    add_segments(part, result.part.surface);
    return result;
  }

  // Each wall once: an inner facet belongs to the tetrahedron with the lower number.
  void find_walls(Index part) {
    walls_.clear();
    for (const Index t : tets_[part])
      for (std::size_t k = 0; k < 4; ++k) {
        const Index n = neighbours_[t][k];
        const bool is_inner = n != no_entity && labels_[n] == part;
        if (is_inner && n < t) continue;
        const Triangle corners = side_of(volume_.tetrahedra[t], k);
        const Index facet = facets_.find(corners);
        if (is_inner && facet == no_entity) continue;
        walls_.push_back({corners, facet, t, is_inner ? n : no_entity});
      }
    // Facets in their own order, then interfaces by their corners.
    std::sort(walls_.begin(), walls_.end(), [](const Wall& a, const Wall& b) {
      return a.facet != b.facet ? a.facet < b.facet : ascending(a.corners) < ascending(b.corners);
    });
  }

  // Components of a part: tetrahedra connected without passing a facet.
  void find_components(Index part) {
    components_ = 0;
    std::vector<Index> open;
    for (const Index seed : tets_[part]) {
      if (component_[seed] != no_entity) continue;
      component_[seed] = components_;
      open.assign(1, seed);
      while (!open.empty()) {
        const Index t = open.back();
        open.pop_back();
        for (std::size_t k = 0; k < 4; ++k) {
          const Index n = neighbours_[t][k];
          if (n == no_entity || labels_[n] != part || component_[n] != no_entity ||
              facets_.find(side_of(volume_.tetrahedra[t], k)) != no_entity)
            continue;
          component_[n] = components_;
          open.push_back(n);
        }
      }
      ++components_;
    }
  }

  // The number of facets between a component and the outside of the part.
  void find_depths() {
    depth_.assign(components_, no_entity);
    std::vector<std::vector<Index>> beside(components_);
    std::deque<Index> open;
    for (const Wall& wall : walls_) {
      const Index c = component_[wall.inner];
      if (wall.outer != no_entity) {
        beside[c].push_back(component_[wall.outer]);
        beside[component_[wall.outer]].push_back(c);
      } else if (depth_[c] == no_entity) {
        depth_[c] = 1;
        open.push_back(c);
      }
    }
    for (; !open.empty(); open.pop_front())
      for (const Index n : beside[open.front()])
        if (depth_[n] == no_entity) {
          depth_[n] = depth_[open.front()] + 1;
          open.push_back(n);
        }
  }

  // Numbers the vertices of walls, dangling segments and isolated input points.
  void number_vertices(Index part, Surface& surface) {
    number_.assign(volume_.vertices.size(), no_entity);
    const auto use = [&](Index v) { number_[v] = 0; };
    for (const Wall& wall : walls_) std::for_each(wall.corners.begin(), wall.corners.end(), use);
    for (const Index t : tets_[part])
      for (const Index v : volume_.tetrahedra[t])
        if (is_input(v)) use(v);
    for (std::size_t v = 0; v < number_.size(); ++v) {
      if (number_[v] == no_entity) continue;
      number_[v] = static_cast<Index>(surface.vertices.size());
      surface.vertices.push_back(volume_.vertices[v]);
      if (!volume_.vertex_markers.empty()) surface.vertex_markers.push_back(volume_.vertex_markers[v]);
    }
  }

  [[nodiscard]] bool is_input(Index v) const { return volume_.input_vertices[v] >= 0; }

  void add_walls(CutSurface& result) {
    Surface& surface = result.part.surface;
    for (const Wall& wall : walls_) {
      Triangle corners = wall.corners;
      std::optional<int> front, behind = volume_.regions[wall.inner];
      if (wall.outer != no_entity) front = volume_.regions[wall.outer];
      if (is_turned(wall)) {
        std::swap(corners[1], corners[2]);
        std::swap(front, behind);
      }
      for (Index& v : corners) v = number_[v];
      surface.facets.push_back(corners);
      surface.facet_markers.push_back(wall.facet == no_entity         ? marker_
                                      : volume_.facet_markers.empty() ? 0
                                                                      : volume_.facet_markers[wall.facet]);
      result.sides.push_back({front, behind});
      if (wall.facet == no_entity) ++result.part.interface_facets;
    }
  }

  // Winding numbers equal depths if the deeper side is behind.
  [[nodiscard]] bool is_turned(const Wall& wall) const {
    return wall.outer != no_entity && depth_[component_[wall.outer]] > depth_[component_[wall.inner]];
  }

  void add_segments(Index part, Surface& surface) {
    if (volume_.segments.empty()) return;
    std::vector<Index> here;
    for (const Index t : tets_[part])
      for (int k = 0; k < 6; ++k) {
        const Index s = segments_.find(ends_of_edge(volume_.tetrahedra[t], k));
        if (s != no_entity) here.push_back(s);
      }
    sort_unique(here);
    for (const Index s : here) {
      surface.segments.push_back({number_[volume_.segments[s][0]], number_[volume_.segments[s][1]]});
      if (!volume_.segment_markers.empty()) surface.segment_markers.push_back(volume_.segment_markers[s]);
    }
  }

  const Volume& volume_;
  std::span<const Neighbours> neighbours_;
  std::span<const Index> labels_;
  const int marker_;
  Finder<3> facets_;
  Finder<2> segments_;
  std::vector<std::vector<Index>> tets_;  // of each part
  std::vector<Wall> walls_;               // of the part at hand
  std::vector<Index> component_;          // of each tetrahedron, within its part
  Index components_ = 0;
  std::vector<Index> depth_;   // of each component
  std::vector<Index> number_;  // of the volume's vertices in the part's surface
};

}  // namespace

std::vector<CutSurface> part_surfaces(const Volume& volume, std::span<const Neighbours> neighbours,
                                      std::span<const Index> labels, int marker) {
  return Cutter(volume, neighbours, labels, marker).run();
}

}  // namespace holdfast::division
