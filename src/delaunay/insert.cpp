#include "delaunay/insert.h"

#include <algorithm>

#include "exact/predicates.h"

namespace holdfast {
namespace {

// Puts the highest vertex of a cell first.
void turn(Triangulation& triangulation, Tet t) {
  // Even permutations that leave the ghost in its place.
  static constexpr std::array<std::array<std::size_t, 4>, 4> kTurn{
      {{0, 1, 2, 3}, {1, 2, 0, 3}, {2, 0, 1, 3}, {3, 2, 1, 0}}};
  Cell* const cells = triangulation.cells().data();
  Cell& cell = cells[t];
  const bool ghost = triangulation.is_ghost(cell);
  const auto corners = cell.v;
  const auto neighbours = cell.n;
  const auto finite_end = corners.begin() + (ghost ? 3 : 4);
  const auto& turn =
      kTurn[static_cast<std::size_t>(std::max_element(corners.begin(), finite_end) - corners.begin())];
  for (std::size_t i = 0; i < 4; ++i) {
    const Face across = neighbours[turn[i]];
    cell.v[i] = corners[turn[i]];
    cell.n[i] = across;
    cells[tet_of(across)].n[across & 3u] = face_code(t, static_cast<int>(i));
  }
  if (!ghost) {
    --triangulation.sites()[corners[0]].cells;
    ++triangulation.sites()[cell.v[0]].cells;
  }
  triangulation.set_geometry(cell);
}

// Puts the highest vertex first in the new cells whose highest vertex is not the new vertex k.
void turn_new_cells(Triangulation& triangulation, const CavityBoundary& boundary, Vertex k) {
  const auto above = [&](Vertex v) { return v > k && v != triangulation.ghost(); };
  const auto ring = boundary.vertices();
  if (std::none_of(ring.begin(), ring.end(), above)) return;
  for (const CavityFace& face : boundary.faces()) turn(triangulation, face.slot);
}

}  // namespace

void Inserter::insert(Vertex k) { insert_as<Insertion::in_order>(k); }
void Inserter::insert_late(Vertex k) { insert_as<Insertion::late>(k); }
bool Inserter::insert_in_slab(Vertex k) { return insert_as<Insertion::in_slab>(k); }

template <Insertion kMode>
bool Inserter::insert_as(Vertex k) {
  const double* q = at(k);
  const Located seed = locate<kMode == Insertion::in_slab>(q);
  if (seed.what == Located::outside_slab) return false;
  if (seed.what == Located::corner) {
    note_duplicate(seed.tet, k);
    return true;
  }
  const bool dug = cavity_.dig<kMode>(triangulation_, own_, seed.tet, q, k);
  const std::size_t cells = cavity_.cells().size(), faces = cavity_.rim().size();
  if (!dug || (cells < faces && !slots_.provide<kMode != Insertion::in_slab>(faces - cells))) {
    cavity_.restore(triangulation_);
    return false;
  }
  fill(k);
  if (kMode != Insertion::in_order) turn_new_cells(triangulation_, boundary_, k);
  return true;
}

// If k is beyond the hull, enters the cell inside, because a walk begins in a finite cell.
bool Inserter::enter(const Slab& slab, Vertex k, Tet from) {
  own_.move_to(slab);
  last_ = from;
  last_ = locate<false>(at(k)).tet;
  const LargeArray<Cell>& cells = triangulation_.cells();
  if (triangulation_.is_ghost(cells[last_])) last_ = tet_of(cells[last_].n[3]);
  return own_.touches(cells[last_]);
}

// Remembering stochastic visibility walk (Devillers, Pion, Teillaud 2002). From a finite cell, it ends with
// probability one in any triangulation. It may stop at any cell in strict conflict; the cell that contains q
// is one, unless q is one of its corners. A ghost is entered only through a face that q lies strictly beyond.
template <bool kInSlab>
Inserter::Located Inserter::locate(const double* q) {
  const Cell* const cells = triangulation_.cells().data();
  Tet t = last_;
  int came = -1;
  for (;;) {
    const Cell& cell = cells[t];
    if (triangulation_.strictly_in_conflict(cell, q)) return {t, Located::conflict};
    const auto first = static_cast<int>(random_() & 3u);
    int out = -1;
    for (int j = 0; j < 4 && out < 0; ++j) {
      const int i = (first + j) & 3;
      if (i == came) continue;
      const auto& f = kFaceVertex[static_cast<std::size_t>(i)];
      const auto corner = [&](std::size_t m) { return cell.v[static_cast<std::size_t>(f[m])]; };
      if (exact::orient3d(at(corner(0)), at(corner(1)), at(corner(2)), q) >= 0) continue;
      out = i;
      if constexpr (kInSlab) {
        if (!own_.has_point(corner(0)) && !own_.has_point(corner(1)) && !own_.has_point(corner(2)))
          return {t, Located::outside_slab};
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
    if (v != triangulation_.ghost() && std::equal(q, q + 3, at(v))) triangulation_.note_duplicate(v, k);
}

// Joins vertex k to the boundary of the cavity.
void Inserter::fill(Vertex k) {
  const bool by_table = boundary_.take(triangulation_, cavity_.cells(), cavity_.rim(), slots_, links_.table(),
                                       EdgeLinks::kTableSide);
  boundary_.look_from(triangulation_, at(k));
  set_geometry(k);
  Cell* const cells = triangulation_.cells().data();
  if (by_table)
    links_.by_table(boundary_.faces(), cells);
  else
    links_.by_hash(boundary_.faces(), cells);
}

// A closed surface has an even number of faces, so they are processed in pairs.
void Inserter::set_geometry(Vertex k) {
  Cell* const cells = triangulation_.cells().data();
  const Spoke* const spokes = boundary_.spokes();
  const std::span<const CavityFace> faces = boundary_.faces();
  const Vertex ghost = triangulation_.ghost();
  bool ghosts = false;
  for (std::size_t j = 0; j < faces.size(); j += 2) {
    const CavityFace &f = faces[j], &g = faces[j + 1];
    Cell &s = cells[f.slot], &t = cells[g.slot];
    s.v = {k, f.v[0], f.v[1], f.v[2]};
    t.v = {k, g.v[0], g.v[1], g.v[2]};
    s.n[0] = f.outer;
    t.n[0] = g.outer;
    set_spheres({&s, &t}, {&spokes[f.local[0]], &spokes[g.local[0]]},
                {&spokes[f.local[1]], &spokes[g.local[1]]}, {&spokes[f.local[2]], &spokes[g.local[2]]});
    ghosts = ghosts || f.v[2] == ghost || g.v[2] == ghost;
  }
  std::uint32_t& finite = triangulation_.sites()[k].cells;
  finite = static_cast<std::uint32_t>(faces.size());
  last_ = faces[0].slot;
  if (!ghosts) [[likely]]
    return;
  for (const CavityFace& f : faces) {
    if (f.v[2] == ghost) {
      set_half_space(cells[f.slot], spokes[f.local[0]], spokes[f.local[1]], triangulation_.diameter());
      --finite;
    } else {
      last_ = f.slot;
    }
  }
}

}  // namespace holdfast
