// Time of the Delaunay triangulation, of its insertion order and of the validation of a surface.
#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "delaunay/order.h"
#include "holdfast/holdfast.h"
#include "surface/diagnose.h"

namespace holdfast {
namespace {

std::vector<Point> random_points(std::int64_t count) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Point> points(static_cast<std::size_t>(count));
  for (Point& p : points) p = {unit(random), unit(random), unit(random)};
  return points;
}

std::vector<Point> grid_points(std::int64_t count) {
  const auto side = static_cast<int>(std::cbrt(static_cast<double>(count)));
  std::vector<Point> points;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j)
      for (int k = 0; k < side; ++k)
        points.push_back({static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)});
  return points;
}

// A torus with ripples of about `count` triangles.
Surface torus(std::int64_t count) {
  const auto rows = static_cast<Index>(2 * std::sqrt(static_cast<double>(count) / 4) / 2) * 2,
             columns = rows / 2;
  Surface s;
  for (Index i = 0; i < rows; ++i)
    for (Index j = 0; j < columns; ++j) {
      const double u = 2 * std::numbers::pi * i / rows, v = 2 * std::numbers::pi * j / columns;
      const double r = 1 + 0.05 * std::sin(9 * u) * std::cos(7 * v);
      s.vertices.push_back(
          {(3 + r * std::cos(v)) * std::cos(u), (3 + r * std::cos(v)) * std::sin(u), r * std::sin(v)});
      const Index a = i * columns + j, b = i * columns + (j + 1) % columns;
      const Index c = (i + 1) % rows * columns + j, d = (i + 1) % rows * columns + (j + 1) % columns;
      s.facets.push_back({a, b, d});
      s.facets.push_back({a, d, c});
    }
  return s;
}

void delaunay_of(benchmark::State& state, std::vector<Point> (*make)(std::int64_t)) {
  const std::vector<Point> points = make(state.range(0));
  std::size_t tets = 0;
  for (auto _ : state) tets = delaunay(points, 1, static_cast<unsigned>(state.range(1))).size();
  state.counters["tetrahedra"] = static_cast<double>(tets);
  state.counters["a_tetrahedron"] = benchmark::Counter(
      static_cast<double>(tets), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void order_of_insertion(benchmark::State& state) {
  const std::vector<Point> points = random_points(state.range(0));
  for (auto _ : state)
    benchmark::DoNotOptimize(insertion_order(points, 1, static_cast<unsigned>(state.range(1))).points.data());
}

void validation(benchmark::State& state) {
  const Surface surface = torus(state.range(0));
  for (auto _ : state)
    benchmark::DoNotOptimize(find_defects(
                                 surface.view(), 1, [](double) {}, static_cast<unsigned>(state.range(1)))
                                 .size());
}

const std::vector<std::vector<std::int64_t>> kSizesAndThreads{{1000, 10000, 100000, 1000000}, {1, 2}};

BENCHMARK_CAPTURE(delaunay_of, random, random_points)
    ->ArgsProduct(kSizesAndThreads)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(delaunay_of, grid, grid_points)
    ->ArgsProduct(kSizesAndThreads)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(order_of_insertion)->ArgsProduct(kSizesAndThreads)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(validation)->ArgsProduct(kSizesAndThreads)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace holdfast

BENCHMARK_MAIN();
