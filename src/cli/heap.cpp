#include "heap.h"

#include <cstdint>
#include <cstdlib>

#ifdef __GLIBC__
#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>
#endif

namespace holdfast::cli {

#ifdef __GLIBC__
namespace {

constexpr int kLargest = 1 << 24;  // larger blocks have pages of their own, and give them back
constexpr int kAhead = 1 << 28;    // address space, not memory; large arrays ask for huge pages themselves
constexpr int kStep = 1 << 20;     // of the heap beyond that
constexpr std::uintptr_t kHugePage = 1 << 21;

}  // namespace

void prepare_heap() {
  mallopt(M_MMAP_THRESHOLD, kLargest);
  mallopt(M_TRIM_THRESHOLD, 2 * kAhead);
  // A block that does not fit into the first pages makes the heap grow. Where address space is limited, it
  // may not grow so far.
  mallopt(M_TOP_PAD, kAhead);
  void* const block = std::malloc(kLargest / 2);
  mallopt(M_TOP_PAD, kStep);
  const auto first = reinterpret_cast<std::uintptr_t>(block);
  const std::uintptr_t begin = (first / kHugePage + 1) * kHugePage;
  const std::uintptr_t end = reinterpret_cast<std::uintptr_t>(sbrk(0)) / kHugePage * kHugePage;
  if (block == nullptr || begin >= end ||
      madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE) != 0) {
    std::free(block);
    return;
  }
  // What lies before the first huge page stays taken, and is never touched.
  [[maybe_unused]] const void* const before = std::realloc(block, begin - first - 2 * sizeof(std::size_t));
}
#else
void prepare_heap() {}
#endif

}  // namespace holdfast::cli
