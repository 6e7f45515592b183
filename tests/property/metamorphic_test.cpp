// Maps that must not change the outcome: scaling by a power of two, permuted axes, reflections (with facets
// reversed), exact translations; of meshes with and without field points, and of untangling.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "hard_surfaces.h"
#include "holdfast/check.h"
#include "holdfast/holdfast.h"
#include "holdfast/untangle.h"
#include "number_range_surfaces.h"
#include "small_surfaces.h"

namespace holdfast::metamorphic_test {
namespace {

// x becomes scale * x with its axes permuted and some reflected, then moved.
struct Map {
  std::string name;
  int exponent = 0;
  std::array<std::size_t, 3> axes{0, 1, 2};
  std::array<double, 3> sign{1, 1, 1};
  Point by{};

  [[nodiscard]] bool turns() const {
    const bool odd = ((axes[0] > axes[1]) != (axes[0] > axes[2])) != (axes[1] > axes[2]);
    return odd != (sign[0] * sign[1] * sign[2] < 0);
  }
  [[nodiscard]] Point operator()(const Point& p) const {
    Point out{};
    for (std::size_t k = 0; k < 3; ++k) out[k] = std::ldexp(sign[k] * p[axes[k]] + by[k], exponent);
    return out;
  }
  [[nodiscard]] Surface operator()(Surface s) const {
    for (Point& p : s.vertices) p = (*this)(p);
    if (turns())
      for (Triangle& f : s.facets) std::swap(f[1], f[2]);
    return s;
  }
  [[nodiscard]] Volume operator()(Volume v) const {
    for (Point& p : v.vertices) p = (*this)(p);
    if (turns()) {
      for (Triangle& f : v.facets) std::swap(f[1], f[2]);
      for (Tetrahedron& t : v.tetrahedra) std::swap(t[2], t[3]);
    }
    return v;
  }
};

std::vector<Map> scalings() {
  std::vector<Map> out;
  for (const int k : {-1000, -800, -300, -64, 63, 300, 700, 1000})
    out.push_back({.name = "2^" + std::to_string(k), .exponent = k});
  return out;
}
std::vector<Map> motions() {
  return {{.name = "yzx", .axes = {1, 2, 0}},
          {.name = "yxz", .axes = {1, 0, 2}},
          {.name = "-x", .sign = {-1, 1, 1}},
          {.name = "-x -y -z", .sign = {-1, -1, -1}},
          {.name = "moved", .by = {1048576, -4194304, 1048576}},
          {.name = "all", .exponent = -900, .axes = {2, 0, 1}, .sign = {1, -1, 1}, .by = {-64, 1024, 3}}};
}

// Coordinates are multiples of 2^-16 below 2, the largest at least 1.
std::vector<Surface> surfaces() {
  hard::Random random(5);
  std::vector<Surface> out{small::nested(false), number_range::cube(4), hard::chazelle(1),
                           hard::twisted_prism(random), hard::sheet_over_floor(random)};
  for (Surface& s : out) {
    const int exponent = -std::ilogb(number_range::extent(s));
    for (Point& p : s.vertices)
      for (double& x : p) x = std::ldexp(std::round(std::ldexp(x, exponent + 16)), -16);
  }
  return out;
}

std::string broken_rules(const Surface& surface, const Volume& volume) {
  std::string text;
  for (const Rule& rule : check(surface.view(), volume).rules)
    if (!rule.holds) text += rule.name + ": " + rule.detail + "; ";
  return text;
}

Volume meshed(const Surface& surface, double size, const std::string& name) {
  Options options;
  if (size > 0) options.sizes = Sizes{.size = size};
  const Result result = mesh(surface.view(), options);
  EXPECT_EQ(result.outcome, Outcome::done) << name << ": " << result.message;
  EXPECT_EQ(broken_rules(surface, result.volume), "") << name;
  return result.volume;
}

constexpr double kSize = 0.2;

// The mesher works on the same numbers, so the mesh is the same, bit for bit.
TEST(Metamorphic, ScalingByPowersOfTwoScalesTheMesh) {
  for (const double size : {0.0, kSize}) {
    std::size_t number = 0;
    for (const Surface& surface : surfaces()) {
      const std::string what = " of surface " + std::to_string(number++) + ", size " + std::to_string(size);
      const Volume plain = meshed(surface, size, "plain" + what);
      if (size > 0) {
        EXPECT_GT(plain.vertices.size(), meshed(surface, 0, "plain" + what).vertices.size()) << what;
      }
      for (const Map& map : scalings()) {
        const Volume found = meshed(map(surface), std::ldexp(size, map.exponent), map.name + what);
        EXPECT_EQ(found.tetrahedra, plain.tetrahedra) << map.name << what;
        EXPECT_EQ(found.vertices, map(plain).vertices) << map.name << what;
      }
    }
  }
}

TEST(Metamorphic, MotionsKeepTheOutcome) {
  for (const double size : {0.0, kSize}) {
    std::size_t number = 0;
    for (const Surface& surface : surfaces())
      for (const Map& map : motions())
        meshed(map(surface), std::ldexp(size, map.exponent),
               map.name + " of surface " + std::to_string(number++) + ", size " + std::to_string(size));
  }
}

// A few doubles across.
TEST(Metamorphic, FieldPointsAmongTheDenormals) {
  Surface s = small::box({0, 0, 0}, {256, 256, 256});
  const Map map{.name = "least", .exponent = -1074};
  const Volume found = meshed(map(s), std::ldexp(64.0, -1074), "box of 256 least doubles");
  EXPECT_GT(found.vertices.size(), 20u);
}

// Two components whose sizes differ so much that no scale suits both: each has its field points.
TEST(Metamorphic, FieldPointsInComponentsOfDifferentSize) {
  const Surface small_part = surfaces()[0], large_part = small::box({-6, -6, -6}, {-4, -4, -4});
  for (const auto& [low, high] : {std::pair{0, 400}, {0, 1000}, {-500, 500}, {-1000, 0}, {-1020, 1018}}) {
    Surface both = Map{.name = "low", .exponent = low}(small_part);
    number_range::append(both, Map{.name = "high", .exponent = high}(large_part));
    Options options;
    options.sizes = Sizes{.size = std::ldexp(0.7, high), .vertex_sizes = {}};
    options.sizes->vertex_sizes.assign(both.vertices.size(), 0);
    for (std::size_t v = 0; v < small_part.vertices.size(); ++v)
      options.sizes->vertex_sizes[v] = std::ldexp(0.2, low);
    const Result result = mesh(both.view(), options);
    ASSERT_EQ(result.outcome, Outcome::done) << low << ": " << result.message;
    EXPECT_EQ(broken_rules(both, result.volume), "") << low;
    std::size_t in_small = 0, in_large = 0;
    for (std::size_t v = both.vertices.size(); v < result.volume.vertices.size(); ++v)
      ++(std::abs(result.volume.vertices[v][0]) < std::ldexp(4, low) ? in_small : in_large);
    EXPECT_GT(in_small, 10u) << low;
    EXPECT_GT(in_large, 5u) << low;
    EXPECT_EQ(result.report.steiner_points, in_small + in_large) << low;
    EXPECT_EQ(result.volume.regions.size(), result.volume.tetrahedra.size());
  }
}

// Moves inner vertices astray, half of them far.
Volume tangled(const Surface& surface) {
  Volume volume = meshed(surface, kSize, "to be tangled");
  std::mt19937_64 random(7);
  for (std::size_t v = surface.vertices.size(); v < volume.vertices.size(); ++v)
    for (double& x : volume.vertices[v])
      x += static_cast<double>(number_range::between(random, -(1 << 12), 1 << 12)) * 0x1p-13;
  return volume;
}

TEST(Metamorphic, Untangling) {
  for (const std::size_t number : {0u, 3u}) {
    const Surface surface = surfaces()[number];
    const Volume volume = tangled(surface);
    for (const bool refill : {false, true}) {
      UntangleOptions options;
      options.refill = refill;
      const UntangleResult plain = untangle(volume, options);
      ASSERT_EQ(plain.outcome, Outcome::done) << number << ": " << plain.message;
      EXPECT_GT(plain.report.negative, 0u);
      for (const Map& map : scalings()) {
        const UntangleResult found = untangle(map(volume), options);
        ASSERT_EQ(found.outcome, Outcome::done) << map.name << ": " << found.message;
        EXPECT_EQ(found.volume.tetrahedra, plain.volume.tetrahedra) << map.name;
        EXPECT_EQ(found.volume.vertices, map(plain.volume).vertices) << map.name;
      }
      for (const Map& map : motions()) {
        const UntangleResult found = untangle(map(volume));
        EXPECT_EQ(found.outcome, Outcome::done) << map.name << ": " << found.message;
        EXPECT_EQ(broken_rules(map(surface), found.volume), "") << map.name;
      }
    }
  }
}

TEST(Metamorphic, UntanglingAmongTheDenormals) {
  Surface s = small::box({0, 0, 0}, {4096, 4096, 4096});
  Volume volume = meshed(s, 1500, "box");
  std::mt19937_64 random(8);
  for (std::size_t v = s.vertices.size(); v < volume.vertices.size(); ++v)
    for (double& x : volume.vertices[v])
      x = std::round(x) + static_cast<double>(number_range::between(random, -900, 900));
  const Map map{.name = "least", .exponent = -1074};
  const UntangleResult found = untangle(map(volume));
  ASSERT_EQ(found.outcome, Outcome::done) << found.message;
  EXPECT_GT(found.report.negative, 0u);
  EXPECT_EQ(broken_rules(map(s), found.volume), "");
}

}  // namespace
}  // namespace holdfast::metamorphic_test
