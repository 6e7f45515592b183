// The memory of an arrangement with many crossings, by counting what is allocated.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>
#include <random>

#include "repair/settle.h"
#include "repair/state.h"
#include "surface/complex.h"

namespace {

std::atomic<std::size_t> in_use = 0, peak = 0;
constexpr std::size_t kHead = alignof(std::max_align_t);  // holds the size

}  // namespace

void* operator new(std::size_t size) {
  void* const at = std::malloc(size + kHead);
  if (at == nullptr) throw std::bad_alloc();
  *static_cast<std::size_t*>(at) = size;
  peak = std::max(peak.load(), in_use += size);
  return static_cast<std::byte*>(at) + kHead;
}

void operator delete(void* p) noexcept {
  if (p == nullptr) return;
  void* const at = static_cast<std::byte*>(p) - kHead;
  in_use -= *static_cast<std::size_t*>(at);
  std::free(at);
}

void operator delete(void* p, std::size_t) noexcept { operator delete(p); }
void* operator new[](std::size_t size) { return operator new(size); }
void operator delete[](void* p) noexcept { operator delete(p); }
void operator delete[](void* p, std::size_t) noexcept { operator delete(p); }

namespace holdfast::arrange_memory_test {
namespace {

Surface noise(std::size_t triangles) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> in(0, 1);
  Surface s;
  for (Index f = 0; f < triangles; ++f) {
    for (int i = 0; i < 3; ++i) s.vertices.push_back({in(random), in(random), in(random)});
    s.facets.push_back({3 * f, 3 * f + 1, 3 * f + 2});
  }
  return s;
}

TEST(ArrangeMemory, IsBoundedByTheNumberOfTriangles) {
  const Surface surface = noise(200);
  const Step step = [](double) {};
  const std::size_t before = in_use;
  peak = before;
  const repairing::State given = repairing::state_of(surface.view());
  repairing::State state = repairing::arranged(given, repairing::arrangement_of(given, step, {}));
  const auto for_each_facet = [&] { return (peak - before) / state.facets.size(); };
  EXPECT_GT(state.facets.size(), 50'000u);
  EXPECT_LT(for_each_facet(), 120u) << "bytes, of the arrangement";
  peak = in_use.load();
  EXPECT_TRUE(repairing::trouble_of(state, step, 1).none());
  EXPECT_LT(for_each_facet(), 300u) << "bytes, of the search";
}

}  // namespace
}  // namespace holdfast::arrange_memory_test
