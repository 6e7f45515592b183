#include "mesh/traverse.h"

#include <algorithm>
#include <unordered_set>

#include "numbers/random.h"
#include "numbers/sorted.h"

namespace holdfast {
namespace {

// Visits the ball of v in breadth-first order until `stop` says so; returns where it stopped.
template <typename Stop>
Tet visit_ball(TetMesh& mesh, Vertex v, std::vector<Tet>& out, Stop stop) {
  const std::size_t first = out.size();
  Tet found = kNone;
  const Tet start = mesh.incident(v);
  if (start == kNone) return kNone;
  out.push_back(start);
  mesh.mark_visited(start);
  for (std::size_t k = first; k < out.size() && found == kNone; ++k) {
    const Tet t = out[k];
    if (stop(t)) found = t;
    for (int i = 0; i < 4; ++i) {
      if (mesh.corner(t, i) == v) continue;
      const Tet s = tet_of(mesh.neighbour(t, i));
      if ((mesh.flags(s) & kVisited) != 0) continue;
      mesh.mark_visited(s);
      out.push_back(s);
    }
  }
  for (std::size_t k = first; k < out.size(); ++k) mesh.clear_visited(out[k]);
  return found;
}

}  // namespace

void ball(TetMesh& mesh, Vertex v, std::vector<Tet>& out) {
  visit_ball(mesh, v, out, [](Tet) { return false; });
}

void ball_without_marks(const TetMesh& mesh, Vertex v, std::vector<Tet>& out) {
  const Tet start = mesh.incident(v);
  if (start == kNone) return;
  std::unordered_set<Tet> seen{start};
  const std::size_t first = out.size();
  out.push_back(start);
  for (std::size_t k = first; k < out.size(); ++k)
    for (int i = 0; i < 4; ++i) {
      if (mesh.corner(out[k], i) == v) continue;
      const Tet next = tet_of(mesh.neighbour(out[k], i));
      if (seen.insert(next).second) out.push_back(next);
    }
}

std::vector<Vertex> link_vertices(TetMesh& mesh, Vertex v) {
  std::vector<Tet> tets;
  ball(mesh, v, tets);
  std::vector<Vertex> out;
  for (const Tet t : tets)
    for (const Vertex w : mesh.corners(t))
      if (w != v && w != kGhost) out.push_back(w);
  sort_unique(out);
  return out;
}

void shell(const TetMesh& mesh, Tet t, Vertex a, Vertex b, std::vector<Tet>& out) {
  const Tet start = t;
  do {
    out.push_back(t);
    t = tet_of(mesh.neighbour(t, opposite_corners(mesh.index_of(t, a), mesh.index_of(t, b))[0]));
  } while (t != start);
}

Tet find_edge(TetMesh& mesh, Vertex a, Vertex b) {
  std::vector<Tet> scratch;
  return visit_ball(mesh, a, scratch, [&](Tet t) { return mesh.index_of(t, b) >= 0; });
}

Face find_face(TetMesh& mesh, Vertex a, Vertex b, Vertex c) {
  const Tet t = find_edge(mesh, a, b);
  return t == kNone ? kNone : find_face_round(mesh, t, a, b, c);
}

Face find_face_round(const TetMesh& mesh, Tet start, Vertex a, Vertex b, Vertex c) {
  Tet t = start;
  do {
    const int k = mesh.index_of(t, c);
    const auto [c0, c1] = opposite_corners(mesh.index_of(t, a), mesh.index_of(t, b));
    if (k >= 0) return face_code(t, c0 == k ? c1 : c0);
    t = tet_of(mesh.neighbour(t, c0));
  } while (t != start);
  return kNone;
}

Tet walk_to(const TetMesh& mesh, Vertex v, Tet start, std::uint32_t& random) {
  constexpr int kMostSteps = 2000;  // a walk that takes more is going round in circles
  Tet t = start;
  Tet from = kNone;
  for (int step = 0; step < kMostSteps; ++step) {
    if (mesh.is_ghost(t)) return t;
    random = numbers::next_congruential(random);
    const auto first = static_cast<int>(random >> 30);
    bool moved = false;
    for (int k = 0; k < 4 && !moved; ++k) {
      const int i = (first + k) & 3;
      const Tet next = tet_of(mesh.neighbour(t, i));
      if (next == from) continue;
      const auto f = mesh.face_vertices(face_code(t, i));
      if (mesh.orient(f[0], f[1], f[2], v) >= 0) continue;
      from = t;
      t = next;
      moved = true;
    }
    if (!moved) return t;
  }
  return kNone;
}

}  // namespace holdfast
