// Moving one vertex to where the sum of the energies of its ball is least.
#pragma once

#include <vector>

#include "improve/volume.h"

namespace holdfast {

class VertexSmoother {
 public:
  explicit VertexSmoother(ImprovedVolume& volume) : volume_(volume) {}

  /// Moves v if that makes the energy of its ball less; every tetrahedron stays positive, decided exactly.
  /// A patient search descends along the gradient, too. Returns whether v was moved.
  bool smooth(Vertex v, bool patient);
  /// The ball of the last call.
  [[nodiscard]] const std::vector<Tet>& ball() const { return tets_; }

 private:
  struct FaceOfLink {
    Point a, b, c;
    std::array<Vertex, 3> v;
  };

  static constexpr std::size_t kMostBall = 200;

  void gather(Vertex v);
  [[nodiscard]] double energy_at(const Point& x, double limit);
  bool step_to(const Point& x);
  bool step_towards(const Point& target);
  [[nodiscard]] Point ideal_place() const;
  bool descend();
  bool settle(Vertex v);

  ImprovedVolume& volume_;
  std::vector<Tet> tets_;
  std::vector<FaceOfLink> faces_;
  Point at_{};
  double energy_ = 0;
  double size_ = 0;
};

}  // namespace holdfast
