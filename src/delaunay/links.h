// Links the new cells on a boundary to each other: two of them share each edge of the boundary.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "delaunay/boundary.h"
#include "delaunay/cell.h"

namespace holdfast {

class EdgeLinks {
 public:
  /// Boundaries with at most so many vertices use a table.
  static constexpr std::uint32_t kTableSide = 64;

  EdgeLinks() : table_(kTableSide * kTableSide) {}

  /// Where the boundary writes the faces of new cells at its edges, side by side.
  [[nodiscard]] std::span<Face> table() { return table_; }
  /// Links the cells on `faces`, whose codes are in the table.
  void by_table(std::span<const CavityFace> faces, Cell* cells) const;
  /// The same for boundaries with more vertices than the table has sides.
  void by_hash(std::span<const CavityFace> faces, Cell* cells);

 private:
  struct HashEntry {
    std::uint64_t key;
    Face face;
    std::uint32_t epoch;  // of the insertion that wrote the entry
  };
  std::vector<Face> table_;  // new face at local edge (i, j)
  std::vector<HashEntry> hash_;
  std::uint32_t epoch_ = 0;
};

}  // namespace holdfast
