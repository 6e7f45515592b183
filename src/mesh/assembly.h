// Assembles a mesh step by step. Used by refine/parts, whose threads fill one mesh from many, and by tests
// that plant faults; tests/layers.py allows no other user.
#pragma once

#include "mesh/editor.h"

namespace holdfast {

/// Between the first step and finish() the invariants of tet_mesh.h need not hold.
class MeshAssembly : public MeshEditor {
 public:
  using MeshEditor::MeshEditor;

  // --- constraints and neighbours
  using MeshEditor::clear_flags;
  using MeshEditor::link;
  using MeshEditor::set_flags;

  // --- vertices
  /// `count` more explicit vertices, one after another, to be placed. Returns the first.
  using MeshEditor::add_vertices;
  /// Sets the position of a vertex whose ball is not final yet. Threads may place different vertices.
  using MeshEditor::place_vertex;
  using MeshEditor::set_incident;

  // --- tetrahedra
  /// Room for so many vertices and slots in all, and for more to come.
  using MeshEditor::make_room;
  /// As load, but neighbours need not be right yet.
  using MeshEditor::set_tets;
  /// The new tetrahedron has no neighbours yet.
  using MeshEditor::add_tet;
  using MeshEditor::remove_tet;
  /// Adds `count` contiguous slots for put_tet to fill. Returns the first.
  using MeshEditor::add_slots;
  /// Fills a slot that is not free. Threads may fill different ones at the same time.
  using MeshEditor::put_tet;
};

}  // namespace holdfast
