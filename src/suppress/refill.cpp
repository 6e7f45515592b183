#include "suppress/refill.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "mesh/kernel.h"
#include "mesh/replace.h"
#include "mesh/traverse.h"
#include "suppress/cavity.h"

namespace holdfast {
namespace {

Kernel kernel_of(const TetMesh& mesh, const Cavity& cavity) {
  Kernel kernel(mesh);
  for (const auto& f : cavity.faces()) kernel.add(f[0], f[1], f[2]);
  return kernel;
}

void cone(TetMesh& mesh, const Cavity& cavity, Vertex apex) {
  std::vector<TetMesh::Corners> fresh;
  for (const auto& f : cavity.faces()) fresh.push_back({f[0], f[1], f[2], apex});
  replace(mesh, {.old_tets = cavity.tets(), .new_tets = fresh});
}

bool grow_across_tightest(Cavity& cavity, const std::vector<double>& heights) {
  std::vector<std::size_t> order(heights.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t i, std::size_t j) { return heights[i] < heights[j]; });
  return std::any_of(order.begin(), order.end(), [&](std::size_t k) { return cavity.grow_across(k); });
}

}  // namespace

bool refill_without(TetMesh& mesh, Vertex p, const Growth& growth, std::mt19937_64& random) {
  std::vector<Tet> tets;
  ball(mesh, p, tets);
  for (int attempt = 0; attempt < growth.attempts; ++attempt) {
    Cavity cavity(mesh, tets);
    for (int step = 0; step < growth.steps; ++step) {
      if (!cavity.grow(random) || cavity.vertex_count() > growth.search.most_vertices) break;
      if (const auto fresh = fill_polyhedron(mesh, cavity.faces(), growth.search)) {
        replace(mesh, {.old_tets = cavity.tets(), .new_tets = *fresh});
        mesh.remove_vertex(p);
        return true;
      }
    }
  }
  return false;
}

bool round_with_neighbours(TetMesh& mesh, Vertex p, int steps) {
  std::vector<Tet> tets;
  ball(mesh, p, tets);
  Cavity cavity(mesh, tets);
  for (int step = 0; step <= steps; ++step) {
    const Kernel kernel = kernel_of(mesh, cavity);
    const Kernel::Centre centre = kernel.centre(mesh.point(p));
    if (const auto position = kernel.double_at(mesh.point(p), centre)) {
      mesh.move_vertex(p, *position);
      cone(mesh, cavity, p);
      return true;
    }
    if (!grow_across_tightest(cavity, centre.heights)) return false;
  }
  return false;
}

}  // namespace holdfast
