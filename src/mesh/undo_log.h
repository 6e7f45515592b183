// An undo log of a mesh: what a search has changed since a mark is taken back slot by slot, in time
// proportional to the changes and not to the mesh.
//
// After `undo` the mesh is the one of the mark in every array, the order of its free slots included, so that
// whatever follows gives the same bits as if the search had not been made.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "mesh/tet_mesh.h"

namespace holdfast {

class UndoLog {
 public:
  explicit UndoLog(TetMesh& mesh) : mesh_(mesh) {}
  ~UndoLog();
  UndoLog(const UndoLog&) = delete;
  UndoLog& operator=(const UndoLog&) = delete;

  /// A state of the mesh. As long as one is held, the mesh must not be renumbered or assigned to, no vertex
  /// whose position no double holds may come, move or go, and no other log may hold a mark of this mesh.
  /// Marks nest: undo and release those set last first.
  struct Mark {
    std::size_t slots = 0, vertices = 0, free_moves = 0;  // entries of the log
    std::size_t slot_count = 0, vertex_count = 0;         // of the mesh
  };
  [[nodiscard]] Mark mark();
  /// The mark stays.
  void undo(const Mark& mark);
  /// The last mark is no longer needed; what has changed since it changed after the one before.
  void release();

  /// The tetrahedra and vertices as they were at a mark, where they may have changed since; valid until the
  /// mesh changes again.
  class Before {
   public:
    /// Slots that may have changed, in ascending order, those that are new included.
    [[nodiscard]] const std::vector<Tet>& touched() const { return touched_; }
    /// The slots that now hold another tetrahedron than at the mark, or another state of life.
    [[nodiscard]] std::vector<Tet> changed() const;
    [[nodiscard]] bool existed(Tet t) const { return t < slot_count_; }
    [[nodiscard]] bool alive(Tet t) const;
    [[nodiscard]] const TetMesh::Corners& corners(Tet t) const;
    [[nodiscard]] const Point& position(Vertex v) const;
    /// Vertices that have another position now.
    [[nodiscard]] std::vector<Vertex> moved() const;

   private:
    friend class UndoLog;
    Before(const UndoLog& log, const Mark& mark);

    const UndoLog& log_;
    const std::size_t slot_count_;
    std::vector<Tet> touched_;
    // Number and entry of what was there at the mark, by number.
    std::vector<std::pair<Tet, std::size_t>> slots_;
    std::vector<std::pair<Vertex, std::size_t>> vertices_;
  };
  [[nodiscard]] Before before(const Mark& mark) const { return {*this, mark}; }

 private:
  friend class TetMesh;
  friend class MeshEditor;
  struct Slot {
    Tet tet;
    TetMesh::Corners corners;
    TetMesh::Neighbours neighbours;
    Flags flags;
  };
  struct VertexState {
    Vertex vertex;
    Point position;
    Tet incident;
  };
  struct FreeMove {
    Tet tet;
    bool taken;  // from the list of free slots, or else put there
  };

  // TetMesh calls these before it changes something.
  void note_slot(Tet t);
  void note_vertex(Vertex v);
  void note_free(Tet t, bool taken) { free_moves_.push_back({t, taken}); }
  void begin_epoch() { ++epoch_; }

  TetMesh& mesh_;
  std::vector<Slot> slots_;
  std::vector<VertexState> vertices_;
  std::vector<FreeMove> free_moves_;
  // The last epoch in which a slot, or vertex, was noted; an epoch begins with every mark and undo, so that
  // each is noted once between two of them.
  std::vector<std::uint32_t> slot_epoch_, vertex_epoch_;
  std::uint32_t epoch_ = 1;
  std::size_t held_ = 0;  // marks
};

}  // namespace holdfast
