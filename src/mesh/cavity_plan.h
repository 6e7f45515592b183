// The plan of any change: old tetrahedra are replaced by new ones that fill the same space.
//
// Flips, splits, collapses and cut-and-cone are all of this kind. Faces are matched before the mesh changes:
// each outer face of the cavity with a face of a new tetrahedron, and the other new faces with each other. A
// face is looked up by a hash that does not depend on the order of its corners, and compared in full only if
// the hash agrees. Facets on the cavity's faces are read from the tetrahedra outside.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "mesh/change.h"
#include "mesh/keys.h"
#include "mesh/scratch.h"
#include "mesh/tet_mesh.h"
#include "numbers/mix.h"

namespace holdfast {

/// The old and the new tetrahedra; the new ones are strictly positive. Faces and edges that exist before and
/// after keep their constraint bits. `facets` and `segments` name constraints that are new inside the cavity.
struct Replacement {
  std::span<const Tet> old_tets;
  std::span<const TetMesh::Corners> new_tets;
  std::span<const std::array<Vertex, 3>> facets = {};
  std::span<const std::array<Vertex, 2>> segments = {};
  /// A vertex of the cavity that the change moves to another place.
  struct Move {
    Vertex vertex;
    Point to;
  };
  std::optional<Move> move = {};
};

class CavityPlan {
 public:
  /// Throws std::logic_error if the faces do not match. Uses the mesh's visited bits as scratch.
  CavityPlan(TetMesh& mesh, const Replacement& replacement, Scratch& memory);

  [[nodiscard]] Change change() const { return {replacement_.old_tets, new_tets_}; }

 private:
  // Constraints that stand inside a cavity or on its edges, and those that the caller adds. Facets on its
  // faces are known to the tetrahedra outside.
  class Constraints {
   public:
    explicit Constraints(Scratch& memory) : facets_(memory), segments_(memory) {}

    void add_facet(const FaceKey& key) { facets_.push_back(key); }
    void add_segment(EdgeKey key) {
      segments_.push_back(key);
      seen_ |= bit_of(key);
    }
    void add_segments_of(const TetMesh& mesh, Tet t);
    /// Once all are added, before bits() is called.
    void sort();
    [[nodiscard]] Flags bits(const TetMesh::Corners& c) const;

   private:
    // One of 64 bits, so that few edges but segments are looked for in the list.
    static std::uint64_t bit_of(EdgeKey key) { return std::uint64_t{1} << (key * numbers::kGolden >> 58); }
    [[nodiscard]] bool holds_segment(EdgeKey key) const;

    ScratchVector<FaceKey> facets_;
    ScratchVector<EdgeKey> segments_;
    std::uint64_t seen_ = 0;
  };
  // Of the four faces of a tetrahedron: the same for the same three vertices, whatever their order, and
  // nearly always another for others.
  using Marks = std::array<std::uint64_t, 4>;
  struct OuterFace {
    std::uint64_t mark;
    Face across;
  };
  struct Slot {
    std::uint64_t mark = 0;
    Face face = kNone;
    bool matched = false;
  };

  static Marks marks_of(const TetMesh::Corners& c);
  void read_cavity();
  void match_faces();
  void set_flags();
  Face partner_of(Face face, std::uint64_t mark);
  [[nodiscard]] std::array<Vertex, 3> vertices_of(Face face) const;
  [[nodiscard]] bool are_same(Face f, Face g) const;

  TetMesh& mesh_;
  const Replacement& replacement_;
  Constraints constraints_;
  ScratchVector<OuterFace> outer_;
  ScratchVector<Slot> slots_;
  ScratchVector<NewTet> new_tets_;
  std::size_t distinct_ = 0, open_ = 0;  // faces met, and those without a partner yet
};

}  // namespace holdfast
