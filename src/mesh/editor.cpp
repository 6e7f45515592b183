#include "mesh/editor.h"

#include <algorithm>
#include <functional>

#include "mesh/face_plan.h"
#include "mesh/scratch.h"
#include "mesh/shell_plan.h"
#include "mesh/traverse.h"
#include "mesh/validate.h"

namespace holdfast {

void MeshEditor::replace(const Replacement& replacement, std::vector<Tet>* created) {
  Scratch scratch;
  const CavityPlan plan(mesh_, replacement, scratch);
  for (const Tet t : replacement.old_tets)
    for (const Vertex v : mesh_.corners(t))
      if (v != kGhost) mesh_.set_incident(v, kNone);
  if (replacement.move) mesh_.move_vertex(replacement.move->vertex, replacement.move->to);
  std::vector<Tet> local;
  apply(plan.change(), created != nullptr ? *created : local);
}

void MeshEditor::replace_shell(const EdgeShell& shell, const std::vector<LinkTriangle>& triangles,
                               std::vector<Tet>* created) {
  const ShellPlan plan(mesh_, shell, triangles);
  if (created != nullptr) {
    apply(plan.change(), *created);
  } else {
    std::array<Tet, ShellPlan::kMostNew> slots;
    put(plan.change(), std::span(slots).first(plan.change().new_tets.size()));
  }
}

std::array<Tet, 3> MeshEditor::swap_face(Face f) {
  const FacePlan plan(mesh_, f);
  std::array<Tet, 3> created{};
  put(plan.change(), created);
  return created;
}

void MeshEditor::apply(const Change& change, std::vector<Tet>& created) {
  const std::size_t first = created.size();
  created.resize(first + change.new_tets.size());
  put(change, std::span(created).subspan(first));
}

// Writes the slots of the new tetrahedra to `slots`.
void MeshEditor::put(const Change& change, std::span<Tet> slots) {
  for (const Tet t : change.old_tets) mesh_.remove_tet(t);
  const Tet near = change.old_tets.empty() ? kNone : change.old_tets.front();
  for (Tet& slot : slots) slot = mesh_.take_slot(near);
  for (std::size_t k = 0; k < slots.size(); ++k) {
    const NewTet& fresh = change.new_tets[k];
    TetMesh::Neighbours neighbours;
    for (std::size_t i = 0; i < 4; ++i) {
      const Face across = fresh.neighbours[i];
      if (is_new_face(across)) {
        neighbours[i] = face_code(slots[number_of_new(across)], side_of(across));
      } else {
        neighbours[i] = across;
        mesh_.set_neighbour(across, face_code(slots[k], static_cast<int>(i)));
      }
    }
    mesh_.put_tet(slots[k], fresh.corners, neighbours, fresh.flags);
    for (const Vertex v : fresh.corners)
      if (v != kGhost) mesh_.set_incident(v, slots[k]);
  }
  if (change.centre != kNone) mesh_.set_incident(change.centre, slots.front());
  finish(slots);
}

// By value: the corners may be in a slot, which may move.
Tet MeshEditor::add_tet(TetMesh::Corners v) {
  const Tet t = mesh_.take_slot();
  mesh_.put_tet(t, v, {kNone, kNone, kNone, kNone}, 0);
  return t;
}

void MeshEditor::set_facet(Face f) { change_mark(f, &TetMesh::set_flags); }

void MeshEditor::set_segment(Tet t, Vertex a, Vertex b) { change_mark(t, a, b, &TetMesh::set_flags); }

void MeshEditor::release_facet(Face f) { change_mark(f, &TetMesh::clear_flags); }

void MeshEditor::release_segment(Tet t, Vertex a, Vertex b) { change_mark(t, a, b, &TetMesh::clear_flags); }

void MeshEditor::change_mark(Face f, ChangeOfFlags change) {
  const Face g = mesh_.neighbour(f);
  (mesh_.*change)(tet_of(f), facet_bit(side_of(f)));
  (mesh_.*change)(tet_of(g), facet_bit(side_of(g)));
  finish(std::array{tet_of(f), tet_of(g)});
}

void MeshEditor::change_mark(Tet t, Vertex a, Vertex b, ChangeOfFlags change) {
  std::vector<Tet> tets;
  shell(mesh_, t, a, b, tets);
  for (const Tet s : tets) (mesh_.*change)(s, segment_bit(mesh_.edge_of(s, a, b)));
  finish(tets);
}

// New slots come last in the pools, so they are filled only when no others are left.
void MeshEditor::share_slots(SlotPools& pools, std::size_t count, std::size_t spare) {
  assert(mesh_.attached_.log == nullptr && mesh_.attached_.pools == nullptr);
  const std::size_t more = count * spare - std::min(count * spare, mesh_.free_.size());
  const Tet first = mesh_.add_slots(more);
  std::size_t next = 0;
  const auto give = [&](Tet t) {
    pools.assign(t, static_cast<SlotPools::Pool>(next++ % count));
    pools.give(t);
  };
  for (auto t = static_cast<Tet>(mesh_.slot_count()); t > first; --t) {
    mesh_.flags_[t - 1] = kDead;
    give(t - 1);
  }
  for (const Tet t : mesh_.free_) give(t);
  mesh_.free_.clear();
  mesh_.attached_.pools = &pools;
}

void MeshEditor::unshare_slots() {
  mesh_.free_ = std::exchange(mesh_.attached_.pools, nullptr)->all();
  std::sort(mesh_.free_.begin(), mesh_.free_.end(), std::greater<>());
  std::size_t at_end = 0;
  while (at_end < mesh_.free_.size() && mesh_.free_[at_end] + at_end + 1 == mesh_.slot_count()) ++at_end;
  mesh_.free_.erase(mesh_.free_.begin(), mesh_.free_.begin() + static_cast<std::ptrdiff_t>(at_end));
  mesh_.drop_last_slots(at_end);
}

void MeshEditor::undo(UndoLog& log, const UndoLog::Mark& mark) {
  std::vector<Tet> restored;
  // Newest first: a slot's oldest note since the mark is applied last and decides.
  while (log.slots_.size() > mark.slots) {
    const UndoLog::Slot& old = log.slots_.back();
    mesh_.cells_[old.tet] = {old.corners, old.neighbours};
    mesh_.flags_[old.tet] = old.flags;
    if constexpr (kValidates) restored.push_back(old.tet);
    log.slots_.pop_back();
  }
  mesh_.cells_.resize(mark.slot_count);
  mesh_.flags_.resize(mark.slot_count);
  for (; log.free_moves_.size() > mark.free_moves; log.free_moves_.pop_back()) {
    if (log.free_moves_.back().taken)
      mesh_.free_.push_back(log.free_moves_.back().tet);
    else
      mesh_.free_.pop_back();
  }
  undo_vertices(log, mark);
  log.begin_epoch();
  if constexpr (kValidates) {
    std::erase_if(restored, [&](Tet t) { return t >= mesh_.slot_count() || !mesh_.alive(t); });
    finish(restored);
  }
}

void MeshEditor::undo_vertices(UndoLog& log, const UndoLog::Mark& mark) {
  const auto resize = [this](std::size_t count) {
    mesh_.positions_.resize(count);
    mesh_.exact_of_.resize(count, kNone);
    mesh_.incident_.resize(count, kNone);
  };
  if (mesh_.vertex_count() < mark.vertex_count) resize(mark.vertex_count);
  for (; log.vertices_.size() > mark.vertices; log.vertices_.pop_back()) {
    const UndoLog::VertexState& old = log.vertices_.back();
    if (old.vertex >= mark.vertex_count) continue;
    mesh_.positions_[old.vertex] = old.position;
    mesh_.incident_[old.vertex] = old.incident;
  }
  resize(mark.vertex_count);
}

void MeshEditor::finish_ball(Vertex v) {
  std::vector<Tet> tets;
  ball(mesh_, v, tets);
  finish(tets);
}

void MeshEditor::throw_on_fault(std::span<const Tet> changed) const {
  holdfast::throw_on_fault(mesh_, changed);
}
void MeshEditor::throw_on_fault() const { holdfast::throw_on_fault(mesh_); }

}  // namespace holdfast
