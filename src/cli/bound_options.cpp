#include "bound_options.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "command.h"
#include "holdfast/region_bounds.h"
#include "holdfast/regular_tetrahedron.h"
#include "number.h"
#include "parts_of_mesh.h"
#include "summary.h"

namespace holdfast::cli {
namespace {

/// V or REGION=V.
struct Bound {
  std::string region;  ///< empty: all regions
  double volume;
};

Bound bound_of(const std::string& text) {
  const std::size_t equals = text.rfind('=');
  Bound bound{equals == std::string::npos ? "" : text.substr(0, equals), 0};
  const std::string number = equals == std::string::npos ? text : text.substr(equals + 1);
  const char* const end = number.data() + number.size();
  const auto [stop, error] = parse_double(number.data(), end, bound.volume);
  if (error != std::errc() || stop != end || !(bound.volume > 0 && std::isfinite(bound.volume)) ||
      equals == 0)
    throw UsageError("--max-volume " + text +
                     ": a positive volume, or REGION=V with a region's id or name, is expected");
  return bound;
}

std::vector<int> ids_of(const std::string& text, const Names& names) {
  std::vector<int> ids = region_ids(text, names);
  if (ids.empty())
    throw UsageError(
        fmt::format("--max-volume: no region has the name '{}'; --name region:ID={} gives it", text, text));
  return ids;
}

}  // namespace

void add_bounds(CLI::App& command, BoundArguments& arguments) {
  command
      .add_option("--max-volume", arguments.max_volumes,
                  "Field points: no tetrahedron is larger, anywhere or in a region, by its id or name in the "
                  "mesh (10=0.5, core=0.5), even at the price of flat ones, which are counted (repeatable)")
      ->allow_extra_args(false)
      ->option_text("[REGION=]V");
  command
      .add_option("--max-ratio", arguments.max_ratio,
                  "Field points: aim at no larger ratio of a tetrahedron's circumradius to its shortest "
                  "edge; exceptions are counted")
      ->option_text("R");
  command
      .add_option("--layers", arguments.layers,
                  "Field points: at least N elements across, on every path inside between two facing sides "
                  "of a wall or a gap, even at the price of flat elements; 1 to 100")
      ->check(CLI::Range(1U, 100U))
      ->option_text("N");
}

void require_bounds(const BoundArguments& arguments) {
  for (const std::string& text : arguments.max_volumes) static_cast<void>(bound_of(text));
  if (arguments.max_ratio &&
      !(*arguments.max_ratio > regular_radius_ratio && std::isfinite(*arguments.max_ratio)))
    throw UsageError(
        fmt::format("--max-ratio {}: a number above 0.613 is expected; a regular tetrahedron has 0.6124",
                    *arguments.max_ratio));
}

void set_bounds(const BoundArguments& arguments, const Names& names, Options& options) {
  if (!options.sizes) return;
  for (const std::string& text : arguments.max_volumes) {
    const Bound bound = bound_of(text);
    if (bound.region.empty()) {
      double& most = options.sizes->max_volume;
      most = most > 0 ? std::min(most, bound.volume) : bound.volume;
      continue;
    }
    for (const int id : ids_of(bound.region, names))
      options.regions.push_back(bound_of_region(id, bound.volume));
  }
  if (arguments.max_ratio) options.sizes->max_ratio = *arguments.max_ratio;
  options.sizes->layers = arguments.layers.value_or(0);
}

namespace {

std::string layers_text(const Report::Layers& layers, unsigned asked) {
  std::string text = fmt::format("{} for {} layers, {} too long for them", counted(layers.points, "point"),
                                 asked, counted(layers.left, "edge"));
  if (layers.at_rims > 0)
    text += fmt::format(", {} left out where fewer edges lead over the side from wall to wall",
                        counted(layers.at_rims, "vertex", "vertices"));
  return text;
}

}  // namespace

std::string bounds_text(const Options& options, const Report& report) {
  const Report::Bounds& bounds = report.bounds;
  std::string text;
  const bool has_volume =
      options.sizes && (options.sizes->max_volume > 0 ||
                        std::any_of(options.regions.begin(), options.regions.end(),
                                    [](const RegionSeed& seed) { return seed.max_volume > 0; }));
  if (has_volume)
    text += fmt::format(
        "the largest tetrahedron has {:.6g} of the volume it may have, {} for it, {} "
        "with an angle below 10 degrees",
        bounds.fullest, counted(bounds.points, "point"),
        counted(bounds.flat, "bounded tetrahedron", "bounded tetrahedra"));
  if (options.sizes && options.sizes->max_ratio > 0)
    text += fmt::format("{}largest ratio {:.4g}, {} above {:g}", text.empty() ? "" : "; ", bounds.worst_ratio,
                        bounds.above_ratio, options.sizes->max_ratio);
  if (options.sizes && options.sizes->layers > 1)
    text += (text.empty() ? "" : "; ") + layers_text(report.layers, options.sizes->layers);
  return text;
}

}  // namespace holdfast::cli
