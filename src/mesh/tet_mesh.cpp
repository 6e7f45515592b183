#include "mesh/tet_mesh.h"

#include <cassert>
#include <utility>

#include "mesh/slot_pools.h"
#include "mesh/undo_log.h"

namespace holdfast {

void TetMesh::tell_slot(Tet t) { attached_.log->note_slot(t); }

void TetMesh::tell_vertex(Vertex v) { attached_.log->note_vertex(v); }

Vertex TetMesh::add_vertex(const Point& p) {
  positions_.push_back(on_grid(p));
  exact_of_.push_back(kNone);
  incident_.push_back(kNone);
  return static_cast<Vertex>(positions_.size() - 1);
}

Vertex TetMesh::add_vertices(std::size_t count) {
  const auto first = static_cast<Vertex>(positions_.size());
  positions_.resize(first + count);
  exact_of_.resize(first + count, kNone);
  incident_.resize(first + count, kNone);
  return first;
}

void TetMesh::move_vertex(Vertex v, const Point& p) {
  note_vertex(v);
  release_exact(v);
  positions_[v] = on_grid(p);
}

void TetMesh::remove_vertex(Vertex v) {
  note_vertex(v);
  release_exact(v);
  incident_[v] = kNone;
}

void TetMesh::remove_last_vertex() {
  note_vertex(static_cast<Vertex>(positions_.size() - 1));
  release_exact(static_cast<Vertex>(positions_.size() - 1));
  positions_.pop_back();
  exact_of_.pop_back();
  incident_.pop_back();
}

void TetMesh::release_exact(Vertex v) {
  if (exact_of_[v] == kNone) return;
  exact_[exact_of_[v]] = {};
  exact_free_.push_back(exact_of_[v]);
  exact_of_[v] = kNone;
  --exact_in_use_;
}

void TetMesh::move_vertex(Vertex v, const exact::ExactPoint& p) {
  assert(attached_.log == nullptr);
  const exact::ExactPoint copy = p;  // p may live in exact_, which is about to change
  release_exact(v);
  positions_[v] = {copy.c[0].to_double(), copy.c[1].to_double(), copy.c[2].to_double()};
  if (grid_.holds(copy.c[0]) && grid_.holds(copy.c[1]) && grid_.holds(copy.c[2])) return;
  if (exact_free_.empty()) {
    exact_of_[v] = static_cast<std::uint32_t>(exact_.size());
    exact_.push_back(copy);
  } else {
    exact_of_[v] = exact_free_.back();
    exact_free_.pop_back();
    exact_[exact_of_[v]] = copy;
  }
  ++exact_in_use_;
}

exact::ExactPoint TetMesh::exact_position(Vertex v) const {
  return is_explicit(v) ? exact::lift(positions_[v].data()) : exact_[exact_of_[v]];
}

Tet TetMesh::take_slot(Tet near) {
  if (attached_.pools != nullptr) [[unlikely]]
    return attached_.pools->take(near);
  if (free_.empty()) {
    cells_.emplace_back();
    flags_.push_back(0);
    return static_cast<Tet>(cells_.size() - 1);
  }
  const Tet t = free_.back();
  if (attached_.log != nullptr) [[unlikely]]
    attached_.log->note_free(t, true);
  free_.pop_back();
  return t;
}

Tet TetMesh::add_slots(std::size_t count) {
  const auto first = static_cast<Tet>(cells_.size());
  cells_.resize(first + count);
  flags_.resize(first + count);
  return first;
}

void TetMesh::drop_last_slots(std::size_t count) {
  cells_.resize(cells_.size() - count);
  flags_.resize(cells_.size());
}

void TetMesh::remove_tet(Tet t) {
  assert(alive(t));
  note_slot(t);
  if (attached_.log != nullptr) [[unlikely]]
    attached_.log->note_free(t, false);
  flags_[t] = kDead;
  if (attached_.pools != nullptr) [[unlikely]]
    return attached_.pools->give(t);
  free_.push_back(t);
}

void TetMesh::set_tets(std::vector<Cell> cells) {
  assert(tet_count() == 0);
  cells_ = std::move(cells);
  flags_.reserve(cells_.capacity());
  flags_.assign(cells_.size(), 0);
  free_.clear();
  for (Tet t = 0; t < cells_.size(); ++t)
    for (const Vertex v : corners(t))
      if (v != kGhost) incident_[v] = t;
}

void TetMesh::renumber(std::span<const Tet> tets, Vertex first, std::span<const Vertex> vertices) {
  assert(attached_.log == nullptr && tets.size() == tet_count() && first + vertices.size() == vertex_count());
  std::vector<Tet> tet_now(slot_count(), kNone);
  for (std::size_t k = 0; k < tets.size(); ++k) tet_now[tets[k]] = static_cast<Tet>(k);
  std::vector<Vertex> vertex_now(vertices.size());
  for (std::size_t k = 0; k < vertices.size(); ++k)
    vertex_now[vertices[k] - first] = first + static_cast<Vertex>(k);
  std::vector<Cell> cells(tets.size());
  std::vector<Flags> flags(tets.size());
  for (std::size_t k = 0; k < tets.size(); ++k) {
    cells[k] = cells_[tets[k]];
    for (Vertex& v : cells[k].corners)
      if (v >= first && v != kGhost) v = vertex_now[v - first];
    for (Face& f : cells[k].neighbours) f = face_code(tet_now[tet_of(f)], side_of(f));
    flags[k] = flags_[tets[k]];
  }
  cells_ = std::move(cells);
  flags_ = std::move(flags);
  free_.clear();
  const std::vector<Point> positions(positions_.begin() + first, positions_.end());
  const std::vector<std::uint32_t> exact_of(exact_of_.begin() + first, exact_of_.end());
  const std::vector<Tet> incident(incident_.begin() + first, incident_.end());
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    positions_[first + k] = positions[vertices[k] - first];
    exact_of_[first + k] = exact_of[vertices[k] - first];
    incident_[first + k] = incident[vertices[k] - first];
  }
  for (Tet& t : incident_)
    if (t != kNone) t = tet_now[t];
}

void TetMesh::reserve(std::size_t vertices, std::size_t tets) {
  positions_.reserve(vertices);
  exact_of_.reserve(vertices);
  incident_.reserve(vertices);
  cells_.reserve(tets);
  flags_.reserve(tets);
}

void TetMesh::make_room(std::size_t vertices, std::size_t tets) {
  constexpr std::size_t kShareOfRoom = 8;  // one in so many
  const auto with_room = [](std::size_t count, std::size_t capacity) {
    return count <= capacity ? capacity : count + count / kShareOfRoom;
  };
  reserve(with_room(vertices, positions_.capacity()), with_room(tets, cells_.capacity()));
}

}  // namespace holdfast
