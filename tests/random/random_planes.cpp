// Random valid points and segments in the plane: every method must give positive triangles of the same area
// that keep every segment and add no point; and the same spoilt in one way, which every method must refuse
// and name.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <optional>

#include "holdfast/names.h"
#include "plane_inputs.h"

namespace {

using namespace holdfast;
using testing::kWays;
using testing::Way;

struct Counts {
  std::size_t spoilt = 0, solved = 0, empty = 0, triangles = 0, swaps = 0, partition_points = 0, ears = 0,
              joined = 0;
};

/// Nothing, or what is wrong with the triangles of one way.
std::string fault(const Plane& plane, const Way& way, bool delaunay, std::optional<exact::Dyadic>& area,
                  Counts& counts) {
  PlaneOptions options;
  options.method = way.method;
  options.ears = way.ears;
  options.partition_first = way.partition_first;
  options.delaunay = delaunay;
  const PlaneResult result = triangulate(plane, options);
  if (result.outcome != Outcome::done) {
    if (result.defects.size() != 1 || result.defects[0].kind != DefectKind::encloses_nothing)
      return "refused: " + (result.defects.empty() ? result.message : result.defects[0].message);
    ++counts.empty;
  } else {
    ++counts.solved;
  }
  counts.triangles += result.report.triangles;
  counts.swaps += result.report.swaps;
  counts.partition_points += result.report.partition_points;
  counts.ears += result.report.ears;
  counts.joined += result.report.joined;
  const exact::Dyadic now = testing::double_area(result.mesh);
  if (!area) area = now;
  if (*area != now) return "the area is not that of the other methods";
  return testing::fault_of(plane, result.mesh, delaunay);
}

/// What is wrong with the answer of one way to an input that is not valid.
std::string fault(const Plane& plane, const Way& way, const testing::Spoilt& spoilt) {
  PlaneOptions options;
  options.method = way.method;
  options.ears = way.ears;
  options.partition_first = way.partition_first;
  const PlaneResult result = triangulate(plane, options);
  if (result.outcome != Outcome::invalid_input || !result.mesh.triangles.empty())
    return std::string("not refused, though it has ") + name(spoilt.kind);
  for (const Defect& d : result.defects)
    if (d.kind == spoilt.kind && d.vertices == spoilt.vertices && d.segments == spoilt.segments) return {};
  return std::string("does not name ") + name(spoilt.kind) + ", but " +
         (result.defects.empty() ? "nothing" : result.defects[0].message);
}

}  // namespace

int main(int count, char** arguments) {
  CLI::App app("Triangulates random planes by every method and checks the triangles", "random_planes");
  std::uint64_t planes = 100000, seed = 1;
  std::size_t segments = 200;
  app.add_option("--count", planes, "How many");
  app.add_option("--seed", seed, "Of the first; the others follow");
  app.add_option("--segments", segments, "The most segments");
  CLI11_PARSE(app, count, arguments);
  Counts counts;
  std::size_t failed = 0;
  for (std::uint64_t s = seed; s < seed + planes; ++s) {
    const Plane plane = testing::random_plane(s, segments);
    std::optional<exact::Dyadic> area;
    const auto judge = [&](const Way& way, const char* input, auto&& find) {
      std::string what;
      try {
        what = find();
      } catch (const std::exception& error) {
        what = error.what();
      }
      if (what.empty()) return;
      ++failed;
      std::printf("seed %llu, %s %s%s%s: %s\n", static_cast<unsigned long long>(s), name(way.method),
                  name(way.ears), way.partition_first ? " partition first" : "", input, what.c_str());
    };
    for (const Way& way : kWays)
      for (const bool delaunay : {false, true})
        judge(way, delaunay ? " Delaunay" : "", [&] { return fault(plane, way, delaunay, area, counts); });
    Plane worse = plane;
    numbers::Random random(s);
    const std::optional<testing::Spoilt> spoilt = testing::spoil(worse, random);
    if (!spoilt) continue;
    for (const Way& way : kWays) judge(way, " spoilt", [&] { return fault(worse, way, *spoilt); });
    ++counts.spoilt;
  }
  std::printf(
      "%llu planes from seed %llu: %zu runs solved, %zu enclose nothing, %zu spoilt ones named, %zu failed; "
      "%zu triangles, %zu ears, %zu joined, %zu swaps, %zu points added and removed\n",
      static_cast<unsigned long long>(planes), static_cast<unsigned long long>(seed), counts.solved,
      counts.empty, counts.spoilt, failed, counts.triangles, counts.ears, counts.joined, counts.swaps,
      counts.partition_points);
  return failed > 0 ? 1 : 0;
}
