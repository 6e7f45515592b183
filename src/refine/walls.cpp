#include "refine/walls.h"

#include <algorithm>

#include "mesh/traverse.h"
#include "numbers/sorted.h"

namespace holdfast {

Walls::Walls(const TetMesh& mesh, std::span<const Tet> tets, Monitor& monitor) : sides_(mesh.vertex_count()) {
  for (const Tet t : tets) {
    monitor.poll_again();
    for (int i = 0; i < 4; ++i)
      if (const Face f = face_code(t, i); mesh.is_facet(f)) note_facet(mesh, f);
  }
  sort_unique(edges_);
}

void Walls::note_facet(const TetMesh& mesh, Face f) {
  const auto v = mesh.face_vertices(f);
  for (std::size_t i = 0; i < 3; ++i)
    for (const Vertex w : {v[(i + 1) % 3], v[(i + 2) % 3]}) edges_.push_back({v[i], w});
  const Point& p = mesh.position(v[0]);
  const Vector inward = cross(mesh.position(v[1]) - p, mesh.position(v[2]) - p);
  const double size = length(inward);
  if (!(size > 0)) return;
  for (std::size_t k = 0; k < Levels::kDirections; ++k) {
    const double along = dot(inward, Levels::direction(k)) / size;
    const auto bit = static_cast<std::uint16_t>(1U << k);
    for (const Vertex x : v) {
      if (along > Levels::kCone) sides_[x].floors |= bit;
      if (along < -Levels::kCone) sides_[x].ceilings |= bit;
    }
  }
}

std::span<const Walls::Edge> Walls::joined_to(Vertex v) const {
  const auto first = std::lower_bound(edges_.begin(), edges_.end(), Edge{v, 0});
  const auto last = std::find_if(first, edges_.end(), [v](const Edge& e) { return e[0] != v; });
  // By pointer and length: libc++ 13, of the package for browsers, has no other constructor.
  return {edges_.data() + (first - edges_.begin()), static_cast<std::size_t>(last - first)};
}

namespace {

using Counts = std::vector<std::uint8_t>;  // by vertex; at most as many as layers

// The levels of a region's vertices in one direction.
class LevelNumbering {
 public:
  LevelNumbering(const BetweenWalls& where, std::span<const Vertex> vertices, std::size_t direction)
      : where_(where), mesh_(where.volume.mesh), vertices_(vertices), direction_(direction) {}

  [[nodiscard]] bool has_floors_and_ceilings() const {
    return std::any_of(vertices_.begin(), vertices_.end(), [this](Vertex v) { return is_floor(v); }) &&
           std::any_of(vertices_.begin(), vertices_.end(), [this](Vertex v) { return is_ceiling(v); });
  }

  void run(Levels& levels, std::vector<std::uint8_t>& at_rims) {
    const auto floor = [this](Vertex v) { return is_floor(v); };
    const auto ceiling = [this](Vertex v) { return is_ceiling(v); };
    const Counts up = count_along_facets(floor), down = count_along_facets(ceiling);
    find_free(up, down, at_rims);
    const Counts inner_up = count_inside(floor), inner_down = count_inside(ceiling);
    for (const Vertex v : vertices_) {
      const bool on_surface = where_.walls.is_on_surface(v);
      const unsigned to_floor = on_surface ? up[v] : inner_up[v];
      const unsigned all = to_floor + (on_surface ? down[v] : inner_down[v]);
      levels[v][direction_] =
          is_free_[v] != 0 ? Levels::kFree
                           : static_cast<std::uint8_t>((2U * where_.layers * to_floor + all) / (2 * all));
    }
  }

 private:
  [[nodiscard]] bool is_floor(Vertex v) const { return where_.walls.is_floor(v, direction_); }
  [[nodiscard]] bool is_ceiling(Vertex v) const { return where_.walls.is_ceiling(v, direction_); }

  // Over vertices that are neither floor nor ceiling.
  template <typename IsFirst>
  [[nodiscard]] Counts count_along_facets(const IsFirst& is_first) const {
    return count_edges(is_first, [&](Vertex v, const auto& act) {
      if (is_first(v) || !(is_floor(v) || is_ceiling(v)))
        for (const Walls::Edge& e : where_.walls.joined_to(v)) act(e[1]);
    });
  }

  void find_free(const Counts& up, const Counts& down, std::vector<std::uint8_t>& at_rims) {
    is_free_.assign(mesh_.vertex_count(), 0);
    for (const Vertex v : vertices_) {
      const bool is_at_rim = up[v] + down[v] < where_.layers;
      is_free_[v] = is_at_rim || where_.walls.is_both(v, direction_) ? 1 : 0;
      if (is_at_rim) at_rims[v] = 1;
    }
  }

  // Over vertices of the region that are not free.
  template <typename IsFirst>
  [[nodiscard]] Counts count_inside(const IsFirst& is_first) const {
    std::vector<Tet> tets;
    const auto is_counted = [&](Vertex v) { return is_free_[v] == 0 && is_first(v); };
    return count_edges(is_counted, [&](Vertex v, const auto& act) {
      tets.clear();
      ball(mesh_, v, tets);
      for (const Tet t : tets)
        if (!mesh_.is_ghost(t) && where_.volume.region_of[t] == where_.region)
          for (const Vertex w : mesh_.corners(t))
            if (is_free_[w] == 0) act(w);
    });
  }

  // Counts edges to the nearest `first` vertex, over the vertices to which `for_each_next` leads.
  template <typename IsFirst, typename ForEachNext>
  [[nodiscard]] Counts count_edges(const IsFirst& is_first, const ForEachNext& for_each_next) const {
    Counts count(mesh_.vertex_count(), where_.layers);
    std::vector<Vertex> front, next;
    for (const Vertex v : vertices_)
      if (is_first(v)) {
        count[v] = 0;
        front.push_back(v);
      }
    for (std::uint8_t far = 1; far < where_.layers && !front.empty(); ++far, front.swap(next)) {
      next.clear();
      for (const Vertex v : front) {
        where_.monitor.poll_again();
        for_each_next(v, [&](Vertex w) {
          if (count[w] <= far) return;
          count[w] = far;
          next.push_back(w);
        });
      }
    }
    return count;
  }

  const BetweenWalls& where_;
  TetMesh& mesh_;
  const std::span<const Vertex> vertices_;
  const std::size_t direction_;
  std::vector<std::uint8_t> is_free_;  // by vertex
};

}  // namespace

bool number_levels(const BetweenWalls& where, std::span<const Vertex> vertices, std::size_t direction,
                   Levels& levels, std::vector<std::uint8_t>& at_rims) {
  LevelNumbering numbering(where, vertices, direction);
  if (!numbering.has_floors_and_ceilings()) return false;
  numbering.run(levels, at_rims);
  return true;
}

}  // namespace holdfast
