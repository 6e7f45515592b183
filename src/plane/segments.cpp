// Where a segment passes through a closed triangulation.
#include "plane/segments.h"

namespace holdfast::plane {

bool find_passage(const Triangles& mesh, const Points& points, Vertex a, Vertex b, Passage& found) {
  found.edge = kNoEdge;
  found.crossed.clear();
  const EdgeCode first = mesh.edge_from(a);
  if (first == kNoEdge) return false;
  EdgeCode e = first, leave = kNoEdge;
  do {
    const Vertex right = mesh.to(e), left = mesh.apex(e);
    if (right == b) {
      found.edge = e;
      return true;
    }
    if (right != kNoVertex) {
      const int side = points.orient(a, b, right);
      if (side == 0 && points.between(a, b, right)) return false;
      if (side < 0 && left != kNoVertex && left != b && points.orient(a, b, left) > 0) leave = next_edge(e);
    }
    e = mesh.turn_right(e);
  } while (e != first);

  // The side of ab on which the corner opposite the edge lies gives the edge through which ab leaves.
  while (leave != kNoEdge) {
    if (mesh.constrained(leave)) return false;
    found.crossed.push_back(leave);
    const EdgeCode entered = mesh.across(leave);
    const Vertex corner = mesh.apex(entered);
    if (corner == b) return true;
    const int side = points.orient(a, b, corner);
    if (side == 0) return false;
    leave = side > 0 ? next_edge(entered) : previous_edge(entered);
  }
  return false;
}

}  // namespace holdfast::plane
