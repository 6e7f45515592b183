// Puts a point where a judge of the elements rates it best.
#pragma once

#include <optional>
#include <span>

#include "refine/point_cavity.h"
#include "refine/volume_data.h"

namespace holdfast {

/// The radius of the sphere round a tetrahedron over its shortest edge; infinite for a flat one.
[[nodiscard]] double radius_over_edge(const Point& a, const Point& b, const Point& c, const Point& d);
/// Six volumes over the cube of the longest edge, sqrt(2)/2 for a regular tetrahedron, 0 for a flat one.
[[nodiscard]] double fatness_of(const Point& a, const Point& b, const Point& c, const Point& d);

class PointSetter {
 public:
  explicit PointSetter(const VolumeData& volume)
      : volume_(volume), mesh_(volume.mesh), cavity_(volume.mesh, volume.seed) {}

  /// Tries a point at x in the region of t, in the cavity of the in-sphere test or in t alone. `judge(old
  /// tetrahedra, rim, point)` rates the change; nothing rejects it. The mesh is unchanged afterwards.
  template <typename Judge>
  std::optional<double> try_at(const Point& x, Tet t, bool alone, Judge&& judge) {
    const Vertex p = begin(x);
    std::optional<double> found;
    if (find(p, t, alone)) {
      found = judge(cavity_.tets(), cavity_.rim(), p);
      cavity_.abandon();
    }
    end();
    return found;
  }
  /// Makes a change that the judge rated. Returns the new tetrahedra, until the next call.
  std::span<const Tet> make(const Point& x, Tet t, bool alone);

  /// The centre of the sphere round t, where it is finite.
  [[nodiscard]] std::optional<Point> centre_of(Tet t) const;

 private:
  static constexpr std::size_t kMostTets = 400;  // of a cavity

  Vertex begin(const Point& x);
  void end();
  [[nodiscard]] bool find(Vertex p, Tet t, bool alone);

  const VolumeData volume_;
  TetMesh& mesh_;
  PointCavity cavity_;
};

}  // namespace holdfast
