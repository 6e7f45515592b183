// The set of Steiner points that enforcement has put into the mesh.
//
// A later facet may pierce edges of these points, so points lead to more points (paper §2.4). Hence, between
// one constraint and the next, points that need not stay are suppressed, and the others move to where they
// leave room.
#pragma once

#include <span>
#include <unordered_set>
#include <vector>

#include "mesh/tet_mesh.h"
#include "numbers/random.h"
#include "recover/flipper.h"
#include "suppress/small_polyhedron.h"

namespace holdfast {

/// All of them are strictly off every constraint that stands.
class SteinerPoints {
 public:
  /// Vertices below first_free are never changed. Mesh and random numbers must outlive the set.
  SteinerPoints(TetMesh& mesh, Vertex first_free, Random& random)
      : mesh_(mesh), first_free_(first_free), flipper_(mesh, random) {}

  void add(std::span<const Vertex> fresh);
  /// Suppresses or recentres the points that were added since the last call, and those next to a suppressed
  /// one.
  void settle_new();
  /// The same for these points.
  void settle(std::vector<Vertex> points);
  /// The same, thoroughly, for all points, whenever their number has grown by half.
  void settle_all_now_and_then();

  /// Points that still lie on a constraint are left alone.
  void hold(std::span<const Vertex> points) { held_.insert(points.begin(), points.end()); }
  void release(Vertex p) { held_.erase(p); }
  /// Keeps those of some vertices that may be removed.
  void keep_added(std::vector<Vertex>& vertices) const {
    std::erase_if(vertices, [&](Vertex v) { return v < first_free_ || held_.contains(v); });
  }

 private:
  void settle_restless(const PolyhedronOptions& search);

  TetMesh& mesh_;
  const Vertex first_free_;
  Flipper flipper_;
  std::vector<Vertex> all_;       // some of them may be gone
  std::vector<Vertex> restless_;  // to be settled
  std::unordered_set<Vertex> held_;
  std::size_t settled_ = 0;  // how many there were when all were last settled
};

}  // namespace holdfast
