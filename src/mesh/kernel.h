// The kernel of a star-shaped cavity: the open set of points that see all of its faces (docs/concepts.md,
// Elimination).
//
// Used by enforce (where an apex may go), suppress (which neighbour can take a point's place, and the best
// place of a point) and optimise. Floating point proposes, the exact predicate decides.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "mesh/inscribed_ball.h"
#include "mesh/tet_mesh.h"

namespace holdfast {

class Kernel {
 public:
  explicit Kernel(const TetMesh& mesh) : mesh_(mesh) {}

  /// A point x of the kernel has orient(a, b, c, x) > 0.
  void add(Vertex a, Vertex b, Vertex c) { faces_.push_back({a, b, c}); }
  [[nodiscard]] const std::vector<std::array<Vertex, 3>>& faces() const { return faces_; }

  /// Whether x lies in the kernel.
  [[nodiscard]] bool holds(exact::PointRef x) const;
  /// Whether v sees every face that it is not a corner of.
  [[nodiscard]] bool seen_from(Vertex v) const;

  /// A point of the kernel: the centre of its largest inscribed ball where doubles hold one, else a point
  /// of the coarsest dyadic grid that reaches inside. `origin` must lie in the kernel's closure; at most
  /// two of the faces may lie in planes through it (then the kernel is not empty: docs/concepts.md,
  /// Elimination, and the result never is), or none.
  [[nodiscard]] std::optional<Position> find(exact::PointRef origin) const;

  /// The centre of the largest inscribed ball, approximately. Without a kernel, the point that lies least
  /// behind the faces, and a radius below zero.
  struct Centre {
    std::array<double, 3> offset{};  ///< from the origin
    double radius = 0;               ///< of the inscribed ball
    double size = 0;                 ///< of the cavity
    std::vector<double> heights{};   ///< of the centre over the faces
  };
  [[nodiscard]] Centre centre(exact::PointRef origin) const;
  /// A point of the kernel in doubles, at the centre or next to it.
  [[nodiscard]] std::optional<Point> double_at(exact::PointRef origin, const Centre& centre) const;

 private:
  [[nodiscard]] HalfSpace half_space_over(const std::array<Vertex, 3>& face, exact::PointRef origin,
                                          double unit) const;
  [[nodiscard]] std::optional<Point> double_next_to(const Point& centre) const;
  [[nodiscard]] std::optional<Position> on_grid(exact::PointRef origin, const Centre& centre) const;
  [[nodiscard]] std::optional<Position> along_direction(exact::PointRef origin, double size) const;

  const TetMesh& mesh_;
  std::vector<std::array<Vertex, 3>> faces_;
};

/// The kernel of the ball of v, whose tetrahedra are `tets`: the places where v may be.
[[nodiscard]] Kernel kernel_of_ball(const TetMesh& mesh, Vertex v, std::span<const Tet> tets);

}  // namespace holdfast
