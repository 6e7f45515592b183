// A mesh put together step by step: by refine/parts, whose threads fill one mesh from many, and by tests that
// plant faults. tests/layers.py keeps everybody else away from it.
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
  /// The position of a vertex whose ball is not yet as it will be. Threads may place different ones.
  using MeshEditor::place_vertex;
  using MeshEditor::set_incident;

  // --- tetrahedra
  /// Room for so many vertices and slots in all.
  using MeshEditor::reserve;
  /// As load, but the neighbours need not be right yet.
  using MeshEditor::set_tets;
  /// Has no neighbours yet.
  using MeshEditor::add_tet;
  using MeshEditor::remove_tet;
  /// Slots for `count` more, one after another, that put_tet fills. Returns the first.
  using MeshEditor::add_slots;
  /// Fills a slot that is not free. Threads may fill different ones at the same time.
  using MeshEditor::put_tet;
};

}  // namespace holdfast
