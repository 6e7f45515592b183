// Insertion of one point by the constrained, generalised Bowyer-Watson operator (paper §6.2; George, Hecht,
// Saltel 1991).
//
// The cavity of a point p begins with the tetrahedron that holds it and spreads to neighbours whose
// circumscribed sphere holds p, never across a facet or the hull. In a mesh that is not Delaunay, or where
// constraints cut it, its faces need not all see p: tetrahedra behind a face that does not are
// removed until all faces do, decided exactly. Then the tetrahedra that join p to the faces are positive and
// fill it: a closed surface all of whose triangles see p winds round it as often as it covers the directions,
// which is once, since p lies in one tetrahedron. In-sphere tests only propose, but they are exact: flat
// tetrahedra, for which floating point cannot decide, would become walls that obstruct cavities. If a metric
// is given, spheres are those of its frame at p.
#pragma once

#include <functional>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "mesh/change.h"
#include "mesh/tet_mesh.h"
#include "mesh/traverse.h"
#include "metric/frame.h"
#include "refine/rim.h"
#include "refine/tuning.h"

namespace holdfast {

class PointCavity {
 public:
  static constexpr std::size_t kUnlimited = std::numeric_limits<std::size_t>::max();

  /// All vertices of the tetrahedra that points are put in are explicit.
  /// `seed` is that of walks. `poll` is called each time that a large cavity has been gone through.
  explicit PointCavity(TetMesh& mesh, std::uint64_t seed = 1, std::function<void()> poll = {})
      : mesh_(mesh), poll_(std::move(poll)), random_(static_cast<std::uint32_t>(seed)) {}

  /// The tetrahedron that holds vertex p, which is in no tetrahedron yet, by a walk from `start`.
  [[nodiscard]] Tet locate(Vertex p, Tet start) { return walk_to(mesh_, p, start, random_); }

  /// Finds the cavity of p round the tetrahedron `base` that holds it. Returns false where there is none, or
  /// it would have more than `most` tetrahedra. It must be inserted or abandoned.
  [[nodiscard]] bool find(Vertex p, Tet base, const Frame& frame, std::size_t most = kUnlimited);
  /// The same, but the cavity is made of these tetrahedra alone, as far as p sees their faces.
  [[nodiscard]] bool find_among(Vertex p, Tet base, std::span<const Tet> tets);
  /// The vertices that p would be joined to.
  [[nodiscard]] std::span<const Vertex> ring() const { return vertices_.all(); }

  [[nodiscard]] std::span<const RimFace> rim() const { return rim_; }
  /// The tetrahedra that p would replace.
  [[nodiscard]] std::span<const Tet> tets() const { return tets_; }

  /// Of the last call of `find`, or of `find_among`, in tetrahedra looked at.
  [[nodiscard]] std::size_t work() const { return work_; }

  /// Replaces the cavity by the tetrahedra round p; created()[k] stands on rim()[k].
  void insert();
  [[nodiscard]] std::span<const Tet> created() const { return created_; }

  /// Leaves the mesh as it was.
  void abandon();

 private:
  bool settle(Tet base);
  void poll_if_large() const {
    if (poll_ && tets_.size() > tuning::kLargeCavity) poll_();
  }
  void spread(Tet base, const Frame& frame, std::size_t most);
  [[nodiscard]] bool is_in_sphere(Tet t, const Point& x) const;
  [[nodiscard]] bool is_in_sphere_of(const Frame& frame, Tet t) const;
  void gather(std::span<const Tet> tets);
  bool shrink_until_seen(Tet base);
  bool release(Tet t, Tet base);
  void list_rim();
  [[nodiscard]] Tet holder_of_lost_entity(Tet base) const;
  TetMesh& mesh_;
  std::function<void()> poll_;
  Vertex p_ = kNone;
  std::vector<Tet> tets_;
  std::vector<Face> faces_;  // of the boundary, from inside
  std::vector<RimFace> rim_;
  RimVertices vertices_;          // of the rim
  RimEdges edges_;                // of the rim
  std::vector<NewTet> new_tets_;  // the star of p: new_tets_[k] stands on rim_[k]
  std::vector<Tet> created_;
  std::uint32_t random_;
  std::size_t work_ = 0;
};

}  // namespace holdfast
