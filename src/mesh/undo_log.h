// An undo log of a mesh. It undoes the changes of a search since a mark slot by slot, in time proportional to
// the changes, not to the mesh.
//
// After `undo` every array of the mesh, the order of free slots included, is as at the mark. So later steps
// give the same bits as if the search had never run.
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

  /// A state of the mesh. While a mark is held, the mesh must not be renumbered or assigned to, no vertex
  /// that doubles cannot represent may be added, moved or removed, and no other log may hold a mark of this
  /// mesh. Marks nest: undo and release the latest first.
  struct Mark {
    std::size_t slots = 0, vertices = 0, free_moves = 0;  // entries of the log
    std::size_t slot_count = 0, vertex_count = 0;         // of the mesh
  };
  [[nodiscard]] Mark mark();
  /// The mark stays.
  void undo(const Mark& mark);
  /// Drops the last mark. Changes since then count as changes since the mark before it.
  void release();

  /// The former state of tetrahedra and vertices that may have changed since a mark; valid until the mesh
  /// changes again.
  class Before {
   public:
    /// Slots that may have changed, in ascending order, including new ones.
    [[nodiscard]] const std::vector<Tet>& touched() const { return touched_; }
    /// The slots that hold a different tetrahedron than at the mark, or were freed or filled since.
    [[nodiscard]] std::vector<Tet> changed() const;
    [[nodiscard]] bool existed(Tet t) const { return t < slot_count_; }
    [[nodiscard]] bool alive(Tet t) const;
    [[nodiscard]] const TetMesh::Corners& corners(Tet t) const;
    [[nodiscard]] const Point& position(Vertex v) const;
    /// Vertices with a different position now.
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

  // TetMesh calls these before each change.
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
