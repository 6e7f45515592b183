#include "delaunay/boundary.h"

#include <algorithm>
#include <utility>

namespace holdfast {
namespace {

constexpr std::size_t kFirstBoundary = 256;  // more than most boundaries need; it grows

// Euler's relation for a sphere of triangles.
std::size_t vertices_of(std::size_t faces) { return faces / 2 + 2; }

}  // namespace

CavityBoundary::CavityBoundary(Vertex ghost_scratch)
    : ghost_scratch_(ghost_scratch), faces_(kFirstBoundary), ring_(kFirstBoundary), spokes_(kFirstBoundary) {}

bool CavityBoundary::take(Triangulation& triangulation, std::span<const Face> cavity,
                          std::span<const Face> rim, Slots& slots, std::span<Face> table,
                          std::uint32_t side) {
  face_count_ = rim.size();
  if (faces_.size() < face_count_) faces_.resize(2 * face_count_);
  if (ring_.size() <= vertices_of(face_count_)) {
    ring_.resize(2 * face_count_);
    spokes_.resize(2 * face_count_);
  }
  for (const Face reached : cavity) {
    const Cell& cell = triangulation.cells()[tet_of(reached)];
    if (!triangulation.is_ghost(cell)) --triangulation.sites()[cell.v[0]].cells;
  }
  give_slots(cavity, slots);
  const bool by_table = vertices_of(face_count_) <= side;
  if (by_table)
    list<true>(triangulation, rim, table.data(), side);
  else
    list<false>(triangulation, rim, table.data(), side);
  return by_table;
}

void CavityBoundary::give_slots(std::span<const Face> cavity, Slots& slots) {
  const std::size_t own = std::min(cavity.size(), face_count_);
  for (std::size_t j = cavity.size(); j > own; --j) slots.put(tet_of(cavity[j - 1]));
  for (std::size_t j = 0; j < own; ++j) faces_[j].slot = tet_of(cavity[j]);
  for (std::size_t j = own; j < face_count_; ++j) faces_[j].slot = slots.take();
}

// Reads the faces round the cavity from its cells, before their slots are used again. The new vertex p sees
// the boundary face (v0, v1, v2); the new cell is (p, v1, v0, v2), with the ghost last.
template <bool kByTable>
void CavityBoundary::list(Triangulation& triangulation, std::span<const Face> rim, Face* table,
                          std::uint32_t side) {
  Cell* const cells = triangulation.cells().data();
  Triangulation::Site* const sites = triangulation.sites();
  Vertex* const ring = ring_.data();
  const Vertex ghost = triangulation.ghost(), ghost_scratch = ghost_scratch_;
  std::uint32_t fresh = 0;
  // The place of v in the ring; adds v if it is not there. It has no branch, because that would be hard to
  // predict. The ring has room for one more entry than it ever holds.
  const auto local_index = [&](Vertex v) {
    std::uint32_t& place = sites[v == ghost ? ghost_scratch : v].local;
    const std::uint32_t old = std::min(place, fresh);
    const std::uint32_t known =
        static_cast<std::uint32_t>(old < fresh) & static_cast<std::uint32_t>(ring[old] == v);
    ring[fresh] = v;
    const std::uint32_t local = fresh ^ ((old ^ fresh) & (0u - known));
    place = local;
    fresh += 1 - known;
    return local;
  };
  for (std::size_t j = 0; j < rim.size(); ++j) {
    const Cell& inner = cells[tet_of(rim[j])];
    const auto i = static_cast<std::size_t>(side_of(rim[j]));
    const auto& f = kFaceVertex[i];
    Vertex a = inner.v[static_cast<std::size_t>(f[1])];
    Vertex b = inner.v[static_cast<std::size_t>(f[0])];
    Vertex c = inner.v[static_cast<std::size_t>(f[2])];
    if (a == ghost) [[unlikely]] {
      a = std::exchange(b, std::exchange(c, a));
    } else if (b == ghost) [[unlikely]] {
      b = std::exchange(a, std::exchange(c, b));
    }
    const std::uint32_t la = local_index(a), lb = local_index(b), lc = local_index(c);
    CavityFace& face = faces_[j];
    face.outer = inner.n[i];
    face.v = {a, b, c};
    face.local = {la, lb, lc};
    cells[tet_of(face.outer)].n[face.outer & 3u] = face_code(face.slot, 0);
    if constexpr (kByTable) {
      table[lb * side + lc] = face_code(face.slot, 1);
      table[lc * side + la] = face_code(face.slot, 2);
      table[la * side + lb] = face_code(face.slot, 3);
    }
  }
  ring_count_ = fresh;
}

void CavityBoundary::look_from(const Triangulation& triangulation, const double* p) {
  for (std::size_t l = 0; l < ring_count_; ++l) spokes_[l] = spoke(p, triangulation.at(ring_[l]));
}

}  // namespace holdfast
