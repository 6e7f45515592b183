#include "optimise/reconnect.h"

#include <algorithm>

#include "mesh/edge_removal.h"
#include "optimise/badness.h"
#include "optimise/tuning.h"
#include "suppress/fill_cavity.h"

namespace holdfast {
namespace {

class Reconnection {
 public:
  Reconnection(TetMesh& mesh, Vertex first_free, const BadFrom& bad_from, std::mt19937_64& random,
               std::vector<Tet>& created)
      : mesh_(mesh), first_free_(first_free), bad_from_(bad_from), random_(random), created_(created) {}

  // Every attempt grows the cavity from the same tetrahedra in another way.
  bool from(std::span<const Tet> seed, const tuning::Reconnecting& effort) {
    for (int attempt = 0; attempt < effort.attempts; ++attempt) {
      Cavity cavity(mesh_, seed, first_free_);
      known_ = 0;
      worst_ = 0;
      for (int step = 0; step < effort.steps; ++step) {
        if (cavity.vertex_count() > effort.most_vertices) break;
        if (cavity.tets().size() >= tuning::kLeastTets && step % effort.every == 0 &&
            fill(cavity, {.most_vertices = effort.most_vertices, .most_nodes = effort.most_nodes}))
          return true;
        if (!cavity.grow(random_)) break;
      }
    }
    return false;
  }

 private:
  bool fill(const Cavity& cavity, PolyhedronOptions search) {
    for (; known_ < cavity.tets().size(); ++known_)
      worst_ = std::max(worst_, quality_of(mesh_, mesh_.corners(cavity.tets()[known_])));
    search.worst_quality = bad_from_.limit_for(worst_);
    return holdfast::fill(mesh_, cavity, search, &created_);
  }

  TetMesh& mesh_;
  const Vertex first_free_;
  const BadFrom& bad_from_;
  std::mt19937_64& random_;
  std::vector<Tet>& created_;
  // Number of the cavity's tetrahedra that were in it at the last search.
  std::size_t known_ = 0;
  double worst_ = 0;
};

}  // namespace

bool reconnect(TetMesh& mesh, Tet t, Vertex first_free, const BadFrom& bad_from, bool patient,
               std::mt19937_64& random, std::vector<Tet>& created) {
  Reconnection reconnection(mesh, first_free, bad_from, random, created);
  const std::array<Tet, 1> alone{t};
  if (quality_of(mesh, mesh.corners(t)) < bad_from.flat) return reconnection.from(alone, tuning::kUsual);
  const tuning::Reconnecting& effort = patient ? tuning::kPatient : tuning::kForFlat;
  // Some edge of a flat tetrahedron must be removed.
  for (const int edge : wide_edges(mesh, t)) {
    const auto [a, b] = ends_of_edge(mesh.corners(t), edge);
    EdgeShell shell;
    if (gather_shell(mesh, t, a, b, shell) && reconnection.from(shell.tets, effort)) return true;
  }
  return reconnection.from(alone, effort);
}

}  // namespace holdfast
