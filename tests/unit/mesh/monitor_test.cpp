// How often a call polls its caller, and how it measures memory.
#include "mesh/monitor.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <ctime>
#include <fstream>
#include <string>
#include <thread>

#include "holdfast/memory.h"
#include "mesh/memory.h"
#include "small_surfaces.h"
#include "torus.h"

namespace holdfast::monitor_test {
namespace {

double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// The caller's own function may be slow, too.
TEST(Monitor, PollsWhileSizesAreComputed) {
  const Surface surface = torus(30, 20);
  std::size_t calls = 0, most = 0;
  Options options;
  options.sizes = Sizes{};
  options.sizes->field = [&](const Point&) {
    ++calls;
    const double until = cpu_seconds() + 1e-4;
    while (cpu_seconds() < until) {
    }
    return 0.0;
  };
  options.progress = [&](const Progress& progress) {
    most = std::max(most, std::exchange(calls, 0));
    return progress.stage != Stage::optimise;
  };
  EXPECT_EQ(mesh(surface.view(), options).outcome, Outcome::cancelled);
  EXPECT_GT(most, 0u);
  EXPECT_LE(most, 1000u);  // they take a tenth of a second
}

TEST(Monitor, PassesOnTheCallersException) {
  Options options;
  options.progress = [](const Progress&) -> bool { throw std::runtime_error("enough"); };
  Monitor monitor(options);
  EXPECT_THROW(monitor.enter(Stage::flips), std::runtime_error);
  EXPECT_TRUE(monitor.caller_threw());
}

TEST(Memory, IsUnknownIfTheSystemDoesNotReportIt) {
  EXPECT_GT(resident_memory_bytes().value_or(0), 1'000'000u);
  EXPECT_FALSE(resident_memory_bytes("/nowhere/statm"));
  EXPECT_FALSE(resident_memory_bytes("/dev/null"));
}

// A file with `text`, as the system has for a container.
std::string group_file(const char* text) {
  const std::string path = ::testing::TempDir() + "memory.max";
  std::ofstream(path) << text << '\n';
  return path;
}

TEST(Memory, IsThatOfTheMachineOrOfItsContainer) {
  const std::uint64_t all = machine_memory_bytes("/nowhere/memory.max").value();
  EXPECT_GT(all, resident_memory_bytes().value());
  EXPECT_EQ(machine_memory_bytes(group_file("max").c_str()), all);
  EXPECT_EQ(machine_memory_bytes(group_file("100000000").c_str()), 100'000'000u);
  EXPECT_EQ(machine_memory_bytes(group_file("9000000000000000000").c_str()), all);
}

TEST(Memory, TheUsualLimitIsMostOfIt) {
  const std::uint64_t all = machine_memory_bytes().value();
  EXPECT_LT(usual_memory_limit(), all);
  EXPECT_GE(usual_memory_limit(), all / 10 * 9);
}

TEST(Limits, BeginAtTheGivenTime) {
  const Surface box = small::box();
  Options options;
  options.time_limit = 3600;
  EXPECT_EQ(mesh(box.view(), options).outcome, Outcome::done);
  options.started = std::chrono::steady_clock::now() - std::chrono::hours(2);
  const Result result = mesh(box.view(), options);
  EXPECT_EQ(result.outcome, Outcome::time_limit);
  EXPECT_NE(result.message.find("of 3600 s"), std::string::npos) << result.message;
}

TEST(Threads, CallBetweenTasks) {
  for (const unsigned count : {1u, 3u}) {
    std::size_t called = 0;
    const Threads threads = Threads(count).polling([&] { ++called; });
    std::atomic<std::size_t> sum = 0;
    parallel_ranges(threads, 1'000'000, [&](std::size_t first, std::size_t last) { sum += last - first; });
    EXPECT_EQ(sum, 1'000'000u);
    EXPECT_GT(called, 0u);
  }
}

TEST(Threads, AnExceptionBetweenTasksEndsThem) {
  for (const unsigned count : {1u, 3u}) {
    std::atomic<std::size_t> done = 0;
    const Threads threads = Threads(count).polling([&] { throw Interrupted(Outcome::cancelled); });
    // Tasks on other threads take so long that the calling thread also gets some.
    const auto task = [&](std::size_t k) {
      if (k != 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
      ++done;
    };
    EXPECT_THROW(parallel(threads, 1'000'000, task), Interrupted);
    EXPECT_LT(done, 1'000'000u);
  }
}

}  // namespace
}  // namespace holdfast::monitor_test
