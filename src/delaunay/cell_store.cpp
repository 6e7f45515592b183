#include "delaunay/cell_store.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace holdfast {
namespace {

constexpr std::size_t kHugePage = std::size_t{1} << 21;
constexpr std::size_t kLarge = 4 * kHugePage;

std::size_t alignment_of(std::size_t bytes) { return bytes >= kLarge ? kHugePage : alignof(Cell); }

Cell* allocate(std::size_t count) {
  const std::size_t bytes = count * sizeof(Cell);
  void* block = ::operator new (bytes, std::align_val_t{alignment_of(bytes)});
  if (bytes >= kLarge) advise_huge_pages(block, bytes);
  return static_cast<Cell*>(block);
}

void release(Cell* cells, std::size_t count) {
  if (cells != nullptr) ::operator delete (cells, std::align_val_t{alignment_of(count * sizeof(Cell))});
}

// Gives the memory of whole pages back before the block itself is freed.
void give_back([[maybe_unused]] void* block, [[maybe_unused]] std::size_t bytes) {
#ifdef __linux__
  madvise(block, bytes, MADV_DONTNEED);
#endif
}

}  // namespace

void advise_huge_pages([[maybe_unused]] void* block, [[maybe_unused]] std::size_t bytes) {
#ifdef __linux__
  const auto begin = reinterpret_cast<std::uintptr_t>(block);
  const std::uintptr_t first = (begin + kHugePage - 1) & ~(kHugePage - 1);
  const std::uintptr_t last = (begin + bytes) & ~(kHugePage - 1);
  if (first < last) madvise(reinterpret_cast<void*>(first), last - first, MADV_HUGEPAGE);
#endif
}

CellStore::~CellStore() { release(cells_, capacity_); }

void CellStore::forget_first(std::size_t count) {
  if (capacity_ * sizeof(Cell) < kLarge) return;
  constexpr std::size_t kBlock = kHugePage / sizeof(Cell);
  for (; forgotten_ + kBlock <= count; forgotten_ += kBlock) give_back(cells_ + forgotten_, kHugePage);
}

void CellStore::reserve(std::size_t capacity) {
  if (capacity <= capacity_) return;
  Cell* cells = allocate(capacity);
  // Block by block, each given back once copied.
  const bool large = capacity_ * sizeof(Cell) >= kLarge;
  constexpr std::size_t kBlock = kHugePage / sizeof(Cell);
  for (std::size_t first = 0; first < size_; first += kBlock) {
    const std::size_t count = std::min(kBlock, size_ - first);
    std::memcpy(cells + first, cells_ + first, count * sizeof(Cell));
    if (large && count == kBlock) give_back(cells_ + first, kHugePage);
  }
  release(cells_, capacity_);
  cells_ = cells;
  capacity_ = capacity;
}

}  // namespace holdfast
