#include "mesh/large_array.h"

#include <cstdint>
#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace holdfast {
namespace {

constexpr std::size_t kLine = 64;  // of a cache
constexpr std::size_t kHugePage = std::size_t{1} << 21;
constexpr std::size_t kLarge = 4 * kHugePage;

std::align_val_t alignment_of(std::size_t bytes) {
  return std::align_val_t{bytes >= kLarge ? kHugePage : kLine};
}

#ifdef __linux__
// Calls madvise on the pages that lie wholly in the block.
void advise(void* block, std::size_t bytes, std::size_t page, int advice) {
  const std::size_t before = reinterpret_cast<std::uintptr_t>(block) % page;
  const std::size_t first = before == 0 ? 0 : page - before;
  const std::size_t behind = (before + bytes) % page;
  if (first + behind < bytes) madvise(static_cast<char*>(block) + first, bytes - first - behind, advice);
}
constexpr std::size_t kPage = 4096;  // where pages are larger, less is advised
#endif

}  // namespace

void* allocate_large(std::size_t bytes) {
  void* block = ::operator new(bytes, alignment_of(bytes));
  if (bytes >= kLarge) advise_huge_pages(block, bytes);
  return block;
}

void free_large(void* block, std::size_t bytes) { ::operator delete(block, alignment_of(bytes)); }

void advise_huge_pages([[maybe_unused]] void* block, [[maybe_unused]] std::size_t bytes) {
#ifdef __linux__
  advise(block, bytes, kHugePage, MADV_HUGEPAGE);
#endif
}

void populate([[maybe_unused]] void* block, [[maybe_unused]] std::size_t bytes) {
#ifdef MADV_POPULATE_WRITE
  if (bytes >= kHugePage) advise(block, bytes, kPage, MADV_POPULATE_WRITE);
#endif
}

void give_back([[maybe_unused]] void* block, [[maybe_unused]] std::size_t bytes) {
#ifdef __linux__
  advise(block, bytes, kPage, MADV_DONTNEED);
#endif
}

}  // namespace holdfast
