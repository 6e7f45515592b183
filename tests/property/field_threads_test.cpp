// Field points and the improvement of the volume: the same mesh, bit for bit, for any number of threads.
#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <ostream>
#include <string>
#include <thread>

#include "dangling_surfaces.h"
#include "hard_surfaces.h"
#include "holdfast/check.h"
#include "holdfast/holdfast.h"

namespace holdfast::field_threads_test {
namespace {

struct Family {
  const char* name;
  std::function<Surface(hard::Random&)> make;
  double size;
  Keep keep = Keep::automatic;
};

std::ostream& operator<<(std::ostream& out, const Family& family) { return out << family.name; }

// Sizes for which the mesh is cut into two to eight parts.
const Family kFamilies[] = {
    {"sphere", [](hard::Random&) { return hard::icosphere(5); }, 0.045},
    {"nested_spheres", hard::nested_spheres, 0.045},
    {"stars", hard::star, 0.012},
    {"furnished", hard::furnished, 0.045, Keep::box},
    {"lattices", hard::lattice, 0.03, Keep::bounded},
};

class FieldThreads : public ::testing::TestWithParam<Family> {};

TEST_P(FieldThreads, MakeNoDifference) {
  const Family& family = GetParam();
  hard::Random random(1);
  const Surface surface = family.make(random);
  Options options;
  options.keep = family.keep;
  options.sizes = Sizes{.size = family.size};
  options.effort = Effort::fast;
  const Result one = mesh(surface.view(), options);
  ASSERT_EQ(one.outcome, Outcome::done) << one.message;
  EXPECT_GT(one.volume.tetrahedra.size(), 60'000u);
  CheckOptions check_options;
  check_options.box = family.keep == Keep::box;
  for (const Rule& rule : check(surface.view(), one.volume, check_options).rules)
    EXPECT_TRUE(rule.holds) << rule.name << ": " << rule.detail;
  for (const unsigned threads : {2u, 3u}) {
    options.threads = threads;
    const Result more = mesh(surface.view(), options);
    ASSERT_EQ(more.outcome, Outcome::done) << more.message;
    EXPECT_EQ(more.volume.vertices, one.volume.vertices);
    EXPECT_EQ(more.volume.tetrahedra, one.volume.tetrahedra);
    EXPECT_EQ(more.volume.regions, one.volume.regions);
    EXPECT_EQ(more.report.field.after.least_dihedral, one.report.field.after.least_dihedral);
    EXPECT_EQ(more.report.field.after.min_dihedral_deg, one.report.field.after.min_dihedral_deg);
    EXPECT_EQ(more.report.field.before.least_dihedral, one.report.field.before.least_dihedral);
    EXPECT_EQ(more.report.field.edge_lengths, one.report.field.edge_lengths);
    EXPECT_EQ(more.report.elements.histogram, one.report.elements.histogram);
  }
}

INSTANTIATE_TEST_SUITE_P(Families, FieldThreads, ::testing::ValuesIn(kFamilies),
                         [](const auto& info) { return std::string(info.param.name); });

Options two_threads(double size) {
  Options options;
  options.sizes = Sizes{.size = size};
  options.threads = 2;
  return options;
}

TEST(FieldThreadsMonitor, CallsBackOnTheCallersThreadAloneAndHearsItThere) {
  const Surface sphere = hard::icosphere(4);
  for (const Stage until : {Stage::field_points, Stage::optimise}) {
    Options options = two_threads(0.03);
    const std::thread::id caller = std::this_thread::get_id();
    std::atomic<int> calls = 0, elsewhere = 0;
    options.progress = [&](const Progress& progress) {
      if (std::this_thread::get_id() != caller) ++elsewhere;
      EXPECT_GE(progress.fraction, 0);
      EXPECT_LE(progress.fraction, 1);
      return progress.stage != until || ++calls < 2;
    };
    EXPECT_EQ(mesh(sphere.view(), options).outcome, Outcome::cancelled);
    EXPECT_EQ(calls, 2);
    EXPECT_EQ(elsewhere, 0);
  }
}

// Parts that are joined before the end.
TEST(FieldThreadsStop, AfterFieldPointsMakesNoDifference) {
  const Surface sphere = hard::icosphere(4);
  Options options = two_threads(0.045);
  options.stop_after = Stage::field_points;
  const Result two = mesh(sphere.view(), options);
  options.threads = 1;
  const Result one = mesh(sphere.view(), options);
  ASSERT_EQ(one.outcome, Outcome::done) << one.message;
  EXPECT_GT(one.volume.tetrahedra.size(), 60'000u);
  EXPECT_EQ(two.volume.vertices, one.volume.vertices);
  EXPECT_EQ(two.volume.tetrahedra, one.volume.tetrahedra);
  EXPECT_EQ(one.report.field.points + sphere.vertices.size(), one.volume.vertices.size());
  for (const Rule& rule : check(sphere.view(), one.volume, {}).rules)
    EXPECT_TRUE(rule.holds) << rule.name << ": " << rule.detail;
}

TEST(FieldThreadsMonitor, HearsTheTimeLimit) {
  const Surface sphere = hard::icosphere(3);
  Options options = two_threads(0.008);
  options.time_limit = 0.5;
  EXPECT_EQ(mesh(sphere.view(), options).outcome, Outcome::time_limit);
}

// On two threads; the function counts calls from other threads than this one.
Options with_counting_field(std::atomic<int>& elsewhere) {
  Options options = two_threads(0);
  options.sizes->field = [&elsewhere, caller = std::this_thread::get_id()](const Point& p) {
    if (std::this_thread::get_id() != caller) ++elsewhere;
    return p[0] < 0 ? 0.045 : 0.055;
  };
  return options;
}

TEST(FieldThreadsMonitor, AFunctionOfTheUserIsCalledOnTheCallersThreadAlone) {
  const Surface sphere = hard::icosphere(4);
  std::atomic<int> elsewhere = 0;
  const Result result = mesh(sphere.view(), with_counting_field(elsewhere));
  EXPECT_EQ(result.outcome, Outcome::done);
  EXPECT_GT(result.volume.tetrahedra.size(), 60'000u);
  EXPECT_EQ(elsewhere, 0);
}

TEST(FieldThreadsStop, AFunctionThatAllowsItIsCalledOnAllThreadsAndMakesNoDifference) {
  const Surface sphere = hard::icosphere(4);
  std::atomic<int> elsewhere = 0;
  Options options = with_counting_field(elsewhere);
  const Result alone = mesh(sphere.view(), options);
  EXPECT_EQ(elsewhere, 0);
  options.sizes->concurrent = true;
  for (const unsigned threads : {1u, 2u, 3u}) {
    options.threads = threads;
    const Result result = mesh(sphere.view(), options);
    EXPECT_EQ(result.volume.vertices, alone.volume.vertices);
    EXPECT_EQ(result.volume.tetrahedra, alone.volume.tetrahedra);
    EXPECT_EQ(elsewhere > 0, threads > 1);
  }
}

}  // namespace
}  // namespace holdfast::field_threads_test
