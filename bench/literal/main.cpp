// Runs the paper's method literally, on a file or on random complexes (docs/paper.md).
//
//   literal SURFACE [-o VOLUME] [--tangled VOLUME] [--flips] [--local] [--seed S]      one line of JSON
//   literal --random N [--first K] [--seed S] [--most-points P]                         counts, and what
//   failed
#include <CLI/CLI.hpp>
#include <cstdio>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>

#include "families.h"
#include "holdfast/io.h"
#include "literal/literal.h"

namespace {

using namespace holdfast;
using Json = nlohmann::ordered_json;

struct Arguments {
  std::string surface, output, tangled;
  literal::How how;
  std::uint64_t random = 0, first = 0;
};

Json counts_of(const literal::Soup::Counts& counts) {
  return {{"positive", counts.positive}, {"null", counts.null}, {"negative", counts.negative}};
}

Json json_of(const literal::Told& told) {
  return {{"facets", told.facets},
          {"segments", told.segments},
          {"missing_facets", told.missing_facets},
          {"missing_segments", told.missing_segments},
          {"segment_points", told.segment_points},
          {"facet_points", told.facet_points},
          {"insertion",
           {{"points", told.insertion.points},
            {"split", told.insertion.split},
            {"delaunay", told.insertion.delaunay},
            {"visible", told.insertion.visible}}},
          {"eliminated",
           {{"in_facets", told.elimination.in_facets},
            {"on_segments", told.elimination.on_segments},
            {"copies", told.elimination.copies},
            {"emulated", told.elimination.emulated},
            {"left", told.elimination.left}}},
          {"before", counts_of(told.before)},
          {"after", counts_of(told.after)},
          {"inside", counts_of(told.inside)},
          {"ended", told.ended},
          {"message", told.message},
          {"untangled",
           {{"negative", told.untangling.negative},
            {"null", told.untangling.null},
            {"moved", told.untangling.moved},
            {"swapped", told.untangling.swapped},
            {"cavities", told.untangling.cavities},
            {"added", told.untangling.added},
            {"removed", told.untangling.removed}}},
          {"vertices", told.vertices},
          {"tetrahedra", told.tetrahedra}};
}

int one(const Arguments& arguments) {
  const Surface surface = read_surface(arguments.surface);
  if (!diagnose(surface.view(), 1).empty() || !vertex_map(surface.view()).empty()) {
    std::cerr << "literal: " << arguments.surface
              << ": a valid surface without repeated vertices is expected\n";
    return 4;
  }
  const literal::Run run = literal::run(surface, arguments.how);
  if (!arguments.tangled.empty() && !run.tangled.tetrahedra.empty())
    write_volume(arguments.tangled, run.tangled);
  if (!arguments.output.empty() && run.told.ended == "done") write_volume(arguments.output, run.volume);
  Json json = json_of(run.told);
  const literal::InsertionPicture& picture = run.told.picture;
  json["picture"] = {{"point", picture.point},
                     {"split", picture.split},
                     {"delaunay", picture.delaunay},
                     {"visible", picture.visible},
                     {"star", picture.star}};
  std::cout << json << "\n";
  return run.told.ended == "done" ? 0 : 1;
}

// Points taken off segments, by the number of their facets, with what else is added up.
struct Sums {
  std::size_t complexes = 0, with_points = 0, in_facets = 0, copies = 0, null = 0, negative = 0, visible = 0,
              emulated = 0;
  std::vector<std::size_t> on_segments;
  std::map<std::string, std::size_t> ended;

  void add(const literal::Told& told) {
    ++ended[told.ended];
    with_points += told.segment_points + told.facet_points > 0 ? 1 : 0;
    in_facets += told.elimination.in_facets;
    copies += told.elimination.copies;
    emulated += told.elimination.emulated;
    visible += told.insertion.visible;
    null += told.after.null;
    negative += told.after.negative;
    on_segments.resize(std::max(on_segments.size(), told.elimination.on_segments.size()));
    for (std::size_t k = 0; k < told.elimination.on_segments.size(); ++k)
      on_segments[k] += told.elimination.on_segments[k];
  }
};

int torture(const Arguments& arguments) {
  Sums sums;
  Json failed = Json::array();
  for (std::uint64_t k = arguments.first; k < arguments.first + arguments.random; ++k) {
    const Surface surface = random_complexes::recipe_of(arguments.how.seed, k).make().surface;
    if (surface.facets.empty() || !diagnose(surface.view(), 1).empty() || !vertex_map(surface.view()).empty())
      continue;
    ++sums.complexes;
    const literal::Run run = literal::run(surface, arguments.how);
    sums.add(run.told);
    if (run.told.ended != "done" && run.told.ended != "given up" && failed.size() < 100)
      failed.push_back({{"number", k}, {"ended", run.told.ended}, {"message", run.told.message}});
  }
  std::cout << Json{{"complexes", sums.complexes},
                    {"with_points", sums.with_points},
                    {"in_facets", sums.in_facets},
                    {"on_segments", sums.on_segments},
                    {"copies", sums.copies},
                    {"emulated", sums.emulated},
                    {"visible", sums.visible},
                    {"null", sums.null},
                    {"negative", sums.negative},
                    {"ended", sums.ended},
                    {"failed", failed}}
            << "\n";
  return failed.empty() ? 0 : 1;
}

int run(int argc, char** argv) {
  Arguments arguments;
  bool local = false;
  CLI::App app("The paper's method, literally");
  app.add_option("SURFACE", arguments.surface);
  app.add_option("-o", arguments.output, "The volume in the end");
  app.add_option("--tangled", arguments.tangled, "The volume as elimination leaves it");
  app.add_flag("--flips", arguments.how.flips, "Recover by flips first");
  app.add_flag("--local", local, "Points by local splits alone");
  app.add_option("--seed", arguments.how.seed);
  app.add_option("--random", arguments.random, "So many random complexes");
  app.add_option("--first", arguments.first, "The number of the first of them");
  app.add_option("--most-points", arguments.how.most_points,
                 "Gives up beyond so many points of the partition");
  app.add_option("--time-limit", arguments.how.time_limit, "Seconds of untangling");
  CLI11_PARSE(app, argc, argv);
  arguments.how.grow = !local;
  if (arguments.surface.empty() == (arguments.random == 0)) {
    std::cerr << "literal: give a surface, or --random N\n";
    return 2;
  }
  return arguments.random > 0 ? torture(arguments) : one(arguments);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "literal: " << error.what() << "\n";
    return 3;
  }
}
