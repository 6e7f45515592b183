#include "delaunay/links.h"

#include <bit>

#include "mesh/keys.h"
#include "numbers/mix.h"

namespace holdfast {

// Face i of a new cell (i = 1, 2, 3) lies at the boundary edge opposite local vertex i - 1; the
// neighbour has the same edge reversed. The boundary is closed, so every entry read has been written.
void EdgeLinks::by_table(std::span<const CavityFace> faces, Cell* cells) const {
  const Face* const table = table_.data();
  for (const CavityFace& face : faces) {
    const auto [a, b, c] = face.local;
    Cell& cell = cells[face.slot];
    cell.n[1] = table[c * kTableSide + b];
    cell.n[2] = table[a * kTableSide + c];
    cell.n[3] = table[b * kTableSide + a];
  }
}

// Each edge is visited twice: the first face stores its code, the second links the two.
void EdgeLinks::by_hash(std::span<const CavityFace> faces, Cell* cells) {
  const std::size_t size = std::bit_ceil(3 * faces.size());
  if (hash_.size() < size) hash_.resize(size);
  const auto shift = static_cast<unsigned>(64 - std::countr_zero(size));
  ++epoch_;
  const auto meet = [&](std::uint32_t a, std::uint32_t b, Face face) {
    const EdgeKey key = edge_key(a, b);
    std::size_t h = (key * numbers::kGolden) >> shift;
    while (hash_[h].epoch == epoch_ && hash_[h].key != key) h = (h + 1) & (size - 1);
    if (hash_[h].epoch != epoch_) {
      hash_[h] = {key, face, epoch_};
      return;
    }
    const Face other = hash_[h].face;
    cells[tet_of(face)].n[face & 3u] = other;
    cells[tet_of(other)].n[other & 3u] = face;
  };
  for (const CavityFace& face : faces) {
    const auto [a, b, c] = face.local;
    meet(b, c, face_code(face.slot, 1));
    meet(c, a, face_code(face.slot, 2));
    meet(a, b, face_code(face.slot, 3));
  }
}

}  // namespace holdfast
