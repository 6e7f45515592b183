#include "refine/restore_delaunay.h"

#include <algorithm>
#include <deque>

#include "mesh/exchange.h"
#include "refine/tets_inside.h"
#include "refine/tuning.h"

namespace holdfast {
namespace {

[[nodiscard]] bool is_in_sphere(const TetMesh& mesh, const TetMesh::Corners& c, Vertex v) {
  return exact::insphere(mesh.position(c[0]).data(), mesh.position(c[1]).data(), mesh.position(c[2]).data(),
                         mesh.position(c[3]).data(), mesh.position(v).data()) > 0;
}

// Whether t has a face, not a facet, with the apex beyond it in the sphere of t.
[[nodiscard]] bool has_bad_face(const TetMesh& mesh, Tet t) {
  for (int i = 0; i < 4; ++i) {
    const Face f = face_code(t, i);
    if (mesh.is_facet(f)) continue;
    const Vertex beyond = mesh.apex(mesh.neighbour(f));
    if (beyond != kGhost && is_in_sphere(mesh, mesh.corners(t), beyond)) return true;
  }
  return false;
}

// The objective: the new tetrahedra are positive and Delaunay among themselves, and the old ones are not.
// Among all triangulations of their points, Delaunay ones are lowest when lifted to the paraboloid
// (Edelsbrunner, Seidel 1986). So no exchange is made twice, and the exchanges come to an end.
class BecomesDelaunay : public ExchangesInMesh {
 public:
  using Cost = int;  // all exchanges that fit are equally good: the first is taken

  explicit BecomesDelaunay(const TetMesh& mesh) : ExchangesInMesh(mesh, tuning::kMostShellForDelaunay) {}

  [[nodiscard]] std::optional<Cost> before(std::span<const Tet> tets) {
    if (taken_) return std::nullopt;
    vertices_.clear();
    for (const Tet t : tets)
      for (const Vertex v : mesh_.corners(t))
        if (std::find(vertices_.begin(), vertices_.end(), v) == vertices_.end()) vertices_.push_back(v);
    const bool is_delaunay =
        std::all_of(tets.begin(), tets.end(), [&](Tet t) { return is_empty(mesh_.corners(t)); });
    return is_delaunay ? std::nullopt : std::optional(0);
  }
  [[nodiscard]] std::optional<Cost> after(const std::array<TetMesh::Corners, 3>& three, Cost) const {
    const bool fit = std::all_of(three.begin(), three.end(), [&](const TetMesh::Corners& c) {
      return mesh_.orient(c[0], c[1], c[2], c[3]) > 0 && is_empty(c);
    });
    return fit ? std::optional(0) : std::nullopt;
  }
  [[nodiscard]] static bool gains(Cost, Cost) { return true; }
  bool take(Cost, Cost, std::span<const TetMesh::Corners>) {
    taken_ = true;
    return true;
  }

  struct Link {
    const BecomesDelaunay& objective;
    const EdgeShell& shell;

    static Cost none() { return 0; }
    static Cost join(Cost, Cost) { return 0; }
    static bool better(Cost, Cost) { return false; }
    static Cost diagonal(std::size_t, std::size_t) { return 0; }
    [[nodiscard]] std::optional<Cost> triangle(std::size_t i, std::size_t k, std::size_t j) const {
      const Vertex pi = shell.link[i], pk = shell.link[k], pj = shell.link[j];
      const bool fits = sees_both_ends(objective.mesh_, shell, i, k, j) &&
                        objective.is_empty({pi, pk, pj, shell.b}) &&
                        objective.is_empty({pj, pk, pi, shell.a});
      return fits ? std::optional(0) : std::nullopt;
    }
  };
  [[nodiscard]] Link link(const EdgeShell& shell, Cost) const { return {*this, shell}; }

 private:
  // Whether no vertex of the exchange is in the sphere.
  [[nodiscard]] bool is_empty(const TetMesh::Corners& c) const {
    return std::none_of(vertices_.begin(), vertices_.end(), [&](Vertex v) {
      return std::find(c.begin(), c.end(), v) == c.end() && is_in_sphere(mesh_, c, v);
    });
  }

  std::vector<Vertex> vertices_;
  bool taken_ = false;
};

void make(const VolumeData& volume, const Exchange& exchange, std::vector<Tet>& created) {
  const RegionId region = volume.region_of[exchange.old_tets.front()];
  created.clear();
  make(volume.mesh, exchange, created);
  volume.region_of.resize(volume.mesh.slot_count(), kNone);
  for (const Tet t : created) volume.region_of[t] = region;
}

}  // namespace

std::size_t restore_delaunay(const VolumeData& volume, const Threads& threads, Monitor& monitor) {
  const TetMesh& mesh = volume.mesh;
  const std::vector<Tet> bad = tets_inside(volume, threads, [&](Tet t) { return has_bad_face(mesh, t); });
  std::deque<Tet> queue(bad.begin(), bad.end());
  ExchangeSearch<BecomesDelaunay> search;
  std::vector<Tet> created;
  std::size_t count = 0;
  while (!queue.empty()) {
    monitor.poll(Stage::field_points, 0);
    const Tet t = queue.front();
    queue.pop_front();
    if (!volume.is_inside(t) || !has_bad_face(mesh, t)) continue;
    BecomesDelaunay objective(mesh);
    const Exchange* const exchange = search.best_at(t, objective);
    if (exchange == nullptr) continue;
    make(volume, *exchange, created);
    ++count;
    for (const Tet c : created)
      if (has_bad_face(mesh, c)) queue.push_back(c);
  }
  return count;
}

}  // namespace holdfast
