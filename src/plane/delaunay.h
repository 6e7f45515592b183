// Delaunay triangulation of points in the plane.
#pragma once

#include <optional>

#include "plane/triangles.h"

namespace holdfast::plane {

/// The Delaunay triangles of all points, closed by ghosts, by insertion in the order of the points; empty if
/// they are collinear. Returns nullopt if two points coincide.
[[nodiscard]] std::optional<Triangles> delaunay(const Points& points, const Poll& poll);

/// A closed triangulation to which points are added one by one (Bowyer 1981, Watson 1981).
class Inserter {
 public:
  Inserter(Triangles& mesh, const Points& points) : mesh_(mesh), points_(points) {}

  /// Starts with the triangle abc and its three ghosts.
  void begin(Vertex a, Vertex b, Vertex c);
  /// Inserts a vertex so that the triangulation is Delaunay again. Returns false if another vertex has its
  /// place.
  bool insert(Vertex p);

 private:
  [[nodiscard]] std::uint32_t locate(Vertex p);
  [[nodiscard]] bool in_conflict(std::uint32_t t, Vertex p) const;
  void find_cavity(std::uint32_t first, Vertex p);
  void fill_cavity(Vertex p);

  Triangles& mesh_;
  const Points& points_;
  std::uint32_t last_ = 0;
  struct Side {
    Vertex from, to;
    EdgeCode outside;
  };
  std::vector<std::uint32_t> cavity_;
  std::vector<Side> border_;       // counterclockwise
  std::vector<EdgeCode> pending_;  // edges whose other side is still to be tested, the next one last
};

}  // namespace holdfast::plane
