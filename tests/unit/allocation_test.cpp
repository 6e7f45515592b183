// Memory that runs out: whichever allocation of a call fails, the call ends with std::bad_alloc or its
// outcome, or does without; nothing leaks or crashes, and the arguments are unchanged.
//
// The program's own operator new counts, and fails at a chosen number: once, or from there on.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <functional>
#include <new>

#include "hard_surfaces.h"
#include "holdfast/check.h"
#include "holdfast/holdfast.h"
#include "holdfast/io.h"
#include "holdfast/untangle.h"
#include "io_samples.h"
#include "small_surfaces.h"

namespace {

std::atomic<long> allocations = 0, alive = 0;
std::atomic<long> fails_at = 0, fails_until = 0;  // 0: never

void* allocate(std::size_t size, std::size_t alignment) noexcept {
  const long number = ++allocations;
  if (fails_at != 0 && number >= fails_at && number <= fails_until) return nullptr;
  const std::size_t whole = (std::max<std::size_t>(size, 1) + alignment - 1) / alignment * alignment;
  void* const memory = alignment <= alignof(std::max_align_t) ? std::malloc(std::max<std::size_t>(size, 1))
                                                              : std::aligned_alloc(alignment, whole);
  if (memory != nullptr) ++alive;
  return memory;
}

void* allocate_or_throw(std::size_t size, std::size_t alignment) {
  void* const memory = allocate(size, alignment);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

void release(void* memory) noexcept {
  if (memory == nullptr) return;
  --alive;
  std::free(memory);
}

constexpr std::size_t kUsual = alignof(std::max_align_t);

}  // namespace

void* operator new(std::size_t size) { return allocate_or_throw(size, kUsual); }
void* operator new[](std::size_t size) { return allocate_or_throw(size, kUsual); }
void* operator new(std::size_t size, std::align_val_t a) { return allocate_or_throw(size, std::size_t(a)); }
void* operator new[](std::size_t size, std::align_val_t a) { return allocate_or_throw(size, std::size_t(a)); }
void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return allocate(size, kUsual); }
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept { return allocate(size, kUsual); }
void operator delete(void* memory) noexcept { release(memory); }
void operator delete[](void* memory) noexcept { release(memory); }
void operator delete(void* memory, std::size_t) noexcept { release(memory); }
void operator delete[](void* memory, std::size_t) noexcept { release(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { release(memory); }
void operator delete[](void* memory, std::align_val_t) noexcept { release(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { release(memory); }
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept { release(memory); }
void operator delete(void* memory, const std::nothrow_t&) noexcept { release(memory); }
void operator delete[](void* memory, const std::nothrow_t&) noexcept { release(memory); }

namespace holdfast::allocation_test {
namespace {

constexpr long kMostRuns = 400;

// Runs `call` with every allocation failing in turn, or with a number of them, evenly chosen.
//
// `call` returns whether it completed; an exception other than std::bad_alloc fails the test.
void expect_to_stand_failures(const std::function<bool()>& call) {
  ASSERT_TRUE(call());  // this also makes what a process makes only once
  const long before = allocations;
  ASSERT_TRUE(call());
  const long count = allocations - before;
  ASSERT_GT(count, 10);
  const long step = std::max(1L, count / kMostRuns);
  long failures = 0;
  for (const bool once : {true, false})
    for (long number = 1; number <= count; number += step) {
      const long held = alive, start = allocations;
      fails_until = once ? start + number : std::numeric_limits<long>::max();
      fails_at = start + number;
      bool usual = false;
      try {
        usual = call();
      } catch (const std::bad_alloc&) {
      } catch (const FileError& error) {
        if (std::string_view(error.what()).find("memory") == std::string_view::npos) throw;
      } catch (const std::exception& error) {
        fails_at = 0;
        ADD_FAILURE() << "allocation " << number << " of " << count << ": " << error.what();
      }
      fails_at = 0;
      failures += usual ? 0 : 1;
      ASSERT_EQ(alive, held) << "a leak after allocation " << number << " of " << count;
    }
  EXPECT_GT(failures, count / step);
}

bool meshes(const Surface& surface, const Options& options) {
  const Result result = mesh(surface.view(), options);
  if (result.outcome == Outcome::memory_limit) {
    if (options.memory_limit == 0 || !result.volume.tetrahedra.empty())
      throw std::logic_error("half an outcome");
    return false;
  }
  if (result.outcome != Outcome::done) throw std::logic_error("outcome: " + result.message);
  return true;
}

TEST(Allocation, OfAMesh) {
  hard::Random random(3);
  const Surface prism = hard::twisted_prism(random), before = prism;
  for (const bool flips : {true, false}) {
    Options options;
    options.flips = flips;
    expect_to_stand_failures([&] { return meshes(prism, options); });
  }
  EXPECT_EQ(prism.vertices, before.vertices);
  EXPECT_EQ(prism.facets, before.facets);
}

TEST(Allocation, OfAMeshWithALimit) {
  const Surface surface = small::without_integer_points(0);
  Options options;
  options.memory_limit = std::uint64_t{1} << 40u;
  expect_to_stand_failures([&] { return meshes(surface, options); });
}

TEST(Allocation, OfFieldPoints) {
  const Surface box = small::touching();
  Options options;
  options.sizes = Sizes{.size = 0.5};
  expect_to_stand_failures([&] { return meshes(box, options); });
}

TEST(Allocation, OnThreads) {
  const Surface sphere = hard::icosphere(3);
  Options options;
  options.threads = 2;
  options.optimise = false;
  expect_to_stand_failures([&] { return meshes(sphere, options); });
}

TEST(Allocation, OfADiagnosis) {
  Surface crossed = small::box();
  small::add_triangle(crossed, {0.5, 0.5, -1}, {0.5, 0.6, 2}, {0.6, 0.5, 0.5});
  expect_to_stand_failures([&] { return !diagnose(crossed.view()).empty(); });
}

TEST(Allocation, OfACheck) {
  const Surface box = small::nested(true);
  const Volume volume = mesh(box.view()).volume;
  expect_to_stand_failures([&] {
    if (!check(box.view(), volume).holds()) throw std::logic_error("a rule is broken");
    return true;
  });
}

TEST(Allocation, OfUntangling) {
  Surface box = small::box({0, 0, 0}, {4, 4, 4});
  for (int k = 0; k < 8; ++k)
    box.vertices.push_back({1.0 + 2 * (k & 1), 1.0 + (k & 2), 1.0 + (k >> 2 & 1) * 2.0});
  Volume volume = mesh(box.view()).volume;
  volume.vertices[8] = {3.5, 3.5, 3.5};
  expect_to_stand_failures([&] {
    const UntangleResult result = untangle(volume);
    if (result.outcome != Outcome::done) throw std::logic_error("outcome: " + result.message);
    return true;
  });
}

TEST(Allocation, OfFiles) {
  const samples::TemporaryFolder folder;
  const Volume volume = samples::sample_volume();
  for (const char* const name : {"a.vtu", "a.mesh", "a.meshb", "a.msh", "a.vtk", "a.node"}) {
    expect_to_stand_failures([&] {
      write_volume(folder / name, volume);
      if (read_volume(folder / name).tetrahedra.size() != volume.tetrahedra.size())
        throw std::logic_error("other tetrahedra");
      return true;
    });
    const auto names = folder.names();
    EXPECT_TRUE(std::none_of(names.begin(), names.end(),
                             [](const std::string& n) { return n.find("tmp") != n.npos; }));
    for (const auto& left : names) std::filesystem::remove(folder / left);
  }
}

}  // namespace
}  // namespace holdfast::allocation_test
