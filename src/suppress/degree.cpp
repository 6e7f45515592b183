#include "suppress/degree.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesh/traverse.h"
#include "suppress/tuning.h"

namespace holdfast {
namespace {

// An edge from p to a neighbour, with a tetrahedron that contains it.
struct EdgeAt {
  Vertex to;
  Tet tet;
};

// All edges at p, each with the lowest tetrahedron that contains it; an edge is in six on average. With
// hundreds of neighbours, sorting is most of the work. Hence the keys are numbers, not pairs, and few keys
// are of the same edge: if the last key with the same lowest bits is of the same edge, it gets the lower
// tetrahedron instead of a second key.
std::vector<EdgeAt> edges_at(TetMesh& mesh, Vertex p) {
  std::vector<Tet> tets;
  ball(mesh, p, tets);
  std::vector<std::uint64_t> keys;
  keys.reserve(tets.size());
  std::vector<std::size_t> last(std::bit_ceil(tets.size() + 1), 0);  // index into `keys`, by the lowest bits
  for (const Tet t : tets)
    for (const Vertex q : mesh.corners(t)) {
      if (q == p || q == kGhost) continue;
      const std::uint64_t key = std::uint64_t{q} << 32 | t;
      std::size_t& at = last[q & (last.size() - 1)];
      if (at < keys.size() && keys[at] >> 32 == q) {
        keys[at] = std::min(keys[at], key);
      } else {
        at = keys.size();
        keys.push_back(key);
      }
    }
  std::sort(keys.begin(), keys.end());
  std::vector<EdgeAt> edges;
  for (const std::uint64_t key : keys) {
    const auto q = static_cast<Vertex>(key >> 32);
    if (edges.empty() || edges.back().to != q) edges.push_back({q, static_cast<Tet>(key)});
  }
  return edges;
}

}  // namespace

bool lower_degree(TetMesh& mesh, Flipper& flipper, Vertex p, int depth, std::size_t budget) {
  auto edges = edges_at(mesh, p);
  const std::size_t before = edges.size();
  std::size_t left = tuning::kMostEdges * budget;
  // Flips that clear the way for others can join p to more vertices, so the loop needs a measure.
  for (std::size_t last = before + 1; edges.size() < last && left > 0;) {
    last = edges.size();
    const std::size_t flips = flipper.counts().all();
    for (const auto& [q, t] : edges) {
      if (left == 0) break;
      if (!flipper.stands({t, {p, q}, 2})) continue;
      flipper.remove(t, p, q, depth, std::min(budget, left));
      left -= std::min(left, flipper.work());
    }
    if (flipper.counts().all() == flips) break;
    edges = edges_at(mesh, p);
  }
  return edges.size() < before;
}

}  // namespace holdfast
