#include "refine/layers.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "mesh/edge_removal.h"
#include "mesh/editor.h"
#include "mesh/kernel.h"
#include "mesh/traverse.h"
#include "numbers/sorted.h"

namespace holdfast {
namespace {

using Key = std::uint64_t;

Key key_of(Vertex v, Vertex w) { return (Key{std::min(v, w)} << 32) | std::max(v, w); }

// Which directions a vertex is on a floor, or a ceiling, of: a bit for each.
struct Sides {
  std::uint16_t floors = 0, ceilings = 0;
};

// The levels from 1 to n - 1, each half of them before its halves.
std::vector<std::uint8_t> in_halves(unsigned n) {
  std::vector<std::uint8_t> order;
  std::vector<std::pair<unsigned, unsigned>> between{{0, n}};
  for (std::size_t i = 0; i < between.size(); ++i) {
    const auto [low, high] = between[i];
    if (high - low < 2) continue;
    const unsigned middle = low + (high - low) / 2;
    order.push_back(static_cast<std::uint8_t>(middle));
    between.emplace_back(low, middle);
    between.emplace_back(middle, high);
  }
  return order;
}

class LayerMaker {
 public:
  LayerMaker(const VolumeData& volume, std::span<const Tet> tets, unsigned layers, Levels& levels,
             Monitor& monitor)
      : volume_(volume),
        mesh_(volume.mesh),
        tets_(tets.begin(), tets.end()),
        region_(volume.region_of[tets.front()]),
        layers_(static_cast<std::uint8_t>(layers)),
        levels_(levels),
        monitor_(monitor) {}

  LayerStats run() {
    levels_.clear();
    find_sides();
    at_rims_.assign(mesh_.vertex_count(), 0);
    for (std::size_t k = 0; k < Levels::kDirections; ++k) {
      if (!number_in(k)) continue;
      for (const std::uint8_t level : in_halves(layers_)) part_at(k, level);
    }
    stats_.at_rims = static_cast<std::size_t>(std::count(at_rims_.begin(), at_rims_.end(), 1));
    count_what_is_left();
    return std::move(stats_);
  }

 private:
  static constexpr std::size_t kMostShell = 10'000;
  static constexpr std::size_t kMostPlaces = 100;

  [[nodiscard]] bool is_of_region(Tet t) const {
    return mesh_.alive(t) && !mesh_.is_ghost(t) && volume_.region_of[t] == region_;
  }

  void find_sides() {
    for (const Tet t : tets_) {
      monitor_.poll_again();
      for (const Vertex v : mesh_.corners(t)) vertices_.push_back(v);
      for (int i = 0; i < 4; ++i)
        if (const Face f = face_code(t, i); mesh_.is_facet(f)) note_facet(f);
    }
    sort_unique(vertices_);
    sort_unique(sides_of_facets_);
  }

  void note_facet(Face f) {
    const auto v = mesh_.face_vertices(f);
    for (std::size_t i = 0; i < 3; ++i)
      for (const Vertex w : {v[(i + 1) % 3], v[(i + 2) % 3]}) sides_of_facets_.push_back({v[i], w});
    const Point& p = mesh_.position(v[0]);
    const Vector inward = cross(mesh_.position(v[1]) - p, mesh_.position(v[2]) - p);
    const double size = length(inward);
    if (!(size > 0)) return;
    for (std::size_t k = 0; k < Levels::kDirections; ++k) {
      const double along = dot(inward, Levels::direction(k)) / size;
      const auto bit = static_cast<std::uint16_t>(1U << k);
      for (const Vertex x : v) {
        Sides& sides = sides_of(x);
        if (along > Levels::kCone) sides.floors |= bit;
        if (along < -Levels::kCone) sides.ceilings |= bit;
      }
    }
  }

  Sides& sides_of(Vertex v) {
    if (v >= sides_.size()) sides_.resize(mesh_.vertex_count());
    return sides_[v];
  }

