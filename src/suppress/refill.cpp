#include "suppress/refill.h"

#include <algorithm>
#include <vector>

#include "mesh/double_in_kernel.h"
#include "mesh/kernel.h"
#include "mesh/replace.h"
#include "mesh/traverse.h"
#include "suppress/cavity.h"

namespace holdfast {
namespace {

constexpr std::size_t kMostMerged = 200;  // tetrahedra of a ball: a cavity's growth is quadratic

Kernel kernel_of(const TetMesh& mesh, const Cavity& cavity) {
  Kernel kernel(mesh);
  for (const auto& f : cavity.faces()) kernel.add(f[0], f[1], f[2]);
  return kernel;
}

bool fill(TetMesh& mesh, const Cavity& cavity, const PolyhedronOptions& search) {
  const auto fresh = fill_polyhedron(mesh, cavity.faces(), search);
  if (!fresh) return false;
  const std::vector<Vertex> inner = cavity.inner();
  replace(mesh, {.old_tets = cavity.tets(), .new_tets = *fresh});
  for (const Vertex v : inner) mesh.remove_vertex(v);
  return true;
}

void cone(TetMesh& mesh, const Cavity& cavity, Vertex apex, const Point& position) {
  const std::vector<Vertex> inner = cavity.inner();
  std::vector<TetMesh::Corners> fresh;
  for (const auto& f : cavity.faces()) fresh.push_back({f[0], f[1], f[2], apex});
  mesh.move_vertex(apex, position);
  replace(mesh, {.old_tets = cavity.tets(), .new_tets = fresh});
  for (const Vertex v : inner)
    if (v != apex) mesh.remove_vertex(v);
}

// `tell`, called before each, asks for complete searches.
std::optional<Point> place_in(const TetMesh& mesh, const Kernel& kernel, Vertex apex,
                              const Kernel::Centre& centre, const Tell& tell) {
  if (const auto place = kernel.double_at(mesh.point(apex), centre)) return place;
  if (!tell) return std::nullopt;
  tell();
  return find_double(mesh, kernel.faces()).point;
}

// Across the faces that leave the centre least room until it can be had in doubles.
bool cone_grown(TetMesh& mesh, Cavity& cavity, Vertex apex, int steps, const Tell& tell) {
  for (int step = 0; step <= steps; ++step) {
    const Kernel kernel = kernel_of(mesh, cavity);
    const Kernel::Centre centre = kernel.centre(mesh.point(apex));
    if (const auto place = place_in(mesh, kernel, apex, centre, tell)) {
      cone(mesh, cavity, apex, *place);
      return true;
    }
    if (!cavity.grow_across_lowest(centre.heights)) return false;
  }
  return false;
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
  if (tets.size() > 2 * growth.search.most_vertices) return false;  // Euler: 2 n - 4 of them
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
  if (tets.size() > kMostMerged) return false;
  Cavity cavity(mesh, tets, first_free);
  tets.clear();
  ball(mesh, neighbour, tets);
  if (tets.size() > kMostMerged) return false;
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
    cone(mesh, cavity, p, *place);
    return true;
  }
  return false;
}

}  // namespace holdfast
