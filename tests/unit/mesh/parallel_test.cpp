#include "mesh/parallel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace holdfast::parallel_test {
namespace {

std::set<std::thread::id> threads_of(const Threads& threads, std::size_t tasks) {
  std::mutex mutex;
  std::set<std::thread::id> ids;
  // Each waits until as many run as can, so that none does the work of others.
  const std::size_t most = std::min<std::size_t>(threads.count(), tasks);
  std::atomic<std::size_t> running = 0;
  parallel(threads, tasks, [&](std::size_t) {
    ++running;
    while (running < most) std::this_thread::yield();
    const std::scoped_lock lock(mutex);
    ids.insert(std::this_thread::get_id());
  });
  return ids;
}

TEST(Threads, ZeroIsAllThatTheMachineHas) {
  EXPECT_EQ(Threads(0).count(), std::max(1u, std::thread::hardware_concurrency()));
  EXPECT_EQ(Threads(3).count(), 3);
}

TEST(Threads, SomeOfThemAreAtLeastOneAndAtMostAll) {
  EXPECT_EQ(Threads(4).at_most(2).count(), 2);
  EXPECT_EQ(Threads(4).at_most(9).count(), 4);
  EXPECT_EQ(Threads(4).at_most(0).count(), 1);
}

TEST(Threads, StayForTheNextWork) {
  const Threads threads(3);
  std::set<std::thread::id> all;
  for (int k = 0; k < 20; ++k) all.merge(threads_of(threads, 3));
  EXPECT_EQ(all.size(), 3);
}

TEST(Parallel, RunsEachTaskOnceOnAnyNumberOfThreads) {
  for (const unsigned count : {1u, 2u, 3u, 8u})
    for (const std::size_t tasks : {0, 1, 2, 7, 1000}) {
      std::vector<int> runs(tasks, 0);
      parallel(count, tasks, [&](std::size_t k) { ++runs[k]; });
      EXPECT_EQ(runs, std::vector<int>(tasks, 1));
    }
}

TEST(Parallel, UsesNoMoreThreadsThanAllowed) {
  const Threads threads(4);
  EXPECT_EQ(threads_of(threads, 4).size(), 4);
  EXPECT_EQ(threads_of(threads.at_most(2), 20).size(), 2);
  EXPECT_EQ(threads_of(threads.at_most(1), 20), std::set{std::this_thread::get_id()});
}

TEST(Parallel, RunsTheFirstTaskOnTheCallingThread) {
  const Threads threads(4);
  for (int k = 0; k < 100; ++k) {
    std::thread::id first;
    parallel(threads, 4, [&](std::size_t task) {
      if (task == 0) first = std::this_thread::get_id();
    });
    EXPECT_EQ(first, std::this_thread::get_id());
  }
}

TEST(Parallel, TasksMayCallItAgain) {
  const Threads threads(3);
  std::atomic<int> sum = 0;
  for (int k = 0; k < 50; ++k)
    parallel(threads, 5, [&](std::size_t) {
      parallel(threads, 4, [&](std::size_t) { parallel(threads, 2, [&](std::size_t) { ++sum; }); });
    });
  EXPECT_EQ(sum, 50 * 5 * 4 * 2);
}

TEST(Parallel, SeveralThreadsMayCallItAtTheSameTime) {
  const Threads threads(3);
  std::atomic<int> sum = 0;
  {
    std::vector<std::jthread> callers;
    for (int caller = 0; caller < 4; ++caller)
      callers.emplace_back([&] {
        for (int k = 0; k < 100; ++k) parallel(threads, 6, [&](std::size_t) { ++sum; });
      });
  }
  EXPECT_EQ(sum, 4 * 100 * 6);
}

TEST(Parallel, PassesOnTheFirstTasksErrorAfterAllHaveRun) {
  const Threads threads(3);
  for (int k = 0; k < 20; ++k) {
    std::atomic<int> runs = 0;
    try {
      parallel(threads, 9, [&](std::size_t task) {
        ++runs;
        if (task >= 4) throw std::runtime_error(std::to_string(task));
      });
      FAIL() << "no error";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "4");
    }
    EXPECT_EQ(runs, 9);
  }
}

TEST(Parallel, RangesCoverAllOnceAndAreNotTiny) {
  for (const std::size_t size : {0, 1, 4095, 8192, 100'001}) {
    std::mutex mutex;
    std::vector<int> seen(size, 0);
    std::size_t ranges = 0;
    parallel_ranges(5, size, [&](std::size_t first, std::size_t last) {
      const std::scoped_lock lock(mutex);
      ++ranges;
      for (std::size_t k = first; k < last; ++k) ++seen[k];
    });
    EXPECT_EQ(seen, std::vector<int>(size, 1));
    EXPECT_LE(ranges, std::max<std::size_t>(1, size / 4096));
  }
}

}  // namespace
}  // namespace holdfast::parallel_test
