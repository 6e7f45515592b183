// Time per call of the exact predicates, by tier, to measure changes to src/exact.
//
//   ninja exact_predicates_bench && ./exact_predicates_bench
#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "exact/predicates.h"
#include "exact/tiers.h"

namespace {

using namespace holdfast::exact;

using Five = std::array<std::array<double, 3>, 5>;
constexpr std::size_t kCases = 4096;  // more than branch predictors remember

template <class Coordinate>
std::vector<Five> cases(Coordinate coordinate) {
  std::mt19937_64 random(1);
  std::vector<Five> result(kCases);
  for (Five& five : result) {
    for (auto& p : five) coordinate(random, p);
  }
  return result;
}

double uniform(std::mt19937_64& random) { return std::uniform_real_distribution<double>(0, 1)(random); }

std::vector<Five> random_points() {
  return cases([](auto& random, auto& p) {
    for (double& x : p) x = uniform(random);
  });
}

std::vector<Five> coplanar_points() {
  return cases([](auto& random, auto& p) { p = {uniform(random), uniform(random), 0.25}; });
}

std::vector<Five> cube_corners() {
  return cases([](auto& random, auto& p) {
    for (double& x : p) x = 1000 + static_cast<double>(random() % 2);
  });
}

std::vector<Five> rounded_sphere() {
  return cases([](auto& random, auto& p) {
    const double angle = 6.28 * uniform(random), z = 2 * uniform(random) - 1, r = std::sqrt(1 - z * z);
    p = {r * std::cos(angle), r * std::sin(angle), z};
  });
}

void orient3d_of(benchmark::State& state, const std::vector<Five>& points) {
  std::size_t i = 0;
  for (auto _ : state) {
    const Five& p = points[i++ % kCases];
    benchmark::DoNotOptimize(orient3d(p[0].data(), p[1].data(), p[2].data(), p[3].data()));
  }
}

void insphere_of(benchmark::State& state, const std::vector<Five>& points) {
  std::size_t i = 0;
  for (auto _ : state) {
    const Five& p = points[i++ % kCases];
    benchmark::DoNotOptimize(insphere(p[0].data(), p[1].data(), p[2].data(), p[3].data(), p[4].data()));
  }
}

/// Exact points on random segments, at parameters of `bits` bits.
struct ExactPoints {
  std::vector<ExactPoint> exact{4 * kCases};
  std::vector<std::array<double, 3>> approx{4 * kCases};

  explicit ExactPoints(int bits) {
    std::mt19937_64 random(2);
    for (std::size_t k = 0; k < exact.size(); ++k) {
      Dyadic t;
      for (int done = 0; done < bits; done += 40) {
        t += Dyadic(static_cast<double>(random() >> 24 | 1)).scaled(-done - std::min(40, bits - done));
      }
      for (std::size_t i = 0; i < 3; ++i) {
        const Dyadic a(uniform(random)), b(uniform(random));
        exact[k].c[i] = a + t * (b - a);
        approx[k][i] = exact[k].c[i].to_double();
      }
    }
  }
  [[nodiscard]] PointRef ref(std::size_t k) const { return {approx[k].data(), &exact[k]}; }
};

void exact_points(benchmark::State& state, bool with_filter) {
  const ExactPoints points(static_cast<int>(state.range(0)));
  std::size_t i = 0;
  for (auto _ : state) {
    const std::size_t k = 4 * (i++ % kCases);
    const PointRef a = points.ref(k), b = points.ref(k + 1), c = points.ref(k + 2), d = points.ref(k + 3);
    benchmark::DoNotOptimize(with_filter ? orient3d(a, b, c, d) : detail::decide_orient3d(a, b, c, d).sign);
  }
}

void difference_of_exact_points(benchmark::State& state) {
  const ExactPoints points(41);
  std::size_t i = 0;
  double out[3];
  for (auto _ : state) {
    const std::size_t k = 4 * (i++ % kCases);
    difference(points.ref(k), points.ref(k + 1), out);
    benchmark::DoNotOptimize(out[0]);
  }
}

BENCHMARK_CAPTURE(orient3d_of, random, random_points());
BENCHMARK_CAPTURE(orient3d_of, coplanar, coplanar_points());
BENCHMARK_CAPTURE(insphere_of, random, random_points());
BENCHMARK_CAPTURE(insphere_of, cube_corners, cube_corners());
BENCHMARK_CAPTURE(insphere_of, rounded_sphere, rounded_sphere());
BENCHMARK_CAPTURE(exact_points, filtered, true)->Arg(41);
BENCHMARK_CAPTURE(exact_points, exact_tiers, false)->Arg(41)->Arg(106)->Arg(180)->Arg(400);
BENCHMARK(difference_of_exact_points);

}  // namespace

BENCHMARK_MAIN();
