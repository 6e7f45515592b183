// The walls of a region, and the levels of vertices between them (levels.h).
//
// Levels are in proportion to the numbers of edges to a floor and to a ceiling: along an edge, each of them
// changes by 1 at most, and so does the level where they are n together or more. Of vertices of the surface
// they are counted along facets, whose edges stand: so no edge between two of them jumps over a level, but at
// those on a way of fewer edges over the side between a floor and a ceiling. These are at a rim, and free.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/monitor.h"
#include "refine/levels.h"
#include "refine/volume_data.h"

namespace holdfast {

class Walls {
 public:
  /// Of the region that `tets` are all of.
  Walls(const TetMesh& mesh, std::span<const Tet> tets, Monitor& monitor);

  // A vertex that is on both, as at the sharp edge of a wedge, counts as neither.
  [[nodiscard]] bool is_floor(Vertex v, std::size_t k) const {
    return has(v, k, &Sides::floors) && !has(v, k, &Sides::ceilings);
  }
  [[nodiscard]] bool is_ceiling(Vertex v, std::size_t k) const {
    return has(v, k, &Sides::ceilings) && !has(v, k, &Sides::floors);
  }
  [[nodiscard]] bool is_both(Vertex v, std::size_t k) const {
    return has(v, k, &Sides::floors) && has(v, k, &Sides::ceilings);
  }
  [[nodiscard]] bool is_on_surface(Vertex v) const { return !joined_to(v).empty(); }
  using Edge = std::array<Vertex, 2>;
  /// Edges of facets from v.
  [[nodiscard]] std::span<const Edge> joined_to(Vertex v) const;

 private:
  // Which directions a vertex is on a floor, or a ceiling, of: a bit for each.
  struct Sides {
    std::uint16_t floors = 0, ceilings = 0;
  };
  [[nodiscard]] bool has(Vertex v, std::size_t k, std::uint16_t Sides::*one) const {
    return v < sides_.size() && ((sides_[v].*one >> k) & 1U) != 0;
  }
  void note_facet(const TetMesh& mesh, Face f);

  std::vector<Sides> sides_;  // by vertex; none for those that are added
  std::vector<Edge> edges_;   // of facets, each both ways, ascending
};

/// A region that gets layers between its walls.
struct BetweenWalls {
  const VolumeData& volume;
  RegionId region;
  const Walls& walls;
  std::uint8_t layers;
  Monitor& monitor;
};

/// Gives levels from 0 to `layers` in a direction to the vertices of the region, in ascending order; none to
/// those at rims, which `at_rims`, by vertex, takes note of. Returns whether there are both floors and
/// ceilings; if not, nothing changes.
bool number_levels(const BetweenWalls& where, std::span<const Vertex> vertices, std::size_t direction,
                   Levels& levels, std::vector<std::uint8_t>& at_rims);

}  // namespace holdfast
