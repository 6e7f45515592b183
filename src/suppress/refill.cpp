#include "suppress/refill.h"

#include <vector>

#include "mesh/double_in_kernel.h"
#include "mesh/traverse.h"
#include "suppress/fill_cavity.h"
#include "suppress/tuning.h"

namespace holdfast {
namespace {

// A non-empty `tell` asks for complete searches and is called before each.
std::optional<Point> place_in(const TetMesh& mesh, const Kernel& kernel, Vertex apex,
                              const Kernel::Centre& centre, const Tell& tell) {
  if (const auto place = kernel.double_at(mesh.point(apex), centre)) return place;
  if (!tell) return std::nullopt;
  tell();
  return find_double(mesh, kernel.faces()).point;
}

bool cone_grown(TetMesh& mesh, Cavity& cavity, Vertex apex, int steps, const Tell& tell) {
  const auto place = grow_until_placed(
      mesh, cavity, steps, [&](const Cavity&) { return mesh.point(apex); },
      [&](const Kernel& kernel, const Kernel::Centre& centre) {
        return place_in(mesh, kernel, apex, centre, tell);
      });
  if (place) cone(mesh, cavity, apex, nullptr, place);
  return place.has_value();
}

bool round(TetMesh& mesh, Vertex p, Vertex first_free, int steps, const Tell& tell) {
  std::vector<Tet> tets;
  ball(mesh, p, tets);
  Cavity cavity(mesh, tets, first_free);
  return cone_grown(mesh, cavity, p, steps, tell);
}

}  // namespace

bool refill_without(TetMesh& mesh, Vertex p, Vertex first_free, const Growth& growth,
                    std::mt19937_64& random) {
  std::vector<Tet> tets;
  ball(mesh, p, tets);
  if (tets.size() > 2 * growth.search.most_vertices) return false;  // Euler: there are 2 n - 4 faces
  for (int attempt = 0; attempt < growth.attempts; ++attempt) {
    Cavity cavity(mesh, tets, first_free);
    for (int step = 0; step < growth.steps; ++step) {
      if (!cavity.grow(random) || cavity.vertex_count() > growth.search.most_vertices) break;
      if (fill(mesh, cavity, growth.search)) return true;
    }
  }
  return false;
}

bool merge(TetMesh& mesh, Vertex p, Vertex neighbour, Vertex first_free, int steps,
           const PolyhedronOptions& search) {
  std::vector<Tet> tets;
  ball(mesh, p, tets);
  if (tets.size() > tuning::kMostMerged) return false;
  Cavity cavity(mesh, tets, first_free);
  tets.clear();
  ball(mesh, neighbour, tets);
  if (tets.size() > tuning::kMostMerged) return false;
  return cavity.swallow(tets) && (fill(mesh, cavity, search) || cone_grown(mesh, cavity, p, steps, {}));
}

bool round_with_neighbours(TetMesh& mesh, Vertex p, Vertex first_free, int steps) {
  return round(mesh, p, first_free, steps, {});
}

bool round_completely(TetMesh& mesh, Vertex p, Vertex first_free, int steps, const Tell& tell) {
  return round(mesh, p, first_free, steps, tell);
}

bool round_completely(TetMesh& mesh, Vertex p, Vertex first_free, int steps, const Tell& tell,
                      std::mt19937_64& random) {
  std::vector<Tet> tets;
  ball(mesh, p, tets);
  Cavity cavity(mesh, tets, first_free);
  for (int step = 0; step < steps && cavity.grow(random); ++step) {
    tell();
    const auto place = find_double(mesh, cavity.faces()).point;
    if (!place) continue;
    cone(mesh, cavity, p, nullptr, place);
    return true;
  }
  return false;
}

}  // namespace holdfast
