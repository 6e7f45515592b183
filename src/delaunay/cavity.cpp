#include "delaunay/cavity.h"

#include <bit>
#include <cmath>

namespace holdfast {
namespace {

constexpr std::size_t kFirstCavity = 256;  // more than most cavities need; it grows
constexpr std::uint64_t kSign = std::uint64_t{1} << 63;

std::uint64_t bits_of(double x) { return std::bit_cast<std::uint64_t>(x); }

}  // namespace

ConflictCavity::ConflictCavity() : cells_(kFirstCavity), rim_(kFirstCavity) {}

// The processor cannot predict the outcome of a test, so both lists are always written and only their lengths
// depend on it. Sign bits do the marking.
template <Insertion kMode>
bool ConflictCavity::dig(Triangulation& triangulation, const Ownership& own, Tet seed, const double* q,
                         Vertex k) {
  Cell* const cells = triangulation.cells().data();
  const Triangulation::Site* const sites = triangulation.sites();
  const double qx = q[0], qy = q[1], qz = q[2];
  std::size_t count = 0;
  std::size_t faces = 0;
  cell_count_ = 0;
  if (kMode == Insertion::in_slab && !own.has_all(cells[seed])) return false;
  bool escapes = false;
  double nowhere = 0;
  const auto look = [&](const Cell& cell, Tet t, std::size_t i) {
    const Face across = cell.n[i];
    Cell& next = cells[tet_of(across)];
    Filtered test = filtered_conflict(next, sites[next.v[0]].x.data(), qx, qy, qz);
    if (!test.decided) [[unlikely]]
      test.f = triangulation.in_conflict_exact<kMode == Insertion::in_order>(next, q, k) ? -1.0 : 1.0;
    const std::uint64_t conflict = bits_of(test.f) & kSign;
    const std::uint64_t before = bits_of(next.reach);
    const std::uint64_t after = before | conflict;
    if constexpr (kMode == Insertion::in_slab) {
      // The inserter owns three of its corners: they belong to the cell from which it was reached.
      const bool is_own = own.has(next.v[across & 3u]);
      *(is_own ? &next.reach : &nowhere) = std::bit_cast<double>(after);
      escapes = escapes | (!is_own && after != before);
    } else {
      next.reach = std::bit_cast<double>(after);
    }
    cells_[count] = across;
    count += (after ^ before) >> 63;
    rim_[faces] = face_code(t, static_cast<int>(i));
    faces += (after >> 63) ^ 1;
  };
  cells[seed].reach = std::bit_cast<double>(bits_of(cells[seed].reach) | kSign);
  cells_[count++] = face_code(seed, 0);
  look(cells[seed], seed, 0);
  for (std::size_t j = 0; j < count && !escapes; ++j) {
    if (count + 4 > cells_.size()) cells_.resize(2 * cells_.size());
    if (faces + 4 > rim_.size()) rim_.resize(2 * rim_.size());
    const Face reached = cells_[j];
    const Tet t = tet_of(reached);
    const Cell& cell = cells[t];
    for (unsigned i = 1; i < 4; ++i) look(cell, t, (reached + i) & 3u);
  }
  cell_count_ = count;
  face_count_ = faces;
  return !escapes;
}

template bool ConflictCavity::dig<Insertion::in_order>(Triangulation&, const Ownership&, Tet, const double*,
                                                       Vertex);
template bool ConflictCavity::dig<Insertion::late>(Triangulation&, const Ownership&, Tet, const double*,
                                                   Vertex);
template bool ConflictCavity::dig<Insertion::in_slab>(Triangulation&, const Ownership&, Tet, const double*,
                                                      Vertex);

void ConflictCavity::restore(Triangulation& triangulation) const {
  Cell* const all = triangulation.cells().data();
  for (const Face reached : cells()) {
    Cell& cell = all[tet_of(reached)];
    if (std::signbit(cell.reach)) cell.reach = std::bit_cast<double>(bits_of(cell.reach) & ~kSign);
  }
}

}  // namespace holdfast