  // What is both, as at the sharp edge of a wedge, is free.
  [[nodiscard]] bool is_floor(Vertex v, std::size_t k) const {
    return has(v, k, &Sides::floors, &Sides::ceilings);
  }
  [[nodiscard]] bool is_ceiling(Vertex v, std::size_t k) const {
    return has(v, k, &Sides::ceilings, &Sides::floors);
  }
  [[nodiscard]] bool has(Vertex v, std::size_t k, std::uint16_t Sides::*one,
                         std::uint16_t Sides::*other) const {
    if (v >= sides_.size()) return false;
    return ((sides_[v].*one >> k) & 1U) != 0 && ((sides_[v].*other >> k) & 1U) == 0;
  }
  [[nodiscard]] bool is_both(Vertex v, std::size_t k) const {
    return v < sides_.size() && ((sides_[v].floors & sides_[v].ceilings) >> k & 1U) != 0;
  }

  // Levels in proportion to the numbers of edges to a floor and to a ceiling: along an edge, each of them
  // changes by 1 at most, and so does the level where they are `layers_` together or more. Of vertices of the
  // surface they are counted along facets, whose edges stand: so no edge between two of them jumps over a
  // level, but at those on a way of fewer edges over the side between a floor and a ceiling, which are free.
  // Returns whether there are both floors and ceilings.
  bool number_in(std::size_t k) {
    const auto floor = [&](Vertex v) { return is_floor(v, k); };
    const auto ceiling = [&](Vertex v) { return is_ceiling(v, k); };
    if (std::none_of(vertices_.begin(), vertices_.end(), floor) ||
        std::none_of(vertices_.begin(), vertices_.end(), ceiling))
      return false;
    std::vector<std::uint8_t> up = count_along_facets(k, floor), down = count_along_facets(k, ceiling);
    free_.assign(mesh_.vertex_count(), 0);
    for (const Vertex v : vertices_) {
      const bool is_short = up[v] + down[v] < layers_;
      free_[v] = is_short || is_both(v, k) ? 1 : 0;
      if (is_short && v < at_rims_.size()) at_rims_[v] = 1;
    }
    const std::vector<std::uint8_t> inner_up = count_inside(floor), inner_down = count_inside(ceiling);
    for (const Vertex v : vertices_) {
      if (!is_on_surface(v)) {
        up[v] = inner_up[v];
        down[v] = inner_down[v];
      }
      const unsigned all = unsigned{up[v]} + down[v];
      levels_[v][k] =
          free_[v] != 0 ? Levels::kFree : static_cast<std::uint8_t>((2U * layers_ * up[v] + all) / (2 * all));
    }
    return true;
  }

  // Edges to the nearest of some vertices, over vertices that are neither floor nor ceiling; at most
  // `layers_`.
  template <typename IsFirst>
  [[nodiscard]] std::vector<std::uint8_t> count_along_facets(std::size_t k, const IsFirst& is_first) const {
    return count_edges(is_first, [&](Vertex v, const auto& act) {
      if (!is_first(v) && (is_floor(v, k) || is_ceiling(v, k))) return;
      for (auto side = facet_sides_at(v); side != sides_of_facets_.end() && (*side)[0] == v; ++side)
        act((*side)[1]);
    });
  }
  // Not through those that are free.
  template <typename IsFirst>
  [[nodiscard]] std::vector<std::uint8_t> count_inside(const IsFirst& is_first) {
    const auto is_counted = [&](Vertex v) { return free_[v] == 0 && is_first(v); };
    return count_edges(is_counted, [&](Vertex v, const auto& act) {
      ball_.clear();
      ball(mesh_, v, ball_);
      for (const Tet t : ball_)
        if (is_of_region(t))
          for (const Vertex w : mesh_.corners(t))
            if (free_[w] == 0) act(w);
    });
  }
  template <typename IsFirst, typename ForEachNext>
  [[nodiscard]] std::vector<std::uint8_t> count_edges(const IsFirst& is_first,
                                                      const ForEachNext& for_each_next) const {
    std::vector<std::uint8_t> count(mesh_.vertex_count(), layers_);
    std::vector<Vertex> front, next;
    for (const Vertex v : vertices_)
      if (is_first(v)) {
        count[v] = 0;
        front.push_back(v);
      }
    for (std::uint8_t far = 1; far < layers_ && !front.empty(); ++far, front.swap(next)) {
      next.clear();
      for (const Vertex v : front) {
        monitor_.poll_again();
        for_each_next(v, [&](Vertex w) {
          if (count[w] <= far) return;
          count[w] = far;
          next.push_back(w);
        });
      }
    }
    return count;
  }

