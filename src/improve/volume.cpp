#include "improve/volume.h"

namespace holdfast {

double ImprovedVolume::energy_in_frame(const TetMesh::Corners& c) const {
  return data_.see(c, [](const Point& p, const Point& q, const Point& r, const Point& s) {
    return holdfast::energy(p, q, r, s);
  });
}

Pair ImprovedVolume::energies_in_frames(const TetMesh::Corners& x, const TetMesh::Corners& y) const {
  return Pair{energy_in_frame(x), energy_in_frame(y)};
}

}  // namespace holdfast
