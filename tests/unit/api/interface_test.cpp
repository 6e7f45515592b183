// What applies to all calls: limits, progress, a token that another thread cancels; names; arrays;
// neighbours.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <thread>
#include <type_traits>

#include "holdfast/arrays.h"
#include "holdfast/check.h"
#include "holdfast/io.h"
#include "holdfast/names.h"
#include "io_samples.h"
#include "small_surfaces.h"

namespace holdfast::interface_test {
namespace {

using namespace std::chrono_literals;

/// The process's work on all threads: on a loaded machine, wall-clock time passes anyway.
std::chrono::milliseconds worked() {
  return std::chrono::milliseconds(static_cast<std::int64_t>(std::clock()) * 1000 / CLOCKS_PER_SEC);
}

// The owner of a view owns the surface.
template <class Owner>
concept Viewable = requires(Owner&& owner) {
  std::forward<Owner>(owner).view();
};
static_assert(Viewable<const Surface&> && !Viewable<Surface> && !Viewable<const Surface>);
static_assert(Viewable<const Arrays&> && !Viewable<Arrays>);

std::vector<Point> random_points(std::size_t count) {
  std::mt19937_64 random(7);
  std::vector<Point> points(count);
  for (Point& p : points)
    for (double& x : p) x = static_cast<double>(random() >> 11) * 0x1p-53;
  return points;
}

/// A volume so large that no call on it ends at once.
const Volume& large_volume() {
  static const Volume volume = [] {
    Volume v;
    v.vertices = random_points(150'000);
    v.tetrahedra = delaunay(v.vertices);
    v.regions.assign(v.tetrahedra.size(), 1);
    return v;
  }();
  return volume;
}

class Cancelled : public ::testing::Test {
 protected:
  /// How much work was done after the cancellation.
  template <class Work>
  std::chrono::milliseconds delay(Work&& work, std::chrono::milliseconds after = 20ms) {
    const CancelToken token;
    std::chrono::milliseconds when{};
    std::thread other([&] {
      std::this_thread::sleep_for(after);
      when = worked();
      token.cancel();
    });
    Outcome outcome = Outcome::done;
    try {
      work(token);
    } catch (const Interrupted& interrupted) {
      outcome = interrupted.outcome();
    }
    const std::chrono::milliseconds end = worked();
    other.join();
    EXPECT_EQ(outcome, Outcome::cancelled);
    return end - when;
  }

  samples::TemporaryFolder folder_;
  static constexpr auto kSoon = 500ms;  // 50 ms without sanitizers
};

TEST_F(Cancelled, Delaunay) {
  const std::vector<Point> points = random_points(600'000);
  for (const unsigned threads : {1u, 2u})
    EXPECT_LT(delay([&](const CancelToken& token) {
                DelaunayOptions options;
                options.cancel = token;
                options.threads = threads;
                static_cast<void>(delaunay(points, options));
              }),
              kSoon);
}

TEST_F(Cancelled, Check) {
  const Surface surface = small::box();
  static_cast<void>(large_volume());  // made before the time runs
  EXPECT_LT(delay([&](const CancelToken& token) {
              CheckOptions options;
              options.cancel = token;
              static_cast<void>(check(surface.view(), large_volume(), options));
            }),
            kSoon);
}

TEST_F(Cancelled, Diagnose) {
  // Triangles of random points: nearly all of them cross.
  Surface surface;
  surface.vertices = random_points(3000);
  for (Index i = 0; i + 2 < surface.vertices.size(); ++i) surface.facets.push_back({i, i + 1, i + 2});
  EXPECT_LT(delay([&](const CancelToken& token) {
              DiagnoseOptions options;
              options.cancel = token;
              static_cast<void>(diagnose(surface.view(), options));
            }),
            kSoon);
}

TEST_F(Cancelled, WritingAndReadingEveryFormat) {
  const Volume& volume = large_volume();
  for (const std::string& extension : volume_formats()) {
    if (extension == ".ele" || extension == ".face") continue;  // .node writes them all
    const std::filesystem::path path = folder_ / ("large" + extension);
    EXPECT_LT(delay(
                  [&](const CancelToken& token) {
                    WriteOptions options;
                    options.cancel = token;
                    for (;;) write_volume(path, volume, options);
                  },
                  5ms),
              kSoon)
        << extension;
    write_volume(path, volume);
    const std::vector<std::string> readable = readable_volume_formats();
    if (std::find(readable.begin(), readable.end(), extension) == readable.end()) continue;
    EXPECT_LT(delay(
                  [&](const CancelToken& token) {
                    ReadOptions options;
                    options.cancel = token;
                    for (;;) static_cast<void>(read_volume(path, options));
                  },
                  5ms),
              kSoon)
        << extension;
  }
}

TEST_F(Cancelled, AFileThatIsWrittenAnewStays) {
  const std::filesystem::path path = folder_ / "kept.mesh";
  write_bytes(path, "what was there");
  WriteOptions options;
  options.progress = [](double) { return false; };
  EXPECT_THROW(write_volume(path, large_volume(), options), Interrupted);
  std::ifstream file(path);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  EXPECT_EQ(text, "what was there");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(path.parent_path()), {}), 1);
}

TEST(LimitsOfCalls, TimeRunsOut) {
  const auto outcome_of = [](auto&& work) {
    try {
      work();
    } catch (const Interrupted& interrupted) {
      return interrupted.outcome();
    }
    return Outcome::done;
  };
  const Surface box = small::box();
  const auto limited = [](auto options) {
    options.time_limit = 1e-9;
    return options;
  };
  EXPECT_EQ(outcome_of([&] { static_cast<void>(diagnose(box.view(), limited(DiagnoseOptions{}))); }),
            Outcome::time_limit);
  EXPECT_EQ(outcome_of([&] { static_cast<void>(check(box.view(), {}, limited(CheckOptions{}))); }),
            Outcome::time_limit);
  EXPECT_EQ(outcome_of([&] { static_cast<void>(delaunay(box.vertices, limited(DelaunayOptions{}))); }),
            Outcome::time_limit);
  DiagnoseOptions negative;
  negative.time_limit = -1;
  EXPECT_THROW(static_cast<void>(diagnose(box.view(), negative)), std::invalid_argument);
}

TEST(LimitsOfCalls, ProgressReachesTheEndAndDoesNotGoBack) {
  double last = -1;
  const ProgressFunction progress = [&](double fraction) {
    EXPECT_GE(fraction, last);
    last = fraction;
    return true;
  };
  CheckOptions options;
  options.progress = progress;
  static_cast<void>(check({}, large_volume(), options));
  EXPECT_EQ(last, 1);
}

TEST(LimitsOfCalls, WhatACallbackThrowsComesOut) {
  struct Mine {};
  DelaunayOptions options;
  options.progress = [](double) -> bool { throw Mine{}; };
  EXPECT_THROW(static_cast<void>(delaunay(random_points(100), options)), Mine);
}

TEST(LimitsOfCalls, ThreadsChangeNoDefects) {
  Surface surface;
  surface.vertices = random_points(300);
  for (Index i = 0; i + 2 < surface.vertices.size(); ++i) surface.facets.push_back({i, i + 1, i + 2});
  DiagnoseOptions options;
  const std::vector<Defect> one = diagnose(surface.view(), options);
  options.threads = 3;
  const std::vector<Defect> more = diagnose(surface.view(), options);
  ASSERT_EQ(one.size(), more.size());
  EXPECT_GT(one.size(), 100u);
  for (std::size_t i = 0; i < one.size(); ++i) EXPECT_EQ(one[i].message, more[i].message);
}

template <class Enum>
void expect_names(std::size_t count) {
  EXPECT_EQ(values_of<Enum>().size(), count);
  for (const Enum value : values_of<Enum>()) {
    EXPECT_STRNE(name(value), "unknown");
    EXPECT_EQ(from_name<Enum>(name(value)), value);
  }
  EXPECT_STREQ(name(static_cast<Enum>(127)), "unknown");
  EXPECT_FALSE(from_name<Enum>("unknown"));
  EXPECT_FALSE(from_name<Enum>(""));
}

TEST(Names, OfEveryEnumerationAndBack) {
  expect_names<Outcome>(6);
  expect_names<Stage>(9);
  expect_names<Keep>(4);
  expect_names<Effort>(3);
  expect_names<WarningKind>(6);
  expect_names<RemarkKind>(6);
  expect_names<DefectKind>(16);
  expect_names<RuleKind>(15);
  expect_names<UntangleStep>(7);
  expect_names<Cause>(16);
  expect_names<PlaneMethod>(3);
  expect_names<PlaneEars>(3);
  expect_names<PlaneStage>(3);
  expect_names<Rung>(5);
  expect_names<DropReason>(4);
  expect_names<OpenReason>(3);
  expect_names<CureKind>(5);
  expect_names<RepairRuleKind>(12);
  expect_names<FitKind>(5);
  expect_names<Overlap>(4);
  expect_names<Scalar>(6);
}

TEST(Names, RulesComeInTheirOrder) {
  const CheckResult result = check({}, {});
  ASSERT_EQ(result.rules.size(), 13u);  // without those of second order
  for (std::size_t i = 0; i < result.rules.size(); ++i) {
    EXPECT_EQ(result.rules[i].kind, values_of<RuleKind>()[i]);
    EXPECT_EQ(result.rules[i].name, name(result.rules[i].kind));
  }
}

// All pairs of tetrahedra, corner sets compared.
std::vector<Neighbours> slow_neighbours(const std::vector<Tetrahedron>& tets) {
  std::map<Triangle, std::vector<std::pair<Index, std::size_t>>> sides;
  for (Index t = 0; t < tets.size(); ++t)
    for (std::size_t i = 0; i < 4; ++i) {
      Triangle face{};
      std::size_t n = 0;
      for (std::size_t k = 0; k < 4; ++k)
        if (k != i) face[n++] = tets[t][k];
      std::sort(face.begin(), face.end());
      sides[face].emplace_back(t, i);
    }
  std::vector<Neighbours> result(tets.size(), {no_entity, no_entity, no_entity, no_entity});
  for (const auto& [face, of] : sides)
    if (of.size() == 2 && of[0].first != of[1].first) {
      result[of[0].first][of[0].second] = of[1].first;
      result[of[1].first][of[1].second] = of[0].first;
    }
  return result;
}

TEST(NeighboursOf, AgreesWithASlowSearch) {
  std::vector<Tetrahedron> tets = delaunay(random_points(300));
  EXPECT_EQ(neighbours(tets), slow_neighbours(tets));
  for (Tetrahedron& t : tets)
    for (Index& v : t) v = v * 10'000'000 + 3;  // sparse numbers
  EXPECT_EQ(neighbours(tets), slow_neighbours(tets));
  std::mt19937 random(3);
  for (Tetrahedron& t : tets)
    for (Index& v : t) v = random() % 8;  // no mesh
  EXPECT_EQ(neighbours(tets), slow_neighbours(tets));
  EXPECT_TRUE(neighbours({}).empty());
}

TEST(NeighboursOf, AResultHasThemOnRequest) {
  Options options;
  EXPECT_TRUE(mesh(small::box(), options).neighbours.empty());
  options.neighbours = true;
  const Result result = mesh(small::box(), options);
  EXPECT_EQ(result.neighbours, slow_neighbours(result.volume.tetrahedra));
  EXPECT_FALSE(result.neighbours.empty());
}

TEST(ArraysOfOthers, AreTakenAsTheyLieOrConvertedOnce) {
  const Surface box = small::box();
  Arrays same;
  same.set_vertices(rows_of(box.vertices.data()->data(), box.vertices.size(), 3));
  same.set_facets(rows_of(box.facets.data()->data(), box.facets.size(), 3));
  EXPECT_EQ(same.view().vertices.data(), box.vertices.data());
  EXPECT_EQ(same.view().facets.data(), box.facets.data());

  std::vector<std::array<std::int64_t, 3>> wide;
  for (const Triangle& f : box.facets) wide.push_back({f[0], f[1], f[2]});
  std::vector<float> by_axis;  // column after column
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const Point& p : box.vertices) by_axis.push_back(static_cast<float>(p[axis]));
  Arrays other;
  const std::size_t rows = box.vertices.size();
  other.set_vertices({by_axis.data(), rows, Scalar::float32, sizeof(float),
                      static_cast<std::ptrdiff_t>(rows * sizeof(float))});
  other.set_facets(rows_of(wide.data()->data(), wide.size(), 3));
  ASSERT_EQ(other.view().vertices.size(), rows);
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_EQ(other.view().vertices[i][k], static_cast<double>(static_cast<float>(box.vertices[i][k])));
  EXPECT_TRUE(std::equal(box.facets.begin(), box.facets.end(), other.view().facets.begin()));
  EXPECT_EQ(mesh(other.view()).outcome, Outcome::done);
}

TEST(ArraysOfOthers, RefuseWhatIsNoIndex) {
  Arrays arrays;
  const std::int32_t negative[] = {0, 1, -1};
  EXPECT_THROW(arrays.set_facets(rows_of(negative, 1, 3)), std::invalid_argument);
  EXPECT_TRUE(arrays.view().facets.empty());
  const std::uint64_t wide[] = {0, 1, std::uint64_t{1} << 32};
  EXPECT_THROW(arrays.set_facets(rows_of(wide, 1, 3)), std::invalid_argument);
  const double real[] = {0, 1, 2};
  EXPECT_THROW(arrays.set_facets(rows_of(real, 1, 3)), std::invalid_argument);
  const std::int64_t far[] = {0, 1, (std::int64_t{1} << 53) + 1};
  EXPECT_THROW(arrays.set_vertices(rows_of(far, 1, 3)), std::invalid_argument);
  EXPECT_THROW(arrays.set_vertices({nullptr, 3, Scalar::float64, 24, 8}), std::invalid_argument);
  const std::int64_t markers[] = {1, -5};
  arrays.set_facet_markers(rows_of(markers, 2, 1));
  EXPECT_EQ(std::vector<int>(arrays.view().facet_markers.begin(), arrays.view().facet_markers.end()),
            (std::vector<int>{1, -5}));
}

TEST(Version, IsThatOfTheHeaders) {
  EXPECT_EQ(std::string(version()), std::to_string(HOLDFAST_VERSION_MAJOR) + "." +
                                        std::to_string(HOLDFAST_VERSION_MINOR) + "." +
                                        std::to_string(HOLDFAST_VERSION_PATCH));
  static_assert(HOLDFAST_VERSION_NUMBER >= 2000);
}

}  // namespace
}  // namespace holdfast::interface_test
