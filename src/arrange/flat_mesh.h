// A triangulation in the plane that grows by points and segments. Segments that cross are cut at the
// crossing.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "arrange/index_table.h"
#include "numbers/random.h"
#include "numbers/sorted.h"
#include "plane/triangles.h"

namespace holdfast::arrange {

using plane::EdgeCode;
using plane::Vertex;

/// Begins with one positive triangle that contains all else. After each step the triangulation is Delaunay,
/// except at pieces of segments and where a floating-point filter cannot decide.
class FlatMesh {
 public:
  /// The caller owns the points; a, b, c turn left.
  FlatMesh(plane::Points& points, Vertex a, Vertex b, Vertex c);

  /// Inserts the last of the points, whose place no other vertex has. `sides`: the sides of the first
  /// triangle on which the point is known to lie, bit i for the side opposite corner i. This saves exact
  /// arithmetic, because filters cannot decide points on a line.
  void insert(Vertex p, unsigned sides = 0);

  /// The point where the lines of two segments cross, by the segments' numbers; added to the points.
  using Crossing = std::function<Vertex(std::uint32_t line, std::uint32_t other)>;
  /// Makes the segment ab a chain of edges: it is cut at vertices that it passes through, and where it
  /// crosses pieces of other segments, which are cut there, too.
  void insert_segment(Vertex a, Vertex b, std::uint32_t line, const Crossing& crossing);

  [[nodiscard]] const plane::Triangles& triangles() const { return mesh_; }
  /// The vertices of the edges that lie on the segment ab, in order, a and b included.
  [[nodiscard]] std::vector<Vertex> chain(Vertex a, Vertex b) const;
  /// The edge ab, seen from its left, or kNoEdge.
  [[nodiscard]] EdgeCode edge_between(Vertex a, Vertex b) const;

 private:
  // How a segment leaves a vertex: along an edge to the next vertex on it, or across the edge opposite.
  struct Departure {
    Vertex along = plane::kNoVertex;
    EdgeCode across = plane::kNoEdge;
  };
  // The edges that a segment crosses up to the next vertex on it, or to another segment.
  struct Passage {
    Vertex next = plane::kNoVertex;
    EdgeCode segment = plane::kNoEdge;
    std::vector<EdgeCode> crossed = {};
  };

  [[nodiscard]] unsigned sides_of(Vertex v) const { return v < sides_.size() ? sides_[v] : 0; }
  [[nodiscard]] int orient(Vertex a, Vertex b, Vertex c) const {
    if ((sides_of(a) & sides_of(b) & sides_of(c)) != 0) return 0;
    return points_.orient(a, b, c);
  }
  [[nodiscard]] EdgeCode locate(Vertex p, unsigned& zeros) const;
  void split_triangle(std::uint32_t t, Vertex p);
  void split_edge(EdgeCode e, Vertex p);
  void put(std::uint32_t t, std::array<Vertex, 3> v);
  std::uint32_t add_triangle();
  void legalise();
  /// `behind`: a vertex on the same line on the other side of `from`, if one is known.
  [[nodiscard]] Departure depart(Vertex from, Vertex to, Vertex behind = plane::kNoVertex) const;
  [[nodiscard]] Passage pass(Vertex from, Vertex to, EdgeCode leave) const;
  Vertex cut_segment(EdgeCode segment, std::uint32_t line, const Crossing& crossing);
  void lay(Vertex from, Vertex to, const std::vector<EdgeCode>& crossed, std::uint32_t line);
  void constrain(Vertex from, Vertex to, std::uint32_t line);
  template <class Visit>
  void for_each_corner(Vertex v, Visit&& visit) const;
  static std::array<Index, 2> key(Vertex a, Vertex b) { return ascending(std::array<Index, 2>{a, b}); }

  plane::Points& points_;
  plane::Triangles mesh_;
  std::vector<std::uint8_t> sides_;  // by vertex, those that it is known to lie on; too short where none is
  IndexTable<2> line_of_;            // of edges that are pieces of segments, or were
  mutable std::uint32_t last_ = 0;   // where the search for a point begins
  std::vector<EdgeCode> pending_;    // edges that may have to be exchanged
  std::optional<numbers::Random> random_;  // once it is needed
};

}  // namespace holdfast::arrange
