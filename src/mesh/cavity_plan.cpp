#include "mesh/cavity_plan.h"

#include <algorithm>
#include <cstddef>
#include <stdexcept>

#include "numbers/mix.h"
#include "numbers/sorted.h"

namespace holdfast {
namespace {

[[noreturn]] void mismatch() { throw std::logic_error("holdfast: a cavity's new tetrahedra do not fill it"); }

}  // namespace

void CavityPlan::Constraints::add_segments_of(const TetMesh& mesh, Tet t) {
  const Flags f = mesh.flags(t);
  if ((f & kSegmentBits) == 0) return;
  for (int k = 0; k < 6; ++k)
    if ((f & segment_bit(k)) != 0) add_segment(edge_key(mesh.corners(t), k));
}

void CavityPlan::Constraints::sort() {
  std::sort(facets_.begin(), facets_.end());
  sort_unique(segments_);
}

Flags CavityPlan::Constraints::bits(const TetMesh::Corners& c) const {
  unsigned bits = 0;
  if (!facets_.empty())
    for (int i = 0; i < 4; ++i)
      if (std::binary_search(facets_.begin(), facets_.end(), face_key(c, i))) bits |= facet_bit(i);
  if (!segments_.empty())
    for (int k = 0; k < 6; ++k)
      if (holds_segment(edge_key(c, k))) bits |= segment_bit(k);
  return static_cast<Flags>(bits);
}

bool CavityPlan::Constraints::holds_segment(EdgeKey key) const {
  return (seen_ & bit_of(key)) != 0 && std::binary_search(segments_.begin(), segments_.end(), key);
}

CavityPlan::CavityPlan(TetMesh& mesh, const Replacement& r, Scratch& memory)
    : mesh_(mesh),
      replacement_(r),
      constraints_(memory),
      outer_(memory),
      slots_(memory),
      new_tets_(r.new_tets.size(), memory) {
  outer_.reserve(2 * r.old_tets.size() + 2);
  std::size_t n = 16;
  while (n < 3 * (r.old_tets.size() + r.new_tets.size())) n *= 2;
  slots_.resize(n);
  read_cavity();
  for (const auto& f : r.facets) constraints_.add_facet(face_key(f));
  for (const auto& e : r.segments) constraints_.add_segment(edge_key(e[0], e[1]));
  constraints_.sort();
  match_faces();
  set_flags();
}

void CavityPlan::read_cavity() {
  for (const Tet t : replacement_.old_tets) mesh_.mark_visited(t);
  for (const Tet t : replacement_.old_tets) {
    const Marks marks = marks_of(mesh_.corners(t));
    for (int i = 0; i < 4; ++i) {
      const Face across = mesh_.neighbour(t, i);
      if ((mesh_.flags(tet_of(across)) & kVisited) == 0)
        outer_.push_back({marks[static_cast<std::size_t>(i)], across});
      else if (mesh_.is_facet(across))
        constraints_.add_facet(face_key(mesh_.corners(t), i));
    }
    constraints_.add_segments_of(mesh_, t);
  }
  for (const Tet t : replacement_.old_tets) mesh_.clear_visited(t);
}

void CavityPlan::match_faces() {
  for (const OuterFace& f : outer_) static_cast<void>(partner_of(f.across, f.mark));
  for (std::size_t n = 0; n < new_tets_.size(); ++n) {
    new_tets_[n].corners = replacement_.new_tets[n];
    const Marks marks = marks_of(new_tets_[n].corners);
    for (std::size_t i = 0; i < 4; ++i) {
      const Face mine = new_face(n, i);
      const Face partner = partner_of(mine, marks[i]);
      new_tets_[n].neighbours[i] = partner;
      if (partner != kNone && is_new_face(partner))
        new_tets_[number_of_new(partner)].neighbours[partner & 3u] = mine;
    }
  }
  if (open_ != 0) mismatch();
}

void CavityPlan::set_flags() {
  for (NewTet& fresh : new_tets_) {
    fresh.flags = constraints_.bits(fresh.corners);
    for (int i = 0; i < 4; ++i) {
      const Face across = fresh.neighbours[static_cast<std::size_t>(i)];
      if (!is_new_face(across) && mesh_.is_facet(across)) fresh.flags |= facet_bit(i);
    }
  }
}

CavityPlan::Marks CavityPlan::marks_of(const TetMesh::Corners& c) {
  const auto mixed = [](Vertex v) {
    const std::uint64_t h = (v + 1ull) * numbers::kGolden;
    return h ^ (h >> 29);
  };
  const Marks of{mixed(c[0]), mixed(c[1]), mixed(c[2]), mixed(c[3])};
  const std::uint64_t all = of[0] + of[1] + of[2] + of[3];
  return {all - of[0], all - of[1], all - of[2], all - of[3]};
}

// The earlier face with the same vertices; none if this is the first.
Face CavityPlan::partner_of(Face face, std::uint64_t mark) {
  const std::size_t mask = slots_.size() - 1;
  for (std::size_t h = (mark >> 32) & mask;; h = (h + 1) & mask) {
    Slot& slot = slots_[h];
    if (slot.face == kNone) {
      if (3 * ++distinct_ > 2 * slots_.size()) mismatch();
      slot = {mark, face, false};
      ++open_;
      return kNone;
    }
    if (slot.mark != mark || !are_same(slot.face, face)) continue;
    if (slot.matched) mismatch();
    slot.matched = true;
    --open_;
    return slot.face;
  }
}

std::array<Vertex, 3> CavityPlan::vertices_of(Face face) const {
  return is_new_face(face) ? corners_of_face(replacement_.new_tets[number_of_new(face)], side_of(face))
                           : mesh_.face_vertices(face);
}

bool CavityPlan::are_same(Face f, Face g) const {
  const auto x = vertices_of(f), y = vertices_of(g);
  return std::all_of(x.begin(), x.end(), [&](Vertex v) { return v == y[0] || v == y[1] || v == y[2]; });
}

}  // namespace holdfast
