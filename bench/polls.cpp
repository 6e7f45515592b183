// The longest times between two looks at the limits while a surface is meshed, in CPU time of the calling
// thread, and where the program was then:
//   polls SURFACE [--fill]      (addr2line -Cfe polls ADDRESS... names the addresses)
#include <execinfo.h>
#include <pthread.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <thread>
#include <vector>

#include "holdfast/holdfast.h"
#include "holdfast/io.h"

namespace {

constexpr double kLong = 0.05;  // in seconds, the promise of Limits

struct Gap {
  double seconds;
  holdfast::Stage stage;  // at its end
  double fraction;
  std::vector<void*> where;
};

std::array<void*, 24> frames;  // of the last signal
volatile std::sig_atomic_t frame_count = 0;
std::atomic<double> last_look = 0;

double cpu_time(clockid_t clock) {
  std::timespec now{};
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Asks the calling thread where it is if it has not checked the limits for longer than promised.
void watch(pthread_t caller, const std::atomic<bool>& done) {
  clockid_t clock{};
  pthread_getcpuclockid(caller, &clock);
  for (double asked = 0; !done; std::this_thread::sleep_for(std::chrono::milliseconds(10))) {
    const double last = last_look;
    if (last == asked || cpu_time(clock) - last < kLong) continue;
    asked = last;
    pthread_kill(caller, SIGUSR1);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  const holdfast::Surface surface = holdfast::read_surface(argv[1]);
  holdfast::Options options;
  if (argc == 2 || std::strcmp(argv[2], "--fill") != 0) options.sizes.emplace();
  std::vector<Gap> gaps;
  std::signal(SIGUSR1, [](int) { frame_count = backtrace(frames.data(), frames.size()); });
  last_look = cpu_time(CLOCK_THREAD_CPUTIME_ID);
  options.progress = [&](const holdfast::Progress& progress) {
    const double now = cpu_time(CLOCK_THREAD_CPUTIME_ID);
    if (const double gap = now - last_look; gap > kLong)
      gaps.push_back({gap, progress.stage, progress.fraction,
                      std::vector<void*>(frames.begin(), frames.begin() + frame_count)});
    frame_count = 0;
    last_look = now;
    return true;
  };
  std::atomic<bool> done = false;
  std::thread watcher(watch, pthread_self(), std::cref(done));
  const holdfast::Result result = holdfast::mesh(surface.view(), options);
  const double rest = cpu_time(CLOCK_THREAD_CPUTIME_ID) - last_look;
  if (rest > kLong)
    gaps.push_back({rest, holdfast::Stage::optimise, 1,
                    std::vector<void*>(frames.begin(), frames.begin() + frame_count)});
  done = true;
  watcher.join();
  std::printf("%zu tetrahedra, %.0f s of CPU, %zu gaps above %.0f ms; after the last look %.3f s\n",
              result.volume.tetrahedra.size(), cpu_time(CLOCK_THREAD_CPUTIME_ID), gaps.size(), 1e3 * kLong,
              rest);
  std::sort(gaps.begin(), gaps.end(), [](const Gap& a, const Gap& b) { return a.seconds > b.seconds; });
  for (std::size_t i = 0; i < std::min<std::size_t>(gaps.size(), 15); ++i) {
    std::printf("%.3f s before %s %.3f\n", gaps[i].seconds, holdfast::name(gaps[i].stage), gaps[i].fraction);
    std::fflush(stdout);
    backtrace_symbols_fd(gaps[i].where.data(), static_cast<int>(gaps[i].where.size()), STDOUT_FILENO);
  }
  return 0;
}
