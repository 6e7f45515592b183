// For the worst elements, when nothing simpler helps: the tetrahedra round one, more and more of them, are
// taken out and the cavity is filled another way, with a point or without one (Marot, Remacle 2020; Klingner,
// Shewchuk 2007 for points in cavities of the size that is best).
#pragma once

#include <vector>

#include "optimise/star.h"
#include "optimise/volume.h"
#include "suppress/cavity.h"

namespace holdfast {

class CavityRefiller {
 public:
  explicit CavityRefiller(ImprovedVolume& volume) : volume_(volume) {}

  /// Fills a cavity that has grown from t so that the energy is less, in the best way found. Free vertices
  /// inside it go. Returns the new tetrahedra, none where no way was found. With `may_add`, it may take a
  /// point.
  std::span<const Tet> refill(Tet t, bool may_add = true);
  /// The point that the last call added, or kNone.
  [[nodiscard]] Vertex point() const { return point_; }

 private:
  struct Filling {
    double gain = 0;
    std::vector<Tet> old_tets;
    std::vector<Vertex> inner;  // vertices that go
    std::vector<std::array<Vertex, 3>> faces;
    Point place{};                        // of the point that joins them ...
    std::vector<TetMesh::Corners> fresh;  // ... unless there are these
  };

  void try_point(const Cavity& cavity);
  void try_without(const Cavity& cavity);
  void offer(const Cavity& cavity, double gain);
  void find_place(const Cavity& cavity);
  bool grow(Cavity& cavity) const;
  std::span<const Tet> apply();
  [[nodiscard]] bool is_better(const Filling& filling) const;

  ImprovedVolume& volume_;
  TetMesh::Corners near_{};  // of the tetrahedron that the cavity grows from
  Frame frame_;
  Star star_;                    // in the frame
  std::vector<double> heights_;  // of the place over the faces, where it does not see them all
  Filling best_;
  bool may_add_ = true;
  Vertex point_ = kNone;
};

}  // namespace holdfast
