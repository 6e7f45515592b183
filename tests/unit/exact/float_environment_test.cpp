// Programs may change the rounding mode, flush denormals to zero or trap exceptions: the library computes the
// same bits, and leaves the program's settings unchanged.
#include "numbers/float_environment.h"

#include <gtest/gtest.h>

#include <cfenv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "hard_surfaces.h"
#include "holdfast/check.h"
#include "holdfast/holdfast.h"
#include "holdfast/io.h"
#include "holdfast/untangle.h"
#include "mesh/parallel.h"
#include "small_surfaces.h"

#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

namespace holdfast::float_environment_test {
namespace {

// The settings of a program, and whether they are unchanged.
struct Setting {
  std::string name;
  std::function<void()> set;
  std::function<bool()> stands;
};

std::vector<Setting> settings() {
  std::vector<Setting> out;
  for (const int rounding : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO})
    out.push_back({"rounding " + std::to_string(rounding), [=] { std::fesetround(rounding); },
                   [=] { return std::fegetround() == rounding; }});
#if defined(__x86_64__)
  constexpr unsigned kFlush = 0x8040, kDivisionTraps = 0x0200;
  out.push_back({"denormals are zero", [=] { _mm_setcsr(_mm_getcsr() | kFlush); },
                 [=] { return (_mm_getcsr() & kFlush) == kFlush; }});
  out.push_back({"division by zero traps", [=] { _mm_setcsr(_mm_getcsr() & ~(kDivisionTraps | 0x3Fu)); },
                 [=] { return (_mm_getcsr() & kDivisionTraps) == 0; }});
#endif
  return out;
}

// The test's own comparisons use the default settings.
class UsualAgain {
 public:
  UsualAgain() { std::fegetenv(&environment_); }
  ~UsualAgain() { std::fesetenv(&environment_); }
  UsualAgain(const UsualAgain&) = delete;
  UsualAgain& operator=(const UsualAgain&) = delete;

 private:
  std::fenv_t environment_{};
};

template <typename Compute>
void expect_the_same(Compute&& compute) {
  const auto usual = compute();
  for (const Setting& setting : settings()) {
    bool stands = false;
    auto found = usual;
    {
      const UsualAgain after;
      setting.set();
      found = compute();
      stands = setting.stands();
    }
    EXPECT_TRUE(stands) << setting.name;
    EXPECT_TRUE(found == usual) << setting.name;
  }
}

Surface rough_sphere(double scale) {
  hard::Random random(3);
  Surface s = hard::icosphere(2);
  for (Point& p : s.vertices)
    for (double& x : p) x *= scale * hard::uniform(random, 0.9, 1.1);
  return s;
}

std::tuple<std::vector<Point>, std::vector<Tetrahedron>, int> mesh_of(const Surface& surface,
                                                                      const Options& options) {
  Result result = mesh(surface.view(), options);
  return {std::move(result.volume.vertices), std::move(result.volume.tetrahedra),
          static_cast<int>(result.outcome)};
}

TEST(FloatEnvironment, MeshesAreTheSame) {
  Options options;
  options.flips = false;
  const Surface prism = small::surface_of(
      {{60, 0, 0}, {-30, 52, 0}, {-30, -52, 0}, {52, 30, 60}, {-52, 30, 60}, {0, -60, 60}},
      {{0, 2, 1}, {3, 4, 5}, {0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {2, 0, 3}, {2, 3, 5}});
  expect_the_same([&] { return mesh_of(prism, options); });
}

TEST(FloatEnvironment, MeshesOfDenormalCoordinatesAreTheSame) {
  const Surface tiny = rough_sphere(0x1p-1040);
  expect_the_same([&] { return mesh_of(tiny, {}); });
}

TEST(FloatEnvironment, MeshesWithFieldPointsAreTheSameOnTwoThreads) {
  const Surface surface = rough_sphere(1);
  Options options;
  options.sizes.emplace();
  options.threads = 2;
  expect_the_same([&] { return mesh_of(surface, options); });
}

TEST(FloatEnvironment, ThreadsComputeAsUsual) {
  const auto compute = [] {
    const FloatEnvironment environment;
    const Threads threads(3);
    std::vector<double> sums(64);
    parallel(threads, sums.size(), [&](std::size_t k) {
      double sum = 0;
      for (int i = 1; i < 20'000; ++i) sum += 1.0 / (i + static_cast<double>(k)) * 0x1p-1060;
      sums[k] = sum;
    });
    return sums;
  };
  expect_the_same(compute);
}

TEST(FloatEnvironment, PointsDefectsAndChecksAreTheSame) {
  const Surface surface = rough_sphere(1);
  expect_the_same([&] { return delaunay(surface.vertices, 1, 2); });
  const Result result = mesh(surface.view());
  expect_the_same([&] { return check(surface.view(), result.volume).rules.size(); });
  Surface crossing = surface;
  for (const Point& p : {Point{0, 0, -2}, Point{0.1, 0, 2}, Point{0, 0.1, 2}}) crossing.vertices.push_back(p);
  const auto n = static_cast<Index>(surface.vertices.size());
  crossing.facets.push_back({n, n + 1, n + 2});
  expect_the_same([&] {
    std::vector<std::vector<Point>> where;
    for (const Defect& defect : diagnose(crossing.view())) where.push_back(defect.where);
    return where;
  });
}

TEST(FloatEnvironment, UntangledMeshesAreTheSame) {
  const Surface surface = rough_sphere(1);
  Options options;
  options.sizes.emplace();
  options.sizes->size = 0.3;
  Volume volume = mesh(surface.view(), options).volume;
  hard::Random random(5);
  for (std::size_t v = surface.vertices.size(); v < volume.vertices.size(); ++v)
    for (double& x : volume.vertices[v]) x += hard::uniform(random, -0.2, 0.2);
  expect_the_same([&] {
    const UntangleResult result = untangle(volume);
    return std::pair(result.volume.vertices, result.volume.tetrahedra);
  });
}

TEST(FloatEnvironment, FilesAndSizesAreTheSame) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "holdfast_float_environment";
  std::filesystem::create_directories(folder);
  const std::filesystem::path path = folder / "surface.off";
  std::ofstream(path) << "OFF\n4 4 0\n0.1 1e-310 0.3\n1.7 0.123456789012345678 0\n0.2 1.1 0.7\n0.3 0.2 1.9\n"
                         "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
  expect_the_same([&] { return read_surface(path).vertices; });
  std::filesystem::remove_all(folder);
  SizeField field;
  field.vertices = {{0, 0, 0}, {1, 0.1, 0}, {0, 1, 0.3}, {0.2, 0, 1}};
  field.tetrahedra = {{0, 1, 2, 3}};
  field.metrics = {{1, 0.1, 2, 0.2, 0.1, 3}, {4, 0, 2, 0, 0, 1}, {1, 0, 1, 0, 0, 1}, {9, 1, 3, 0.5, 0, 2}};
  const auto metric = metric_function(field);
  expect_the_same([&] { return metric({0.3, 0.3, 0.3}); });
}

TEST(FloatEnvironment, IsBackAfterAnException) {
  const Surface cube = small::box();
  Options options;
  options.holes = {{std::nan(""), 0, 0}};
  for (const Setting& setting : settings()) {
    const UsualAgain after;
    setting.set();
    EXPECT_THROW(static_cast<void>(mesh(cube.view(), options)), std::invalid_argument);
    EXPECT_TRUE(setting.stands()) << setting.name;
  }
}

}  // namespace
}  // namespace holdfast::float_environment_test