  using SidesOfFacets = std::vector<std::array<Vertex, 2>>;
  [[nodiscard]] SidesOfFacets::const_iterator facet_sides_at(Vertex v) const {
    return std::lower_bound(sides_of_facets_.begin(), sides_of_facets_.end(), std::array<Vertex, 2>{v, 0});
  }
  [[nodiscard]] bool is_on_surface(Vertex v) const {
    const auto side = facet_sides_at(v);
    return side != sides_of_facets_.end() && (*side)[0] == v;
  }

  [[nodiscard]] static bool is_between(std::uint8_t level, std::uint8_t x, std::uint8_t y) {
    return x != Levels::kFree && y != Levels::kFree && std::min(x, y) < level && level < std::max(x, y);
  }

  void part_at(std::size_t k, std::uint8_t level) {
    std::vector<Tet> waiting(tets_);
    while (!waiting.empty()) {
      const Tet t = waiting.back();
      waiting.pop_back();
      monitor_.poll_again();
      if (!is_of_region(t)) continue;
      for (int edge = 0; edge < 6; ++edge) {
        const auto [a, b] = ends_of_edge(mesh_.corners(t), edge);
        if (!is_between(level, levels_.of(a)[k], levels_.of(b)[k])) continue;
        if (!gather_inside(t, edge) || !part(k, level)) continue;
        waiting.insert(waiting.end(), created_.begin(), created_.end());
        tets_.insert(tets_.end(), created_.begin(), created_.end());
        break;
      }
    }
    std::erase_if(tets_, [&](Tet t) { return !is_of_region(t); });
    sort_unique(tets_);
  }

  // False for edges of constraints.
  bool gather_inside(Tet t, int edge) {
    if (mesh_.is_segment(t, edge)) return false;
    const auto [a, b] = ends_of_edge(mesh_.corners(t), edge);
    return gather_round(mesh_, t, a, b, shell_, kMostShell, [&](Tet s, int i) {
      const Face f = face_code(s, i);
      const Tet next = tet_of(mesh_.neighbour(f));
      return mesh_.is_facet(f) || mesh_.is_ghost(next) ? kNone : next;
    });
  }

  // Puts a point of that level on the edge in shell_.
  bool part(std::size_t k, std::uint8_t level) {
    const Vertex a = shell_.a, b = shell_.b;
    const double from = levels_.of(a)[k], to = levels_.of(b)[k], share = (level - from) / (to - from);
    Point x;
    for (std::size_t i = 0; i < 3; ++i)
      x[i] = mesh_.position(a)[i] + share * (mesh_.position(b)[i] - mesh_.position(a)[i]);
    if (!put(x)) {
      const std::optional<Point> other = place_in_kernel(x);
      if (!other || !put(*other)) return false;
    }
    const Vertex p = static_cast<Vertex>(mesh_.vertex_count() - 1);
    levels_[p] = levels_on_edge();
    levels_[p][k] = level;
    vertices_.push_back(p);
    ++stats_.points;
    return true;
  }

  [[nodiscard]] std::optional<Point> place_in_kernel(const Point& near) const {
    Kernel kernel(mesh_);
    for (const Tet t : shell_.tets)
      for (const Vertex end : {shell_.a, shell_.b}) {
        const auto f = mesh_.face_vertices(face_code(t, mesh_.index_of(t, end)));
        kernel.add(f[0], f[1], f[2]);
      }
    const exact::PointRef origin{near.data(), nullptr};
    return kernel.double_at(origin, kernel.centre(origin));
  }

