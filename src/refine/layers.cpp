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
#include "refine/walls.h"

namespace holdfast {
namespace {

// The levels from 1 to n - 1, each middle level before those of its halves.
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

Point between(const Point& a, const Point& b, double share) {
  Point x;
  for (std::size_t i = 0; i < 3; ++i) x[i] = a[i] + share * (b[i] - a[i]);
  return x;
}

bool is_between(std::uint8_t level, std::uint8_t x, std::uint8_t y) {
  return x != Levels::kFree && y != Levels::kFree && std::min(x, y) < level && level < std::max(x, y);
}

// Splits edges of a region at levels.
class EdgeParter {
 public:
  EdgeParter(const VolumeData& volume, std::span<const Tet> tets, Levels& levels, Monitor& monitor)
      : volume_(volume),
        mesh_(volume.mesh),
        tets_(tets.begin(), tets.end()),
        region_(volume.region_of[tets.front()]),
        levels_(levels),
        monitor_(monitor) {}

  /// The tetrahedra of the region, ascending.
  [[nodiscard]] std::span<const Tet> tets() const { return tets_; }
  [[nodiscard]] std::size_t points() const { return points_; }

  /// Splits the edges that jump over a level in direction k.
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

 private:
  static constexpr std::size_t kMostShell = 10'000;  // so many that hardly any edge is left out

  [[nodiscard]] bool is_of_region(Tet t) const {
    return mesh_.alive(t) && !mesh_.is_ghost(t) && volume_.region_of[t] == region_;
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
    const Point x = between(mesh_.position(a), mesh_.position(b), share);
    if (!put(x)) {
      const std::optional<Point> other = place_in_kernel(x);
      if (!other || !put(*other)) return false;
    }
    const Vertex p = static_cast<Vertex>(mesh_.vertex_count() - 1);
    levels_[p] = levels_on_edge();
    levels_[p][k] = level;
    ++points_;
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

  // False, with the mesh unchanged, if that place does not see all faces.
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

  // Levels for a point on the edge in shell_: in each direction, the level of an end that fits all of the
  // link.
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

  const VolumeData& volume_;
  TetMesh& mesh_;
  std::vector<Tet> tets_;
  const RegionId region_;
  Levels& levels_;
  Monitor& monitor_;
  EdgeShell shell_;  // of the edge that is split
  std::vector<TetMesh::Corners> fresh_;
  std::vector<Tet> created_;
  std::size_t points_ = 0;
};

std::vector<Vertex> vertices_of(const TetMesh& mesh, std::span<const Tet> tets) {
  std::vector<Vertex> vertices;
  for (const Tet t : tets)
    for (const Vertex v : mesh.corners(t)) vertices.push_back(v);
  sort_unique(vertices);
  return vertices;
}

void count_what_is_left(const TetMesh& mesh, std::span<const Tet> tets, const Levels& levels,
                        Monitor& monitor, LayerStats& stats) {
  constexpr std::size_t kMostPlaces = 100;
  std::vector<std::array<Vertex, 2>> left;
  for (const Tet t : tets) {
    monitor.poll_again();
    for (int edge = 0; edge < 6; ++edge) {
      const auto [a, b] = ends_of_edge(mesh.corners(t), edge);
      if (!levels.may_join(a, b)) left.push_back(ascending(std::array{a, b}));
    }
  }
  sort_unique(left);
  stats.left = left.size();
  for (const auto& [a, b] : std::span(left).first(std::min(left.size(), kMostPlaces)))
    stats.places.push_back(between(mesh.position(a), mesh.position(b), 0.5));
}

}  // namespace

LayerStats make_layers(const VolumeData& volume, std::span<const Tet> tets, unsigned layers, Levels& levels,
                       Monitor& monitor) {
  const TetMesh& mesh = volume.mesh;
  levels.clear();
  const Walls walls(mesh, tets, monitor);
  const BetweenWalls where{volume, volume.region_of[tets.front()], walls, static_cast<std::uint8_t>(layers),
                           monitor};
  std::vector<std::uint8_t> at_rims(mesh.vertex_count(), 0);
  EdgeParter parter(volume, tets, levels, monitor);
  for (std::size_t k = 0; k < Levels::kDirections; ++k) {
    at_rims.resize(mesh.vertex_count(), 0);
    if (!number_levels(where, vertices_of(mesh, parter.tets()), k, levels, at_rims)) continue;
    for (const std::uint8_t level : in_halves(layers)) parter.part_at(k, level);
  }
  LayerStats stats;
  stats.points = parter.points();
  stats.at_rims = static_cast<std::size_t>(std::count(at_rims.begin(), at_rims.end(), 1));
  count_what_is_left(mesh, parter.tets(), levels, monitor, stats);
  return stats;
}

}  // namespace holdfast
