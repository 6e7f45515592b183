#include "delaunay/insert.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "exact/predicates.h"
#include "mesh/keys.h"

namespace holdfast {
namespace {

constexpr std::uint32_t kTableSide = 64;
constexpr std::size_t kFirstScratch = 256;
constexpr std::uint64_t kSign = std::uint64_t{1} << 63;

std::uint64_t bits_of(double x) { return std::bit_cast<std::uint64_t>(x); }

}  // namespace

Inserter::Inserter(Triangulation& triangulation, unsigned index, std::uint64_t seed)
    : triangulation_(triangulation),
      sites_(triangulation.sites()),
      ghost_(triangulation.ghost()),
      own_ghost_(ghost_ + index),
      random_state_((seed + index) * 2 + 1),
      cavity_(kFirstScratch),
      rim_(kFirstScratch),
      boundary_(kFirstScratch),
      ring_(kFirstScratch),
      spokes_(kFirstScratch),
      table_(kTableSide * kTableSide) {}

std::uint32_t Inserter::random() {
  random_state_ ^= random_state_ << 13;
  random_state_ ^= random_state_ >> 7;
  random_state_ ^= random_state_ << 17;
  return static_cast<std::uint32_t>(random_state_ >> 32);
}

bool Inserter::owns_all(const Cell& cell) const {
  return owns(cell.v[0]) && owns(cell.v[1]) && owns(cell.v[2]) && owns(cell.v[3]);
}

bool Inserter::touches(const Cell& cell) const {
  return std::any_of(cell.v.begin(), cell.v.end(), [&](Vertex v) { return v != ghost_ && owns(v); });
}

void Inserter::insert(Vertex k) { insert_as<Mode::in_order>(k); }
void Inserter::insert_late(Vertex k) { insert_as<Mode::late>(k); }
bool Inserter::insert_in_slab(Vertex k) { return insert_as<Mode::in_slab>(k); }

template <Inserter::Mode kMode>
bool Inserter::insert_as(Vertex k) {
  const double* q = at(k);
  const Located seed = locate<kMode == Mode::in_slab>(q);
  if (seed.what == Located::outside_slab) return false;
  if (seed.what == Located::corner) {
    note_duplicate(seed.tet, k);
    return true;
  }
  if (!dig<kMode>(seed.tet, q, k) || !find_slots<kMode != Mode::in_slab>()) {
    restore_cavity();
    return false;
  }
  fill(k);
  if (kMode != Mode::in_order) turn_new_cells(k);
  return true;
}

bool Inserter::enter(const Slab& slab, Vertex k, Tet from) {
  slab_ = slab;
  last_ = from;
  last_ = locate<false>(at(k)).tet;
  return touches(triangulation_.cells()[last_]);
}

// Remembering stochastic visibility walk (Devillers, Pion, Teillaud 2002): ends with probability one in
// any triangulation. It may stop at any cell in strict conflict, which the cell that holds q is, unless q
// is one of its corners. A ghost is entered only through a face that q is strictly beyond.
template <bool kInSlab>
Inserter::Located Inserter::locate(const double* q) {
  const Cell* const cells = triangulation_.cells().data();
  Tet t = last_;
  int came = -1;
  for (;;) {
    const Cell& cell = cells[t];
    if (triangulation_.strictly_in_conflict(cell, q)) return {t, Located::conflict};
    const auto first = static_cast<int>(random() & 3u);
    int out = -1;
    for (int j = 0; j < 4 && out < 0; ++j) {
      const int i = (first + j) & 3;
      if (i == came) continue;
      const auto& f = kFaceVertex[static_cast<std::size_t>(i)];
      const auto corner = [&](std::size_t m) { return cell.v[static_cast<std::size_t>(f[m])]; };
      if (exact::orient3d(at(corner(0)), at(corner(1)), at(corner(2)), q) >= 0) continue;
      out = i;
      if constexpr (kInSlab) {
        const auto own = [&](Vertex v) { return v != ghost_ && owns(v); };
        if (!own(corner(0)) && !own(corner(1)) && !own(corner(2))) return {t, Located::outside_slab};
      }
    }
    if (out < 0) return {t, Located::corner};
    const Face next = cell.n[static_cast<std::size_t>(out)];
    t = tet_of(next);
    came = side_of(next);
  }
}

void Inserter::note_duplicate(Tet t, Vertex k) {
  const double* q = at(k);
  for (const Vertex v : triangulation_.cells()[t].v)
    if (v != ghost_ && std::equal(q, q + 3, at(v))) triangulation_.note_duplicate(v, k);
}

// Collects the cells in conflict with q and the faces round them; false if one of them is not owned.
//
// The outcome of a test is a coin toss to the processor, so both lists are written always and only
// their lengths depend on it; sign bits do the marking.
template <Inserter::Mode kMode>
bool Inserter::dig(Tet seed, const double* q, Vertex k) {
  Cell* const cells = triangulation_.cells().data();
  const Triangulation::Site* const sites = sites_;
  const double qx = q[0], qy = q[1], qz = q[2];
  std::size_t count = 0;
  std::size_t faces = 0;
  cavity_count_ = 0;
  if (kMode == Mode::in_slab && !owns_all(cells[seed])) return false;
  bool escapes = false;
  double nowhere = 0;
  const auto look = [&](const Cell& cell, Tet t, std::size_t i) {
    const Face across = cell.n[i];
    Cell& next = cells[tet_of(across)];
    Filtered test = filtered_conflict(next, sites[next.v[0]].x.data(), qx, qy, qz);
    if (!test.decided) [[unlikely]]
      test.f = triangulation_.in_conflict_exact<kMode == Mode::in_order>(next, q, k) ? -1.0 : 1.0;
    const std::uint64_t conflict = bits_of(test.f) & kSign;
    const std::uint64_t before = bits_of(next.reach);
    const std::uint64_t after = before | conflict;
    if constexpr (kMode == Mode::in_slab) {
      // Three of its corners are owned, for they are those of the cell that it was reached from.
      const bool own = owns(next.v[across & 3u]);
      *(own ? &next.reach : &nowhere) = std::bit_cast<double>(after);
      escapes = escapes | (!own && after != before);
    } else {
      next.reach = std::bit_cast<double>(after);
    }
    cavity_[count] = across;
    count += (after ^ before) >> 63;
    rim_[faces] = face_code(t, static_cast<int>(i));
    faces += (after >> 63) ^ 1;
  };
  cells[seed].reach = std::bit_cast<double>(bits_of(cells[seed].reach) | kSign);
  cavity_[count++] = face_code(seed, 0);
  look(cells[seed], seed, 0);
  for (std::size_t j = 0; j < count && !escapes; ++j) {
    if (count + 4 > cavity_.size()) cavity_.resize(2 * cavity_.size());
    if (faces + 4 > rim_.size()) rim_.resize(2 * rim_.size());
    const Face reached = cavity_[j];
    const Tet t = tet_of(reached);
    const Cell& cell = cells[t];
    for (unsigned i = 1; i < 4; ++i) look(cell, t, (reached + i) & 3u);
  }
  cavity_count_ = count;
  face_count_ = faces;
  return !escapes;
}

// Takes the marks of a cavity back.
void Inserter::restore_cavity() {
  Cell* const cells = triangulation_.cells().data();
  for (std::size_t j = 0; j < cavity_count_; ++j) {
    Cell& cell = cells[tet_of(cavity_[j])];
    if (std::signbit(cell.reach)) cell.reach = std::bit_cast<double>(bits_of(cell.reach) & ~kSign);
  }
}

// Makes sure that there are slots for the cells to come, growing the array if nobody else uses it.
template <bool kGrow>
bool Inserter::find_slots() {
  while (cavity_count_ + free_.size() + (end_slot_ - next_slot_) < face_count_) {
    const std::size_t needed = face_count_ - cavity_count_;
    const SlotBlock block = kGrow ? triangulation_.grow_slots(needed) : triangulation_.claim_slots(needed);
    if (block.first == block.end) return false;
    if (block.first != end_slot_) {
      give_slots_back();
      next_slot_ = block.first;
    }
    end_slot_ = block.end;
  }
  return true;
}

void Inserter::give_slots_back() {
  Cell* const cells = triangulation_.cells().data();
  for (; next_slot_ < end_slot_; ++next_slot_) {
    cells[next_slot_].reach = -0.0;
    free_.push_back(next_slot_);
  }
}

// Gives one slot to each boundary face: those of the cavity first.
void Inserter::take_slots() {
  const Cell* const cells = triangulation_.cells().data();
  for (std::size_t i = 0; i < cavity_count_; ++i) {
    const Cell& cell = cells[tet_of(cavity_[i])];
    sites_[cell.v[0]].cells -= cell.v[3] == ghost_ ? 0 : 1;
  }
  while (cavity_count_ > face_count_) free_.push_back(tet_of(cavity_[--cavity_count_]));
  std::size_t j = 0;
  for (; j < cavity_count_; ++j) boundary_[j].slot = tet_of(cavity_[j]);
  for (; j < face_count_ && !free_.empty(); ++j) {
    boundary_[j].slot = free_.back();
    free_.pop_back();
  }
  for (; j < face_count_; ++j) boundary_[j].slot = next_slot_++;
}

// Reads the faces round the cavity off its cells, whose slots are about to be used again.
// The boundary face (v0, v1, v2) sees the new vertex p; the new cell is (p, v1, v0, v2), with the ghost last.
template <bool kByTable>
void Inserter::list_boundary() {
  Cell* const cells = triangulation_.cells().data();
  Triangulation::Site* const sites = sites_;
  Vertex* const ring = ring_.data();
  Face* const table = table_.data();
  const std::size_t count = face_count_;
  std::uint32_t fresh = 0;
  // The place of v in the ring, with v added if it is not there: without a branch, which would be hard
  // to predict. The ring has room for one entry more than it comes to hold.
  const auto local_index = [&](Vertex v) {
    std::uint32_t& place = sites[v == ghost_ ? own_ghost_ : v].local;
    const std::uint32_t old = std::min(place, fresh);
    const std::uint32_t known =
        static_cast<std::uint32_t>(old < fresh) & static_cast<std::uint32_t>(ring[old] == v);
    ring[fresh] = v;
    const std::uint32_t local = fresh ^ ((old ^ fresh) & (0u - known));
    place = local;
    fresh += 1 - known;
    return local;
  };
  for (std::size_t j = 0; j < count; ++j) {
    const Cell& inner = cells[tet_of(rim_[j])];
    const auto i = static_cast<std::size_t>(side_of(rim_[j]));
    const auto& f = kFaceVertex[i];
    Vertex a = inner.v[static_cast<std::size_t>(f[1])];
    Vertex b = inner.v[static_cast<std::size_t>(f[0])];
    Vertex c = inner.v[static_cast<std::size_t>(f[2])];
    if (a == ghost_) [[unlikely]] {
      a = std::exchange(b, std::exchange(c, a));
    } else if (b == ghost_) [[unlikely]] {
      b = std::exchange(a, std::exchange(c, b));
    }
    const std::uint32_t la = local_index(a), lb = local_index(b), lc = local_index(c);
    BoundaryFace& face = boundary_[j];
    face.outer = inner.n[i];
    face.v = {a, b, c};
    face.local = {la, lb, lc};
    cells[tet_of(face.outer)].n[face.outer & 3u] = face_code(face.slot, 0);
    if constexpr (kByTable) {
      table[lb * kTableSide + lc] = face_code(face.slot, 1);
      table[lc * kTableSide + la] = face_code(face.slot, 2);
      table[la * kTableSide + lb] = face_code(face.slot, 3);
    }
  }
  ring_count_ = fresh;
}

// Joins vertex k to the boundary of the cavity.
void Inserter::fill(Vertex k) {
  if (boundary_.size() < face_count_) boundary_.resize(rim_.size());
  const std::size_t ring_size = face_count_ / 2 + 2;  // Euler's relation for a sphere of triangles
  if (ring_.size() <= ring_size) {
    ring_.resize(rim_.size());
    spokes_.resize(rim_.size());
  }
  take_slots();
  const bool by_table = ring_size <= kTableSide;
  if (by_table)
    list_boundary<true>();
  else
    list_boundary<false>();
  const double* p = at(k);
  for (std::size_t l = 0; l < ring_count_; ++l) spokes_[l] = spoke(p, at(ring_[l]));
  set_geometry(k);
  if (by_table)
    link_by_table();
  else
    link_by_hash();
}

// The number of faces of a closed surface is even, so they go in pairs.
void Inserter::set_geometry(Vertex k) {
  Cell* const cells = triangulation_.cells().data();
  const Spoke* const spokes = spokes_.data();
  bool ghosts = false;
  for (std::size_t j = 0; j < face_count_; j += 2) {
    const BoundaryFace &f = boundary_[j], &g = boundary_[j + 1];
    Cell &s = cells[f.slot], &t = cells[g.slot];
    s.v = {k, f.v[0], f.v[1], f.v[2]};
    t.v = {k, g.v[0], g.v[1], g.v[2]};
    s.n[0] = f.outer;
    t.n[0] = g.outer;
    set_spheres({&s, &t}, {&spokes[f.local[0]], &spokes[g.local[0]]},
                {&spokes[f.local[1]], &spokes[g.local[1]]}, {&spokes[f.local[2]], &spokes[g.local[2]]});
    ghosts = ghosts || f.v[2] == ghost_ || g.v[2] == ghost_;
  }
  sites_[k].cells = static_cast<std::uint32_t>(face_count_);
  last_ = boundary_[0].slot;
  if (!ghosts) [[likely]]
    return;
  for (std::size_t j = 0; j < face_count_; ++j) {
    const BoundaryFace& f = boundary_[j];
    if (f.v[2] == ghost_) {
      set_half_space(cells[f.slot], spokes[f.local[0]], spokes[f.local[1]], triangulation_.diameter());
      --sites_[k].cells;
    } else {
      last_ = f.slot;
    }
  }
}

// Face i of a new cell (i = 1, 2, 3) lies at the boundary edge opposite local vertex i - 1; the
// neighbour has the same edge reversed. The boundary is closed, so every entry read has been written.
void Inserter::link_by_table() {
  const Face* const table = table_.data();
  Cell* const cells = triangulation_.cells().data();
  for (std::size_t j = 0; j < face_count_; ++j) {
    const auto [a, b, c] = boundary_[j].local;
    Cell& cell = cells[boundary_[j].slot];
    cell.n[1] = table[c * kTableSide + b];
    cell.n[2] = table[a * kTableSide + c];
    cell.n[3] = table[b * kTableSide + a];
  }
}

// The same for boundaries with more vertices than the table has sides. Each edge is met twice: the
// first face leaves its code, the second links the two.
void Inserter::link_by_hash() {
  const std::size_t size = std::bit_ceil(3 * face_count_);
  if (hash_.size() < size) hash_.resize(size);
  const auto shift = static_cast<unsigned>(64 - std::countr_zero(size));
  ++epoch_;
  Cell* const cells = triangulation_.cells().data();
  const auto meet = [&](std::uint32_t a, std::uint32_t b, Face face) {
    const EdgeKey key = edge_key(a, b);
    std::size_t h = (key * 0x9E3779B97F4A7C15ull) >> shift;
    while (hash_[h].epoch == epoch_ && hash_[h].key != key) h = (h + 1) & (size - 1);
    if (hash_[h].epoch != epoch_) {
      hash_[h] = {key, face, epoch_};
      return;
    }
    const Face other = hash_[h].face;
    cells[tet_of(face)].n[face & 3u] = other;
    cells[tet_of(other)].n[other & 3u] = face;
  };
  for (std::size_t j = 0; j < face_count_; ++j) {
    const auto [a, b, c] = boundary_[j].local;
    const Tet t = boundary_[j].slot;
    meet(b, c, face_code(t, 1));
    meet(c, a, face_code(t, 2));
    meet(a, b, face_code(t, 3));
  }
}

// Puts the highest vertex first in cells where it is not the new one.
void Inserter::turn_new_cells(Vertex k) {
  const auto above = [&](Vertex v) { return v > k && v != ghost_; };
  if (std::none_of(ring_.begin(), ring_.begin() + ring_count_, above)) return;
  for (std::size_t j = 0; j < face_count_; ++j) turn(boundary_[j].slot);
}

void Inserter::turn(Tet t) {
  // Even permutations, which leave the ghost in its place.
  static constexpr std::array<std::array<std::size_t, 4>, 4> kTurn{
      {{0, 1, 2, 3}, {1, 2, 0, 3}, {2, 0, 1, 3}, {3, 2, 1, 0}}};
  Cell* const cells = triangulation_.cells().data();
  Cell& cell = cells[t];
  const auto corners = cell.v;
  const auto neighbours = cell.n;
  const auto finite_end = corners.begin() + (corners[3] == ghost_ ? 3 : 4);
  const auto& turn =
      kTurn[static_cast<std::size_t>(std::max_element(corners.begin(), finite_end) - corners.begin())];
  for (std::size_t i = 0; i < 4; ++i) {
    const Face across = neighbours[turn[i]];
    cell.v[i] = corners[turn[i]];
    cell.n[i] = across;
    cells[tet_of(across)].n[across & 3u] = face_code(t, static_cast<int>(i));
  }
  if (corners[3] != ghost_) {
    --sites_[corners[0]].cells;
    ++sites_[cell.v[0]].cells;
  }
  triangulation_.set_geometry(cell);
}

}  // namespace holdfast
