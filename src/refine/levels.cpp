#include "refine/levels.h"

#include <algorithm>

namespace holdfast {

Vector Levels::direction(std::size_t k) {
  constexpr std::array<std::array<int, 3>, kDirections> kCube{{{1, 0, 0},
                                                               {0, 1, 0},
                                                               {0, 0, 1},
                                                               {1, 1, 0},
                                                               {1, -1, 0},
                                                               {1, 0, 1},
                                                               {1, 0, -1},
                                                               {0, 1, 1},
                                                               {0, 1, -1},
                                                               {1, 1, 1},
                                                               {1, 1, -1},
                                                               {1, -1, 1},
                                                               {1, -1, -1}}};
  const auto& d = kCube[k];
  const Vector v{static_cast<double>(d[0]), static_cast<double>(d[1]), static_cast<double>(d[2])};
  const double size = length(v);
  return {v[0] / size, v[1] / size, v[2] / size};
}

const Levels::OfVertex& Levels::all_free() {
  static constexpr OfVertex kAllFree = [] {
    OfVertex all{};
    all.fill(kFree);
    return all;
  }();
  return kAllFree;
}

bool Levels::may_join(Vertex v, Vertex w) const {
  const OfVertex &x = of(v), &y = of(w);
  for (std::size_t k = 0; k < kDirections; ++k)
    if (differ_too_much(x[k], y[k])) return false;
  return true;
}

bool Levels::allow(const TetMesh& mesh, std::span<const Tet> old_tets,
                   std::span<const TetMesh::Corners> fresh) const {
  const auto was_there = [&](Vertex v, Vertex w) {
    return std::any_of(old_tets.begin(), old_tets.end(),
                       [&](Tet t) { return mesh.index_of(t, v) >= 0 && mesh.index_of(t, w) >= 0; });
  };
  for (const TetMesh::Corners& c : fresh)
    for (int edge = 0; edge < 6; ++edge) {
      const auto [v, w] = ends_of_edge(c, edge);
      if (!may_join(v, w) && !was_there(v, w)) return false;
    }
  return true;
}

}  // namespace holdfast
