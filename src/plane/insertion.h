// Inserts points into constrained Delaunay triangles that are not closed: the mesh ends at its constraints.
#pragma once

#include "plane/triangles.h"

namespace holdfast::plane {

class Insertion {
 public:
  /// `mesh` must have its stars (find_stars).
  Insertion(Triangles& mesh, const Points& points) : mesh_(mesh), points_(points) {}

  /// Calls `visit` for the triangles at an inserted vertex. Those at another vertex may not be connected over
  /// edges.
  template <typename Visit>
  void each_at(Vertex v, Visit&& visit) const;

  /// Locates a point along a straight line from inside a triangle.
  struct Place {
    enum class Kind { inside, on_edge, behind_constraint, nowhere };
    Kind kind = Kind::nowhere;
    std::uint32_t triangle = kNoVertex;  ///< that contains it
    EdgeCode edge = kNoEdge;             ///< on which it lies, or the first constraint that hides it
  };
  /// Locates p from `start`, which lies strictly inside triangle t.
  [[nodiscard]] Place locate(Vertex p, Vertex start, std::uint32_t t) const;

  /// Inserts p into a triangle, which must contain it strictly, and makes the mesh constrained Delaunay
  /// again.
  void insert_inside(std::uint32_t t, Vertex p);
  /// The same on an edge. Returns false, with the mesh unchanged, if p does not make positive triangles with
  /// the edge's ends.
  bool insert_on(EdgeCode e, Vertex p);

 private:
  std::uint32_t add(std::array<Vertex, 3> corners, std::uint32_t mark);
  void set(std::uint32_t t, std::array<Vertex, 3> corners);
  void take(EdgeCode e, std::pair<EdgeCode, bool> outside);
  [[nodiscard]] std::pair<EdgeCode, bool> outside(EdgeCode e) const {
    return {mesh_.across(e), mesh_.constrained(e)};
  }
  void swap_round();

  Triangles& mesh_;
  const Points& points_;
  std::vector<EdgeCode> pending_;  // edges opposite the new point that may not be Delaunay
};

template <typename Visit>
void Insertion::each_at(Vertex v, Visit&& visit) const {
  const EdgeCode first = mesh_.edge_from(v);
  if (first == kNoEdge) return;
  EdgeCode e = first;
  do {
    visit(triangle_of(e));
    e = mesh_.turn_right(e);
  } while (e != kNoEdge && e != first);
  if (e == first) return;
  // At a border: the other triangles are to the left of the first.
  for (e = mesh_.across(previous_edge(first)); e != kNoEdge; e = mesh_.across(previous_edge(e)))
    visit(triangle_of(e));
}

}  // namespace holdfast::plane
