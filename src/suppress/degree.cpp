#include "suppress/degree.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "mesh/traverse.h"

namespace holdfast {
namespace {

// The neighbours of p, each with a tetrahedron that holds both.
std::vector<std::pair<Vertex, Tet>> edges_at(TetMesh& mesh, Vertex p) {
  std::vector<Tet> tets;
  ball(mesh, p, tets);
  std::vector<std::pair<Vertex, Tet>> edges;
  for (const Tet t : tets)
    for (const Vertex q : mesh.corners(t))
      if (q != p && q != kGhost) edges.emplace_back(q, t);
  std::sort(edges.begin(), edges.end());
  const auto same = [](const auto& l, const auto& r) { return l.first == r.first; };
  edges.erase(std::unique(edges.begin(), edges.end(), same), edges.end());
  return edges;
}

constexpr std::size_t kMostEdges = 20;  // as many edges' budgets are spent on a point

}  // namespace

bool lower_degree(TetMesh& mesh, Flipper& flipper, Vertex p, int depth, std::size_t budget) {
  auto edges = edges_at(mesh, p);
  const std::size_t before = edges.size();
  std::size_t left = kMostEdges * budget;
  // Flips that clear the way for others can join p to more, so that the loop needs a measure.
  for (std::size_t last = before + 1; edges.size() < last && left > 0;) {
    last = edges.size();
    for (const auto& [q, t] : edges) {
      if (left == 0) break;
      if (!flipper.stands({t, {p, q}, 2})) continue;
      flipper.remove(t, p, q, depth, std::min(budget, left));
      left -= std::min(left, flipper.work());
    }
    edges = edges_at(mesh, p);
  }
  return edges.size() < before;
}

}  // namespace holdfast
