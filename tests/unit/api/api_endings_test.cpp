// Calls that do not end with a whole mesh: refused, interrupted, or stopped after a stage.
#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <limits>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

#include "delaunay/box.h"
#include "holdfast/check.h"
#include "holdfast/cures.h"
#include "holdfast/holdfast.h"
#include "holdfast/paste.h"
#include "holdfast/summary.h"
#include "holdfast/tetgen.h"
#include "small_surfaces.h"
#include "unit/meshed.h"

namespace holdfast::api_endings_test {
namespace {

using namespace testing;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(Refusal, OfInvalidInput) {
  Surface surface = small::box();
  small::add_triangle(surface, {0.5, 0.5, 0.5}, {1.5, 0.4, 0.5}, {0.5, 0.5, 1.5});
  const Result result = mesh(surface.view());
  EXPECT_EQ(result.outcome, Outcome::invalid_input);
  EXPECT_FALSE(result.defects.empty());
  EXPECT_FALSE(result.message.empty());
  expect_empty(result.volume);
  EXPECT_EQ(result.report.input.facets, 13u);
}

TEST(Refusal, OfIndicesAndCoordinatesThatMakeNoSense) {
  Surface surface = small::box();
  surface.facets[3][1] = 1000000;
  surface.vertices[2][1] = kInfinity;
  const Result result = mesh(surface.view());
  EXPECT_EQ(result.outcome, Outcome::invalid_input);
  EXPECT_EQ(result.defects.size(), 2u);
}

TEST(Refusal, OfWhatEnclosesNothing) {
  for (const Surface& surface : {small::open_box(), Surface{}}) {
    const Result result = mesh(surface.view());
    EXPECT_EQ(result.outcome, Outcome::invalid_input);
    ASSERT_EQ(result.defects.size(), 1u);
    EXPECT_EQ(result.defects[0].kind, DefectKind::encloses_nothing);
    expect_empty(result.volume);
  }
}

TEST(Refusal, OfWhatLiesOutside) {
  Surface surface = small::box();
  small::add_triangle(surface, {2, 0, 0}, {3, 0, 0}, {2, 1, 0});
  const Result refused = mesh(surface.view());
  EXPECT_EQ(refused.outcome, Outcome::invalid_input);
  ASSERT_EQ(refused.defects.size(), 1u);
  EXPECT_EQ(refused.defects[0].kind, DefectKind::outside_region);

  Options options;
  options.drop_outside = true;
  const Result result = mesh(surface.view(), options);
  CheckOptions check_options;
  check_options.outside_dropped = true;
  expect_done(surface, result, check_options);
  EXPECT_EQ(result.volume.facets.size(), 12u);
  EXPECT_EQ(result.volume.vertices.size(), surface.vertices.size() + result.report.steiner_points);
}

TEST(Refusal, OfOptionsThatMakeNoSense) {
  Surface surface = small::box();
  const auto refused = [&](const Options& options) {
    EXPECT_THROW(static_cast<void>(mesh(surface.view(), options)), std::invalid_argument);
  };
  Options options;
  options.holes = {{5, 5, 5}};
  refused(options);
  options.holes = {{kInfinity, 5, 5}};
  refused(options);
  options = {};
  options.regions = {{{0.5, std::nan(""), 0.5}, 1}};
  refused(options);
  options = {};
  options.keep = Keep::box;
  for (const double margin : {0.0, -1.0, kInfinity, std::nan("")}) {
    options.box_margin = margin;
    refused(options);
  }
  surface.facet_markers = {1, 2, 3};
  refused({});
  surface.facet_markers.clear();
  surface.vertex_markers = {1};
  EXPECT_THROW(static_cast<void>(mesh(surface.view())), std::invalid_argument);
  surface.vertex_markers.clear();
  surface.segment_markers = {1};
  refused({});
}

TEST(Refusal, OfAConvexHullForIndicesOutOfRange) {
  Surface surface = small::box();
  surface.segments = {{0, 8}};
  EXPECT_THROW(static_cast<void>(add_convex_hull(surface)), std::invalid_argument);
  surface.segments.clear();
  surface.facets[3][1] = 1000000;
  EXPECT_THROW(static_cast<void>(add_convex_hull(surface)), std::invalid_argument);
}

TEST(Interruption, ByTime) {
  Options options;
  options.time_limit = 1e-9;
  const Result result = mesh(small::box(), options);
  EXPECT_EQ(result.outcome, Outcome::time_limit);
  EXPECT_NE(result.message.find("time limit"), std::string::npos) << result.message;
  EXPECT_TRUE(result.report.seconds.contains("total"));
  expect_empty(result.volume);
}

TEST(Interruption, ByMemory) {
  Options options;
  options.memory_limit = 1;
  const Result result = mesh(small::box(), options);
  EXPECT_EQ(result.outcome, Outcome::memory_limit);
  EXPECT_NE(result.message.find("memory limit"), std::string::npos) << result.message;
  expect_empty(result.volume);
}

/// Takes 0.3 s at the first call, and at the first one from a fraction on.
std::function<bool(double)> slow_at_first_and_from(double second) {
  return [second, next = 0.0](double fraction) mutable {
    if (fraction >= next) {
      std::this_thread::sleep_for(std::chrono::milliseconds(300));
      next = next == 0 ? second : 2;
    }
    return true;
  };
}

/// Volumes that cut their common face differently, so that tetrahedra of both are replaced.
std::vector<Volume> shifted_boxes() {
  return {mesh(small::box()).volume, mesh(small::box({1, 0.5, 0}, {2, 1.5, 1})).volume};
}

// Neither the boundaries nor the fillings alone exceed the limit, but together they do.
TEST(Interruption, ByTheTimeOfAllThatPastingVolumesCalls) {
  PasteOptions options;
  options.time_limit = 0.5;
  options.progress = slow_at_first_and_from(0.51);
  EXPECT_EQ(paste(shifted_boxes(), options).outcome, Outcome::time_limit);
}

// A repair that cuts, and then one that fills the hole.
TEST(Interruption, ByTheTimeOfAllRepairsThatAProposalTries) {
  Surface surface = small::open_box();
  small::add_triangle(surface, {0.5, 0.5, 0.5}, {1.5, 0.4, 0.5}, {0.5, 0.5, 1.5});
  const std::vector<Defect> defects = diagnose(surface.view());
  const DefectSummary summary = summarise(surface.view(), defects);
  RepairOptions options;
  double last = 0;
  options.progress = [&](double fraction) {
    EXPECT_GE(fraction, last);
    last = fraction;
    return true;
  };
  static_cast<void>(propose_cures(surface.view(), defects, summary, options));
  EXPECT_GT(last, 0.5);
  options.time_limit = 0.5;
  options.progress = slow_at_first_and_from(0.5);
  EXPECT_THROW(static_cast<void>(propose_cures(surface.view(), defects, summary, options)), Interrupted);
}

// A surface has some triangles in one of many faces in one plane: however late it is cancelled, the result is
// complete or nothing.
TEST(Interruption, OfAConvexHullLeavesNothingOut) {
  constexpr Index kSide = 30;
  Surface given;
  for (Index y = 0; y < kSide; ++y)
    for (Index x = 0; x < kSide; ++x) given.vertices.push_back({double(x), double(y), 0});
  given.vertices.push_back({1, 1, 1});
  for (Index i = 0; i + 1 < kSide; ++i) given.facets.push_back({i, i + 1 + kSide, i + kSide});
  Surface whole = given;
  const auto start = std::chrono::steady_clock::now();
  static_cast<void>(add_convex_hull(whole));
  const auto whole_time = std::chrono::steady_clock::now() - start;
  constexpr int kTrials = 20;
  for (int k = 1; k <= kTrials; ++k) {
    Surface surface = given;
    Limits limits;
    limits.cancel.emplace();
    std::thread canceller([&] {
      std::this_thread::sleep_for(k * whole_time / kTrials);
      limits.cancel->cancel();
    });
    try {
      static_cast<void>(add_convex_hull(surface, limits));
      EXPECT_EQ(surface.facets, whole.facets);
    } catch (const Interrupted&) {
      EXPECT_EQ(surface.facets, given.facets);
    }
    canceller.join();
  }
}

TEST(Interruption, AtEveryStage) {
  const Surface surface = small::box();
  for (const Stage stage : {Stage::validate, Stage::delaunay, Stage::flips, Stage::partition, Stage::classify,
                            Stage::suppress, Stage::optimise}) {
    Options options;
    options.progress = [&](const Progress& progress) { return progress.stage != stage; };
    const Result result = mesh(surface.view(), options);
    EXPECT_EQ(result.outcome, Outcome::cancelled) << name(stage);
    EXPECT_EQ(result.message, std::string("cancelled in stage ") + name(stage));
    expect_empty(result.volume);
  }
}

// A component too small for the sizes of the other is meshed by a separate call after the rest.
TEST(Interruption, InAComponentThatIsMeshedAlone) {
  constexpr double kTiny = 1e-120;
  Surface surface = small::box({-2, -2, -2}, {-1, -1, -1});
  small::add_box(surface, {0, 0, 0}, {kTiny, kTiny, kTiny});
  Options options;
  options.sizes.emplace();
  bool is_rest_done = false;
  double last = 0;
  options.progress = [&](const Progress& progress) {
    EXPECT_GE(progress.overall, last);
    last = progress.overall;
    is_rest_done |= progress.stage == Stage::optimise;
    return !is_rest_done || progress.stage != Stage::validate;
  };
  const Result result = mesh(surface.view(), options);
  EXPECT_EQ(result.outcome, Outcome::cancelled);
  expect_empty(result.volume);
}

// The callback is called at intervals of time, and the fraction is 0 only at the beginning of a stage. On any
// machine, some surface is so large that a stage takes longer than the interval.
TEST(Interruption, WithinAStage) {
  Options options;
  options.flips = false;
  options.progress = [](const Progress& progress) { return progress.fraction == 0; };
  Outcome outcome = Outcome::done;
  for (int size = 100; outcome == Outcome::done && size <= 1600; size *= 2)
    outcome = mesh(bumpy(size, 200), options).outcome;
  EXPECT_EQ(outcome, Outcome::cancelled);
}

TEST(Progress, StagesComeInOrder) {
  std::vector<Stage> stages;
  Options options;
  options.progress = [&](const Progress& progress) {
    EXPECT_GE(progress.fraction, 0);
    EXPECT_LE(progress.fraction, 1);
    if (stages.empty() || stages.back() != progress.stage) stages.push_back(progress.stage);
    return true;
  };
  EXPECT_EQ(mesh(small::box(), options).outcome, Outcome::done);
  EXPECT_EQ(stages,
            (std::vector<Stage>{Stage::validate, Stage::delaunay, Stage::validate, Stage::flips,
                                Stage::partition, Stage::classify, Stage::suppress, Stage::optimise}));
}

TEST(Progress, OfPastingVolumesNeverGoesBack) {
  PasteOptions options;
  double last = 0;
  options.progress = [&](double fraction) {
    EXPECT_GE(fraction, last);
    EXPECT_LE(fraction, 1);
    last = fraction;
    return true;
  };
  const PastedVolumes pasted = paste(shifted_boxes(), options);
  EXPECT_EQ(pasted.outcome, Outcome::done) << pasted.message;
  EXPECT_GT(pasted.replaced, 0u);
  EXPECT_GT(last, 0.5);
}

TEST(StopAfter, ShowsWhatStands) {
  const Surface surface = small::without_integer_points(0);
  Options options;
  const auto after = [&](Stage stage) {
    options.stop_after = stage;
    Result result = mesh(surface.view(), options);
    EXPECT_EQ(result.outcome, Outcome::done) << name(stage);
    EXPECT_EQ(result.volume.regions.size(), result.volume.tetrahedra.size());
    for (std::size_t i = 0; i < surface.vertices.size(); ++i)
      EXPECT_EQ(result.volume.vertices[i], surface.vertices[i]);
    return result;
  };
  const Result validated = after(Stage::validate);
  EXPECT_EQ(validated.volume.vertices.size(), 6u);
  EXPECT_TRUE(validated.volume.tetrahedra.empty());

  for (const Stage stage : {Stage::delaunay, Stage::flips}) {
    const Result result = after(stage);
    EXPECT_EQ(ids(result.volume), std::set<int>{0});
    EXPECT_EQ(result.volume.vertices.size(), 14u);
    EXPECT_EQ(result.report.steiner_points, 0u);
    const std::size_t missing =
        (stage == Stage::delaunay ? result.report.delaunay : result.report.flips).facets;
    EXPECT_EQ(result.volume.facets.size(), 8 - missing);
    EXPECT_GT(missing, 0u);
  }
  const Result partitioned = after(Stage::partition);
  EXPECT_GT(partitioned.report.segment_points, 0u);
  EXPECT_EQ(partitioned.report.steiner_points,
            partitioned.report.segment_points + partitioned.report.facet_points);
  EXPECT_EQ(partitioned.volume.facets.size(), 8 - partitioned.report.flips.facets);

  const Result eliminated = after(Stage::eliminate);
  EXPECT_EQ(ids(eliminated.volume), std::set<int>{0});
  EXPECT_EQ(eliminated.volume.facets.size(), 8u);

  const Result classified = after(Stage::classify);
  EXPECT_EQ(ids(classified.volume), std::set<int>{1});
  EXPECT_EQ(classified.report.regions, 1u);
  expect_done(surface, after(Stage::suppress));
}

TEST(StopAfter, OpenSurfacesCanBeLookedAt) {
  Options options;
  options.stop_after = Stage::delaunay;
  EXPECT_EQ(mesh(small::open_box(), options).outcome, Outcome::done);
}

}  // namespace
}  // namespace holdfast::api_endings_test
