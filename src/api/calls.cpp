// The public functions that run no stages: limits and threads around the work of the lower layers.
#include <algorithm>
#include <cmath>
#include <new>
#include <stdexcept>
#include <string>

#include "check/examine.h"
#include "delaunay/delaunay.h"
#include "holdfast/check.h"
#include "holdfast/holdfast.h"
#include "mesh/parallel.h"
#include "mesh/plain_monitor.h"
#include "numbers/float_environment.h"
#include "surface/diagnose.h"

namespace holdfast {
namespace {

// If memory runs out under a limit, the limit counts as reached.
template <class Work>
auto within(const Limits& limits, Work&& work) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    if (limits.memory_limit == 0) throw;
    throw Interrupted(Outcome::memory_limit);
  }
}

void require_finite(std::span<const Point> points) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point& p = points[i];
    if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2]))
      throw std::invalid_argument("point " + std::to_string(i) + " is not finite");
  }
}

}  // namespace

std::vector<Defect> diagnose(const Complex& complex, const DiagnoseOptions& options) {
  const FloatEnvironment environment;
  return within(options, [&] {
    PlainMonitor monitor(options, options.progress);
    monitor.tell(0);
    const Threads threads = Threads(options.threads).polling([&] { monitor.poll_again(); });
    std::vector<Defect> defects = find_defects(
        complex, options.most, [&](double fraction) { monitor.poll(fraction); }, threads);
    monitor.tell(1);
    return defects;
  });
}

std::vector<Defect> diagnose(const Complex& complex, std::size_t most) {
  DiagnoseOptions options;
  options.most = most;
  return diagnose(complex, options);
}

CheckResult check(const Complex& surface, const Volume& volume, const CheckOptions& options) {
  const FloatEnvironment environment;
  return within(options, [&] {
    PlainMonitor monitor(options, options.progress);
    monitor.tell(0);
    CheckResult result =
        checking::examine(surface, volume, options, [&](double share) { monitor.poll(share); });
    monitor.tell(1);
    return result;
  });
}

std::vector<Tetrahedron> delaunay(std::span<const Point> points, const DelaunayOptions& options) {
  const FloatEnvironment environment;
  require_finite(points);
  return within(options, [&] {
    PlainMonitor monitor(options, options.progress);
    monitor.tell(0);
    const Threads threads = Threads(options.threads).polling([&] { monitor.poll_again(); });
    std::vector<Tetrahedron> tets =
        delaunay_of(points, options.seed, threads, [&](double fraction) { monitor.poll(fraction); });
    monitor.tell(1);
    return tets;
  });
}

std::vector<Tetrahedron> delaunay(std::span<const Point> points, std::uint64_t seed, unsigned threads) {
  DelaunayOptions options;
  options.seed = seed;
  options.threads = threads;
  return delaunay(points, options);
}

}  // namespace holdfast
