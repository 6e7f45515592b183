#include "optimise/insert_point.h"

#include <algorithm>

#include "mesh/edge_removal.h"
#include "mesh/editor.h"
#include "mesh/quality.h"
#include "optimise/badness.h"
#include "optimise/tuning.h"
#include "suppress/fill_cavity.h"

namespace holdfast {
namespace {

constexpr double kLeastRadius = 1e-14;  // of the kernel, in sizes of the cavity

Point middle_of(const TetMesh& mesh, const Cavity& cavity) {
  Point sum{};
  for (const auto& f : cavity.faces())
    for (const Vertex v : f)
      for (std::size_t k = 0; k < 3; ++k) sum[k] += mesh.position(v)[k];
  for (double& x : sum) x /= static_cast<double>(3 * cavity.faces().size());
  return sum;
}

double worst_from(const TetMesh& mesh, const Point& p, const Cavity& cavity) {
  double worst = 0;
  for (const auto& f : cavity.faces())
    worst = std::max(worst, quality(mesh.position(f[0]), mesh.position(f[1]), mesh.position(f[2]), p));
  return worst;
}

Vertex vertex_at(TetMesh& mesh, const Point& place, std::vector<Vertex>* spare) {
  if (spare == nullptr) return MeshEditor(mesh).add_vertex(place);
  const Vertex p = spare->back();
  spare->pop_back();
  MeshEditor(mesh).move_vertex(p, place);
  return p;
}

Vertex insert_into(TetMesh& mesh, Cavity cavity, double most, std::vector<Vertex>* spare,
                   std::vector<Tet>& created) {
  Point middle{};
  const auto origin = [&](const Cavity& grown) -> exact::PointRef {
    middle = middle_of(mesh, grown);
    return {middle.data(), nullptr};
  };
  const auto place_in = [&](const Kernel& kernel, const Kernel::Centre& centre) -> std::optional<Point> {
    // Null elements would result; a search for a double in such a kernel is long exact work for nothing.
    if (!(centre.radius > kLeastRadius * centre.size)) return std::nullopt;
    std::optional<Point> place = kernel.double_at({middle.data(), nullptr}, centre);
    if (place && !(worst_from(mesh, *place, cavity) < most)) place.reset();
    return place;
  };
  const auto place = grow_until_placed(mesh, cavity, tuning::kMostInsertSteps, origin, place_in);
  if (!place) return kNone;
  const Vertex p = vertex_at(mesh, *place, spare);
  cone(mesh, cavity, p, &created);
  return p;
}

}  // namespace

Vertex insert_point(TetMesh& mesh, Tet t, Vertex first_free, double most, std::vector<Vertex>* spare,
                    std::vector<Tet>& created) {
  for (const int edge : wide_edges(mesh, t)) {
    const auto [a, b] = ends_of_edge(mesh.corners(t), edge);
    EdgeShell shell;
    if (!gather_shell(mesh, t, a, b, shell)) continue;
    const Vertex p = insert_into(mesh, Cavity(mesh, shell.tets, first_free), most, spare, created);
    if (p != kNone) return p;
  }
  const std::array<Tet, 1> alone{t};
  return insert_into(mesh, Cavity(mesh, alone, first_free), most, spare, created);
}

}  // namespace holdfast
