#include "idle_options.h"

#include <fmt/core.h>

#include <algorithm>

#include "command.h"

namespace holdfast::cli {
namespace {

bool leaves_out(const MeshArguments& arguments, const char* step) {
  return std::find(arguments.without.begin(), arguments.without.end(), step) != arguments.without.end();
}

bool limits_a_region(const MeshArguments& arguments) {
  return std::any_of(arguments.regions.begin(), arguments.regions.end(), [](const std::string& region) {
    return std::count(region.begin(), region.end(), ',') > 3;
  });
}

struct Given {
  std::string option;
  bool is_given;
};

std::vector<Given> for_field_points(const MeshArguments& a) {
  return {{"--size", a.size.has_value()},
          {"--gradation", a.gradation.has_value()},
          {"--size-field", !a.size_field.empty()},
          {"--no-growth", a.no_growth},
          {"--max-volume", !a.bounds.max_volumes.empty()},
          {"--max-ratio", a.bounds.max_ratio.has_value()},
          {"--layers", a.bounds.layers.has_value()},
          {"the size H of --region", limits_a_region(a)}};
}

void refuse(const std::vector<Given>& options, const std::string& beside, const char* reason) {
  for (const Given& given : options)
    if (given.is_given)
      throw UsageError(fmt::format("{} does nothing with {}: {}", given.option, beside, reason));
}

void refuse_beside_fill(const MeshArguments& a) {
  std::vector<Given> options = for_field_points(a);
  options.push_back({"--quality", a.quality.has_value()});
  refuse(options, "--fill", "it is for field points, and --fill adds none");
}

void refuse_beside_without(const MeshArguments& a) {
  if (!leaves_out(a, "optimise")) return;
  refuse({{"--quality", a.quality.has_value()}, {"--without points", leaves_out(a, "points")}},
         "--without optimise", "it is for the optimisation");
}

void refuse_without_fill(const MeshArguments& a) {
  if (leaves_out(a, "points"))
    throw UsageError("--without points does nothing without --fill: field points are wanted then");
}

void refuse_without_repair(const MeshArguments& a) {
  for (const Given& given :
       {Given{"--repaired", !a.repaired.empty()}, Given{"--fill-holes", a.repair_ways.fill_holes.has_value()},
        Given{"--union", a.repair_ways.unite}})
    if (given.is_given)
      throw UsageError(
          fmt::format("{} does nothing without --repair: the surface is meshed as it is", given.option));
}

void refuse_after_end(const MeshArguments& a) {
  if (a.stop_after.empty()) return;
  const Stage last = stage_named(a.stop_after);
  const std::string beside = "--stop-after " + a.stop_after;
  const char* const reason = "it is for a later stage";
  if (last < Stage::flips) refuse({{"--without flips", leaves_out(a, "flips")}}, beside, reason);
  if (last < Stage::partition) refuse({{"--order", !a.order.empty()}}, beside, reason);
  if (last < Stage::classify)
    refuse({{"--keep " + a.keep.value_or(""), a.keep && !a.keep->starts_with("box")},
            {"--hole", !a.holes.empty()},
            {"--region", !a.regions.empty()},
            {"--drop-outside", a.drop_outside},
            {"--overlap", a.overlap.has_value()}},
           beside, reason);
  if (last < Stage::suppress) refuse({{"--exact", !a.exact.empty()}}, beside, reason);
  if (last < Stage::field_points) {
    refuse({{"--fill", a.fill}}, beside, "field points, which it leaves out, come later");
    refuse(for_field_points(a), beside, reason);
  }
  if (last < Stage::optimise)
    refuse({{"--quality", a.quality.has_value()},
            {"--without optimise", leaves_out(a, "optimise")},
            {"--without points", leaves_out(a, "points")}},
           beside, reason);
  if (a.fill && last == Stage::field_points)
    throw UsageError("--stop-after field_points has no such stage with --fill");
}

}  // namespace

void refuse_idle_options(const MeshArguments& arguments) {
  if (arguments.surfaces.size() < 2 && !arguments.paste)
    refuse({{"--overlap", arguments.overlap.has_value()}}, "a single file",
           "--paste makes parts of its components");
  if (arguments.fill) refuse_beside_fill(arguments);
  refuse_beside_without(arguments);
  if (!arguments.repair) refuse_without_repair(arguments);
  if (arguments.repair && (arguments.paste || arguments.overlap))
    throw UsageError(
        "--paste and --overlap are for parts that are valid; with --repair all files are one surface");
  refuse_after_end(arguments);
  if (!arguments.fill) refuse_without_fill(arguments);
}

void refuse_idle_options(const MeshArguments& arguments, const Options& options, const Surface& surface) {
  if (options.sizes && options.sizes->metric)
    refuse({{"--no-growth", arguments.no_growth}}, "metric tensors", "these say all of the sizes inside");
  if (options.keep == Keep::box && options.holes.empty() && surface.holes.empty())
    refuse({{"--drop-outside", arguments.drop_outside}}, "--keep box", "without a hole, nothing is outside");
}

}  // namespace holdfast::cli
