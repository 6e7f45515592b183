// Checks of a Delaunay mesh that share no code with the kernel: structure, local Delaunay property,
// convex hull, ghosts, Euler's relation, use of every distinct point.
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <set>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include "exact/predicates.h"
#include "mesh/editor.h"
#include "mesh/tet_mesh.h"
#include "mesh/validate.h"

namespace holdfast::testing {

inline TetMesh mesh_of(std::span<const Point> points) {
  TetMesh mesh;
  for (const Point& p : points) MeshEditor(mesh).add_vertex(p);
  return mesh;
}

// A point's coordinates as a key: -0 and +0 are one.
inline Point key_of(const Point& p) { return {p[0] + 0.0, p[1] + 0.0, p[2] + 0.0}; }

// The faces of every finite cell against the vertex across. Locally Delaunay everywhere and a convex
// hull imply globally Delaunay (Delaunay's lemma).
inline std::string local_fault(const TetMesh& mesh, Tet t) {
  const auto& c = mesh.corners(t);
  const auto at = [&](Vertex v) { return mesh.position(v).data(); };
  for (int i = 0; i < 4; ++i) {
    const Face across = mesh.neighbour(t, i);
    const Vertex apex = mesh.apex(across);
    if (mesh.is_ghost(t)) {
      // Hull edges: the apex of the next hull face must not be beyond this one.
      if (i == 3) continue;
      if (!mesh.is_ghost(tet_of(across))) return "a ghost's side meets no ghost";
      if (exact::orient3d(at(c[0]), at(c[1]), at(c[2]), at(apex)) > 0) return "the hull is not convex";
      continue;
    }
    if (apex == kGhost) {
      if (side_of(across) != 3) return "a ghost not in slot 3";
      const auto& g = mesh.corners(tet_of(across));
      if (exact::orient3d(at(g[0]), at(g[1]), at(g[2]), at(c[static_cast<std::size_t>(i)])) >= 0)
        return "a ghost turned the wrong way";
      continue;
    }
    if (exact::insphere(at(c[0]), at(c[1]), at(c[2]), at(c[3]), at(apex)) > 0)
      return "a face not locally Delaunay";
  }
  return {};
}

// V - E + F - T = 1 for a ball, counted with the ghosts left out, and 2 for the hull's sphere.
inline std::string euler_fault(const TetMesh& mesh) {
  std::size_t finite = 0, hull = 0, vertices = 0;
  std::vector<std::uint64_t> edges;
  for (Tet t = 0; t < mesh.slot_count(); ++t) {
    if (!mesh.alive(t)) continue;
    if (mesh.is_ghost(t)) {
      ++hull;
      continue;
    }
    ++finite;
    for (const auto& e : kEdgeVertex) {
      const auto [a, b] = std::minmax({mesh.corner(t, e[0]), mesh.corner(t, e[1])});
      edges.push_back(std::uint64_t{a} << 32 | b);
    }
  }
  for (Vertex v = 0; v < mesh.vertex_count(); ++v) vertices += mesh.in_mesh(v) ? 1 : 0;
  std::sort(edges.begin(), edges.end());
  const auto edge_count = static_cast<std::size_t>(std::unique(edges.begin(), edges.end()) - edges.begin());
  const std::size_t faces = (4 * finite + hull) / 2;
  return vertices + faces == 1 + edge_count + finite ? std::string{} : "Euler's relation fails";
}

// Every distinct point is used once, by its first vertex.
inline std::string use_fault(const TetMesh& mesh) {
  std::set<Point> seen;
  for (Vertex v = 0; v < mesh.vertex_count(); ++v) {
    const bool first = seen.insert(key_of(mesh.position(v))).second;
    if (mesh.in_mesh(v) != first)
      return "vertex " + std::to_string(v) + (first ? " is not used" : " is a duplicate in use");
  }
  return {};
}

// The first fault of a Delaunay mesh, or an empty string.
inline std::string delaunay_fault(const TetMesh& mesh) {
  if (std::string fault = find_fault(mesh); !fault.empty()) return fault;
  for (Tet t = 0; t < mesh.slot_count(); ++t)
    if (mesh.alive(t))
      if (std::string fault = local_fault(mesh, t); !fault.empty()) return std::to_string(t) + ": " + fault;
  if (std::string fault = euler_fault(mesh); !fault.empty()) return fault;
  return use_fault(mesh);
}

}  // namespace holdfast::testing