  // False, with the mesh as it was, where that place does not see all faces.
  bool put(const Point& x) {
    const Vertex p = MeshEditor(mesh_).add_vertex(x);
    fresh_.clear();
    for (const Tet t : shell_.tets)
      for (const Vertex end : {shell_.a, shell_.b}) {
        TetMesh::Corners c = mesh_.corners(t);
        std::replace(c.begin(), c.end(), end, p);
        fresh_.push_back(c);
      }
    if (!std::all_of(fresh_.begin(), fresh_.end(),
                     [&](const TetMesh::Corners& c) { return mesh_.orient(c[0], c[1], c[2], c[3]) > 0; })) {
      MeshEditor(mesh_).remove_last_vertex();
      return false;
    }
    const std::array<Vertex, 2> ends{shell_.a, shell_.b};
    volume_.sizes.resize(mesh_.vertex_count(), std::max(volume_.sizes[ends[0]], volume_.sizes[ends[1]]));
    if (volume_.metrics != nullptr) volume_.metrics->push_back(volume_.mean_metric(ends));
    created_.clear();
    MeshEditor(mesh_).replace({.old_tets = shell_.tets, .new_tets = fresh_}, &created_);
    volume_.region_of.resize(mesh_.slot_count(), kNone);
    for (const Tet t : created_) volume_.region_of[t] = region_;
    return true;
  }

  // Of a point on the edge in shell_: that of one of its ends which does for all of the link.
  [[nodiscard]] Levels::OfVertex levels_on_edge() const {
    Levels::OfVertex found = levels_.of(shell_.a);
    const Levels::OfVertex& other = levels_.of(shell_.b);
    for (std::size_t k = 0; k < Levels::kDirections; ++k) {
      const auto does = [&](std::uint8_t level) {
        return std::none_of(shell_.link.begin(), shell_.link.end(),
                            [&](Vertex w) { return Levels::differ_too_much(level, levels_.of(w)[k]); });
      };
      if (found[k] == Levels::kFree || (other[k] != Levels::kFree && !does(found[k]) && does(other[k])))
        found[k] = other[k];
    }
    return found;
  }

  void count_what_is_left() {
    std::vector<Key> seen;
    for (const Tet t : tets_) {
      monitor_.poll_again();
      for (int edge = 0; edge < 6; ++edge) {
        const auto [a, b] = ends_of_edge(mesh_.corners(t), edge);
        if (!levels_.may_join(a, b)) seen.push_back(key_of(a, b));
      }
    }
    sort_unique(seen);
    stats_.left = seen.size();
    for (const Key key : std::span(seen).first(std::min(seen.size(), kMostPlaces))) {
      const Point &p = mesh_.position(static_cast<Vertex>(key >> 32)),
                  &q = mesh_.position(static_cast<Vertex>(key));
      stats_.places.push_back(
          {p[0] + 0.5 * (q[0] - p[0]), p[1] + 0.5 * (q[1] - p[1]), p[2] + 0.5 * (q[2] - p[2])});
    }
  }

  const VolumeData& volume_;
  TetMesh& mesh_;
  std::vector<Tet> tets_;  // of the region
  const RegionId region_;
  const std::uint8_t layers_;
  Levels& levels_;
  Monitor& monitor_;
  std::vector<Vertex> vertices_;    // of the region
  std::vector<Sides> sides_;        // by vertex; none for those added here
  SidesOfFacets sides_of_facets_;   // each both ways, ascending
  std::vector<std::uint8_t> free_;  // by vertex: whether the direction at hand has no demand for it
  std::vector<std::uint8_t>
      at_rims_;  // by vertex that there was: whether a direction leaves it out as on a short way
  std::vector<Tet> ball_, created_;
  EdgeShell shell_;
  std::vector<TetMesh::Corners> fresh_;
  LayerStats stats_;
};

}  // namespace

LayerStats make_layers(const VolumeData& volume, std::span<const Tet> tets, unsigned layers, Levels& levels,
                       Monitor& monitor) {
  return LayerMaker(volume, tets, layers, levels, monitor).run();
}

}  // namespace holdfast
