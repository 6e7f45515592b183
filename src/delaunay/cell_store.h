// A growing array of cells for millions of tetrahedra: aligned to cache lines, on huge pages where the
// system has them (a third of the time of a naive array is page faults and misses of the address
// cache), and growing without holding two whole copies.
#pragma once

#include <cstddef>
#include <utility>

#include "delaunay/cell.h"

namespace holdfast {

/// Asks the system to back a large block by huge pages; a hint, without effect elsewhere.
void advise_huge_pages(void* block, std::size_t bytes);

class CellStore {
 public:
  CellStore() = default;
  CellStore(const CellStore&) = delete;
  CellStore& operator=(const CellStore&) = delete;
  ~CellStore();

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] std::size_t capacity() const { return capacity_; }
  [[nodiscard]] Cell* data() { return cells_; }
  [[nodiscard]] const Cell* data() const { return cells_; }
  Cell& operator[](std::size_t t) { return cells_[t]; }
  const Cell& operator[](std::size_t t) const { return cells_[t]; }
  [[nodiscard]] const Cell* begin() const { return cells_; }
  [[nodiscard]] const Cell* end() const { return cells_ + size_; }

  /// Gives the memory of about the first `count` cells back to the system; they must not be read again.
  void forget_first(std::size_t count);

  /// Memory is taken from the system only when cells come to use it.
  void reserve(std::size_t capacity);
  /// New cells are not initialised. The capacity must have been reserved.
  void resize(std::size_t size) { size_ = size; }

 private:
  Cell* cells_ = nullptr;
  std::size_t size_ = 0;
  std::size_t capacity_ = 0;
  std::size_t forgotten_ = 0;
};

}  // namespace holdfast
