// Several attempts at one mesh: their totals, and that an error in a later one loses nothing.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <new>
#include <thread>

#include "holdfast/holdfast.h"
#include "number_range_surfaces.h"
#include "small_surfaces.h"

namespace {

// Allocations of this thread until one fails; if negative, none fails.
thread_local long allocations_left = -1;

void* allocate(std::size_t size) {
  if (allocations_left == 0) {
    allocations_left = -1;
    throw std::bad_alloc();
  }
  if (allocations_left > 0) --allocations_left;
  if (void* const memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}

}  // namespace

void* operator new(std::size_t size) { return allocate(size); }
void* operator new[](std::size_t size) { return allocate(size); }
void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return std::malloc(size); }
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept { return std::malloc(size); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }

namespace holdfast::attempts_test {
namespace {

// A surface without a mesh in doubles, so that every attempt is made.
Surface without_doubles() { return small::without_integer_points(0x1p52); }

// The warnings about attempts that failed.
std::vector<std::string> failures(const Result& result) {
  std::vector<std::string> messages;
  for (const Warning& warning : result.warnings)
    if (warning.kind == WarningKind::attempt_failed) messages.push_back(warning.message);
  return messages;
}

// Calls `act` when a certain attempt begins.
std::function<bool(const Progress&)> at_attempt(int which, std::function<void()> act) {
  return [which, act = std::move(act), begun = 0, last = Stage::validate](const Progress& progress) mutable {
    const bool begins = progress.stage == Stage::delaunay && last != Stage::delaunay;
    last = progress.stage;
    if (begins && ++begun == which) act();
    return true;
  };
}

TEST(Attempts, AreCounted) {
  EXPECT_EQ(mesh(small::box()).report.attempts, 1u);
  const Result result = mesh(without_doubles());
  EXPECT_EQ(result.outcome, Outcome::not_representable);
  EXPECT_EQ(result.report.attempts, 5u);
  EXPECT_TRUE(failures(result).empty());
}

TEST(Attempts, AnErrorInALaterOneLosesNothing) {
  const Surface surface = without_doubles();
  for (const long until_failure : {0, 1, 2, 5, 10, 30, 100, 300}) {
    Options options;
    options.progress = at_attempt(2, [&] { allocations_left = until_failure; });
    Result result;
    ASSERT_NO_THROW(result = mesh(surface.view(), options)) << until_failure;
    ASSERT_EQ(allocations_left, -1) << "there are fewer allocations";
    EXPECT_EQ(result.outcome, Outcome::not_representable);
    EXPECT_FALSE(result.volume.tetrahedra.empty());
    EXPECT_FALSE(result.exact_vertices.empty());
    EXPECT_EQ(result.report.attempts, 2u);
    ASSERT_EQ(failures(result).size(), 1u);
    EXPECT_NE(failures(result)[0].find("bad_alloc"), std::string::npos) << failures(result)[0];
  }
}

TEST(Attempts, ALimitInALaterOneLosesNothing) {
  const Surface surface = without_doubles();
  Options options;
  options.time_limit = 3;
  options.progress = at_attempt(3, [] { std::this_thread::sleep_for(std::chrono::seconds(3)); });
  const Result result = mesh(surface.view(), options);
  EXPECT_EQ(result.outcome, Outcome::not_representable);
  EXPECT_FALSE(result.exact_vertices.empty());
  EXPECT_EQ(result.report.attempts, 3u);
}

// The search for a better result leaves time to write the one that exists.
TEST(Attempts, OtherChoicesLeaveTimeForTheResult) {
  const Surface surface = number_range::schoenhardt(1e6, 1e6, 59.9);
  Options options;
  options.time_limit = 6;  // the first attempt takes a tenth of a second
  const auto started = std::chrono::steady_clock::now();
  options.started = started;
  bool slow = false;
  const auto begins = at_attempt(2, [&] { slow = true; });
  options.progress = [&](const Progress& progress) {
    if (slow) std::this_thread::sleep_for(std::chrono::milliseconds(200));
    return begins(progress);
  };
  const Result result = mesh(surface.view(), options);
  ASSERT_TRUE(slow);
  EXPECT_EQ(result.outcome, Outcome::done);
  EXPECT_FALSE(result.volume.tetrahedra.empty());
  EXPECT_LT(std::chrono::steady_clock::now() - started, std::chrono::seconds(5));
}

TEST(Attempts, WhatTheCallbackThrowsEndsTheCall) {
  struct Stop {};
  Options options;
  options.progress = at_attempt(2, [] { throw Stop(); });
  EXPECT_THROW(static_cast<void>(mesh(without_doubles(), options)), Stop);
}

TEST(Attempts, ACancelledOneCancelsTheCall) {
  Options options;
  bool go_on = true;
  auto watch = at_attempt(2, [&] { go_on = false; });
  options.progress = [&](const Progress& progress) { return watch(progress) && go_on; };
  EXPECT_EQ(mesh(without_doubles(), options).outcome, Outcome::cancelled);
}

TEST(Attempts, PartitionPointsOfAllOfThemCount) {
  const Surface surface = without_doubles();
  Options options;
  options.flips = false;
  const Report all = mesh(surface.view(), options).report;
  std::size_t on_segments = 0, in_facets = 0;
  options.stop_after = Stage::eliminate;
  for (options.seed = 1; options.seed <= all.attempts; ++options.seed) {
    const Report one = mesh(surface.view(), options).report;
    on_segments += one.segment_points;
    in_facets += one.facet_points;
  }
  EXPECT_GT(on_segments, 0u);
  EXPECT_EQ(all.segment_points, on_segments);
  EXPECT_EQ(all.facet_points, in_facets);
}

TEST(Attempts, ProgressNeverGoesBack) {
  Options options;
  double last = 0;
  std::size_t told = 0;
  options.progress = [&](const Progress& progress) {
    EXPECT_GE(progress.overall, last);
    EXPECT_LE(progress.overall, 1);
    last = progress.overall;
    ++told;
    return true;
  };
  EXPECT_EQ(mesh(without_doubles(), options).report.attempts, 5u);
  EXPECT_GT(told, 30u);
  EXPECT_GT(last, 0.5);
}

}  // namespace
}  // namespace holdfast::attempts_test
