#include "mesh/undo_log.h"

#include <algorithm>
#include <cassert>

#include "mesh/editor.h"

namespace holdfast {
namespace {

// The first of several notes of one number is the state at the mark.
template <typename Number>
void keep_first(std::vector<std::pair<Number, std::size_t>>& notes) {
  std::sort(notes.begin(), notes.end());
  const auto same_number = [](const auto& x, const auto& y) { return x.first == y.first; };
  notes.erase(std::unique(notes.begin(), notes.end(), same_number), notes.end());
}

// The entry of a number, or null.
template <typename Number>
const std::size_t* find(const std::vector<std::pair<Number, std::size_t>>& notes, Number number) {
  const auto at = std::lower_bound(notes.begin(), notes.end(), std::pair(number, std::size_t{0}));
  return at != notes.end() && at->first == number ? &at->second : nullptr;
}

}  // namespace

UndoLog::~UndoLog() {
  if (held_ > 0) MeshEditor(mesh_).note_in(nullptr);
}

UndoLog::Mark UndoLog::mark() {
  if (held_++ == 0) MeshEditor(mesh_).note_in(this);
  begin_epoch();
  return {slots_.size(), vertices_.size(), free_moves_.size(), mesh_.slot_count(), mesh_.vertex_count()};
}

void UndoLog::release() {
  assert(held_ > 0);
  if (--held_ > 0) return;
  MeshEditor(mesh_).note_in(nullptr);
  slots_.clear();
  vertices_.clear();
  free_moves_.clear();
}

void UndoLog::note_slot(Tet t) {
  if (t >= slot_epoch_.size()) slot_epoch_.resize(mesh_.slot_count(), 0);
  if (std::exchange(slot_epoch_[t], epoch_) == epoch_) return;
  // Between two operations a mesh has no visited tetrahedra.
  const auto flags = static_cast<Flags>(mesh_.flags(t) & ~kVisited);
  slots_.push_back({t, mesh_.corners(t), mesh_.neighbours(t), flags});
}

void UndoLog::note_vertex(Vertex v) {
  assert(mesh_.is_explicit(v));
  if (v >= vertex_epoch_.size()) vertex_epoch_.resize(mesh_.vertex_count(), 0);
  if (std::exchange(vertex_epoch_[v], epoch_) == epoch_) return;
  vertices_.push_back({v, mesh_.position(v), mesh_.incident(v)});
}

void UndoLog::undo(const Mark& mark) { MeshEditor(mesh_).undo(*this, mark); }

UndoLog::Before::Before(const UndoLog& log, const Mark& mark) : log_(log), slot_count_(mark.slot_count) {
  for (std::size_t k = mark.slots; k < log.slots_.size(); ++k)
    if (log.slots_[k].tet < mark.slot_count) slots_.emplace_back(log.slots_[k].tet, k);
  for (std::size_t k = mark.vertices; k < log.vertices_.size(); ++k)
    if (log.vertices_[k].vertex < mark.vertex_count) vertices_.emplace_back(log.vertices_[k].vertex, k);
  keep_first(slots_);
  keep_first(vertices_);
  for (const auto& [t, entry] : slots_) touched_.push_back(t);
  for (auto t = static_cast<Tet>(mark.slot_count); t < log.mesh_.slot_count(); ++t) touched_.push_back(t);
}

std::vector<Tet> UndoLog::Before::changed() const {
  std::vector<Tet> out = touched_;
  std::erase_if(out, [&](Tet t) {
    return existed(t) && alive(t) == log_.mesh_.alive(t) && corners(t) == log_.mesh_.corners(t);
  });
  return out;
}

bool UndoLog::Before::alive(Tet t) const {
  const std::size_t* entry = find(slots_, t);
  return ((entry != nullptr ? log_.slots_[*entry].flags : log_.mesh_.flags(t)) & kDead) == 0;
}

const TetMesh::Corners& UndoLog::Before::corners(Tet t) const {
  const std::size_t* entry = find(slots_, t);
  return entry != nullptr ? log_.slots_[*entry].corners : log_.mesh_.corners(t);
}

const Point& UndoLog::Before::position(Vertex v) const {
  const std::size_t* entry = find(vertices_, v);
  return entry != nullptr ? log_.vertices_[*entry].position : log_.mesh_.position(v);
}

std::vector<Vertex> UndoLog::Before::moved() const {
  std::vector<Vertex> out;
  for (const auto& [v, entry] : vertices_)
    if (v < log_.mesh_.vertex_count() && log_.vertices_[entry].position != log_.mesh_.position(v))
      out.push_back(v);
  return out;
}

}  // namespace holdfast
