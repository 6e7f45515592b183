#include "optimise/insert_point.h"

#include <algorithm>

#include "mesh/edge_removal.h"
#include "mesh/kernel.h"
#include "mesh/quality.h"
#include "mesh/replace.h"
#include "optimise/badness.h"
#include "suppress/cavity.h"

namespace holdfast {
namespace {

constexpr int kMostSteps = 16;

class Insertion {
 public:
  Insertion(TetMesh& mesh, double most, std::vector<Tet>& created)
      : mesh_(mesh), most_(most), created_(created) {}

  // The cavity grows across the faces that leave the point least room.
  Vertex into(Cavity cavity) {
    for (int step = 0; step <= kMostSteps; ++step) {
      Kernel kernel(mesh_);
      for (const auto& f : cavity.faces()) kernel.add(f[0], f[1], f[2]);
      const Point origin = middle_of(cavity);
      const Kernel::Centre centre = kernel.centre({origin.data(), nullptr});
      const std::optional<Point> place = kernel.double_at({origin.data(), nullptr}, centre);
      if (place && worst_from(*place, cavity) < most_) return fill(cavity, *place);
      if (!cavity.grow_across_lowest(centre.heights)) break;
    }
    return kNone;
  }

 private:
  [[nodiscard]] Point middle_of(const Cavity& cavity) const {
    Point sum{};
    for (const auto& f : cavity.faces())
      for (const Vertex v : f)
        for (std::size_t k = 0; k < 3; ++k) sum[k] += mesh_.position(v)[k];
    for (double& x : sum) x /= static_cast<double>(3 * cavity.faces().size());
    return sum;
  }

  [[nodiscard]] double worst_from(const Point& p, const Cavity& cavity) const {
    double worst = 0;
    for (const auto& f : cavity.faces())
      worst = std::max(worst, quality(mesh_.position(f[0]), mesh_.position(f[1]), mesh_.position(f[2]), p));
    return worst;
  }

  Vertex fill(const Cavity& cavity, const Point& place) {
    const std::vector<Vertex> inner = cavity.inner();
    const Vertex p = mesh_.add_vertex(place);
    std::vector<TetMesh::Corners> fresh;
    for (const auto& f : cavity.faces()) fresh.push_back({f[0], f[1], f[2], p});
    replace(mesh_, {.old_tets = cavity.tets(), .new_tets = fresh}, &created_);
    for (const Vertex v : inner) mesh_.remove_vertex(v);
    return p;
  }

  TetMesh& mesh_;
  const double most_;
  std::vector<Tet>& created_;
};

}  // namespace

Vertex insert_point(TetMesh& mesh, Tet t, Vertex first_free, double most, std::vector<Tet>& created) {
  Insertion insertion(mesh, most, created);
  for (const int edge : wide_edges(mesh, t)) {
    const auto& ends = kEdgeVertex[static_cast<std::size_t>(edge)];
    EdgeShell shell;
    if (!gather_shell(mesh, t, mesh.corner(t, ends[0]), mesh.corner(t, ends[1]), shell)) continue;
    const Vertex p = insertion.into(Cavity(mesh, shell.tets, first_free));
    if (p != kNone) return p;
  }
  const std::array<Tet, 1> alone{t};
  return insertion.into(Cavity(mesh, alone, first_free));
}

}  // namespace holdfast
