// A mesh during refinement: its triangles, its points, their positions at the scale of measures, and the
// segments on which they lie. All of these always describe the same points.
#pragma once

#include "plane/input_segments.h"
#include "plane/insertion.h"
#include "plane/shape.h"

namespace holdfast::plane {

class GrowingMesh {
 public:
  /// `mesh` is bounded by constraints; `segments` are those given among them.
  GrowingMesh(Triangles& mesh, Points& points, const std::vector<Ends>& segments);

  [[nodiscard]] const Triangles& mesh() const { return mesh_; }
  [[nodiscard]] const Points& points() const { return points_; }
  [[nodiscard]] const Scale& scale() const { return scale_; }
  [[nodiscard]] const InputSegments& segments() const { return segments_; }
  /// The position of a point at the scale in which all lengths and areas are measured.
  [[nodiscard]] const Position& at(Vertex v) const { return at_[v]; }
  [[nodiscard]] const Position& from(EdgeCode e) const { return at_[mesh_.from(e)]; }
  [[nodiscard]] const Position& to(EdgeCode e) const { return at_[mesh_.to(e)]; }
  [[nodiscard]] Shape shape_of(std::uint32_t t) const {
    const std::array<Vertex, 3>& v = mesh_[t].v;
    return {at_[v[0]], at_[v[1]], at_[v[2]]};
  }
  [[nodiscard]] double area_of(std::uint32_t t) const {
    const std::array<Vertex, 3>& v = mesh_[t].v;
    return cross_from(at_[v[0]], at_[v[1]], at_[v[2]]) / 2;
  }
  [[nodiscard]] Position middle_of(std::uint32_t t) const;

  [[nodiscard]] Vertex first_added() const { return first_added_; }
  [[nodiscard]] std::size_t added() const { return points_.size() - first_added_; }

  /// Adds a point, not yet a vertex, at the double nearest to a scaled place.
  Vertex add(const Position& scaled);
  /// Removes the points from `first` on, which must not be vertices.
  void take_back(Vertex first);

  /// Locates p along a line from the centre of triangle t; nowhere if the centre, in doubles, is not inside
  /// t.
  [[nodiscard]] Insertion::Place locate(Vertex p, std::uint32_t t);
  void insert_inside(std::uint32_t t, Vertex p) { insertion_.insert_inside(t, p); }
  [[nodiscard]] bool insert_on(EdgeCode e, Vertex p) { return insertion_.insert_on(e, p); }
  /// Cuts a constraint. Returns the new point, or kNoVertex if doubles are too coarse for a point between the
  /// ends.
  Vertex cut(EdgeCode e);

  /// Calls `visit` for the triangles at an inserted vertex.
  template <typename Visit>
  void each_at(Vertex v, Visit&& visit) const {
    insertion_.each_at(v, visit);
  }

 private:
  [[nodiscard]] bool is_too_fine(const Position& a, const Position& b) const;

  Triangles& mesh_;
  Points& points_;
  Insertion insertion_;
  Scale scale_;
  Vertex first_added_;
  std::vector<Position> at_;
  InputSegments segments_;
};

}  // namespace holdfast::plane
