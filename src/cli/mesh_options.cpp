#include "mesh_options.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "command.h"
#include "holdfast/io.h"
#include "holdfast/memory.h"
#include "holdfast/names.h"
#include "idle_options.h"
#include "limits.h"
#include "named.h"
#include "number_list.h"
#include "paste_options.h"

namespace holdfast::cli {
namespace {

void set_keep(Options& options, const std::string& keep) {
  if (keep == "auto") {
    options.keep = Keep::automatic;
  } else if (keep == "bounded") {
    options.keep = Keep::bounded;
  } else if (keep == "winding") {
    options.keep = Keep::winding;
  } else if (keep == "box" || keep.starts_with("box=")) {
    options.keep = Keep::box;
    if (keep.size() > 3)
      options.box_margin = numbers("--keep box=", keep.substr(4), 1, "a number such as 0.5 is")[0];
    if (!(options.box_margin > 0 && options.box_margin < 1e6))
      throw UsageError("--keep " + keep +
                       ": the margin, a part of the largest extent, must be positive and below a million");
  } else {
    throw UsageError("--keep " + keep + ": auto, bounded, winding, box or box=MARGIN is expected");
  }
}

bool is_positive(double x) { return x > 0 && std::isfinite(x); }

Sizes to_sizes(const MeshArguments& arguments) {
  if (arguments.size && !is_positive(*arguments.size))
    throw UsageError(fmt::format("--size {}: a positive and finite length is expected", *arguments.size));
  Sizes sizes;
  sizes.size = arguments.size.value_or(sizes.size);
  sizes.gradation = arguments.gradation;
  if (sizes.gradation && !(*sizes.gradation >= 0 && *sizes.gradation <= 1))
    throw UsageError(fmt::format("--gradation {}: a number from 0 to 1 is expected", *sizes.gradation));
  sizes.grow = !arguments.no_growth;
  return sizes;
}

Effort effort_named(const std::string& text) {
  if (const std::optional<Effort> effort = from_name<Effort>(text)) return *effort;
  throw UsageError("--quality " + text + ": fast, good or best is expected");
}

LayingOrder order_named(const std::string& text) {
  if (const std::optional<LayingOrder> order = from_name<LayingOrder>(text)) return *order;
  throw UsageError(
      "--order " + text +
      ": 1 or 2 (order of the elements), or given, random or halving (of the constraints) is expected");
}

}  // namespace

Stage stage_named(const std::string& text) {
  if (const std::optional<Stage> stage = from_name<Stage>(text)) return *stage;
  throw UsageError("--stop-after " + text + ": there is no such stage; there are " + names_of<Stage>());
}

double time_limit_of(const std::optional<double>& seconds) {
  if (seconds && !is_positive(*seconds))
    throw UsageError(fmt::format(
        "--time-limit {}: a positive number of seconds is expected; without the option there is no limit",
        *seconds));
  return seconds.value_or(0);
}

std::uint64_t memory_limit_of(const std::optional<double>& gigabytes) {
  constexpr double bytes_per_gigabyte = 1e9, most = 1e9;
  if (gigabytes && !(*gigabytes > 0 && *gigabytes < most))
    throw UsageError(fmt::format(
        "--memory-limit {}: a positive number of gigabytes is expected; without the option it is most of the "
        "machine's memory",
        *gigabytes));
  if (!gigabytes) return usual_memory_limit();
  return static_cast<std::uint64_t>(std::ceil(*gigabytes * bytes_per_gigabyte));
}

std::optional<Extent> read_size_field(const MeshArguments& arguments, Options& options) {
  if (arguments.size_field.empty()) return std::nullopt;
  SizeField field = holdfast::read_size_field(arguments.size_field, reading(options, {}));
  Sizes& sizes = *options.sizes;
  sizes.concurrent = true;
  if (field.vertices.empty()) {
    sizes.vertex_sizes = std::move(field.sizes);
    return std::nullopt;
  }
  const Extent extent = extent_of(field.vertices);
  if (!field.metrics.empty())
    sizes.metric = metric_function(std::move(field));
  else
    sizes.field = size_function(std::move(field));
  return extent;
}

void take_orders(MeshArguments& arguments, const std::vector<std::string>& words) {
  std::string of_elements;
  for (const std::string& word : words) {
    std::string& given = word == "1" || word == "2" ? of_elements : arguments.order;
    if (!given.empty())
      throw CLI::ValidationError("--order " + given + " --order " + word,
                                 "one order of the elements (1 or 2) and one of the constraints (random, "
                                 "given or halving) is expected");
    given = word;
  }
  if (!of_elements.empty()) arguments.elements.order = of_elements == "2" ? 2 : 1;
}

std::optional<RepairOptions> repair_options(const MeshArguments& arguments, const Options& options) {
  if (!arguments.repair) return std::nullopt;
  RepairOptions repair;
  static_cast<Limits&>(repair) = options;
  repair.threads = options.threads;
  take_repair_ways(arguments.repair_ways, repair);
  repair.weld = weld_of(*arguments.repair);
  return repair;
}

Options to_options(const MeshArguments& arguments) {
  Options options;
  set_keep(options, arguments.keep.value_or("auto"));
  for (const std::string& hole : arguments.holes) {
    const std::vector<double> x = numbers("--hole ", hole, 3, "three numbers x,y,z are");
    options.holes.push_back({x[0], x[1], x[2]});
  }
  for (const std::string& region : arguments.regions) {
    const bool with_size = std::count(region.begin(), region.end(), ',') == 4;
    const std::vector<double> x = numbers("--region ", region, with_size ? 5 : 4,
                                          "three numbers and an id x,y,z,ID, and perhaps a size ,H, are");
    const int id = region_id_of(region, x[3]);
    if (with_size && !is_positive(x[4]))
      throw UsageError("--region " + region + ": the size must be positive");
    options.regions.push_back({{x[0], x[1], x[2]}, id, with_size ? x[4] : 0});
  }
  for (const std::string& step : arguments.without) {
    if (step == "flips")
      options.flips = false;
    else if (step == "optimise")
      options.optimise = false;
    else if (step == "points")
      options.add_points = false;
    else
      throw UsageError("--without " + step + ": only 'flips', 'optimise' and 'points' can be left out");
  }
  if (!arguments.fill) options.sizes = to_sizes(arguments);
  require_bounds(arguments.bounds);
  options.effort = effort_named(arguments.quality.value_or("good"));
  if (!arguments.stop_after.empty()) options.stop_after = stage_named(arguments.stop_after);
  if (!arguments.order.empty()) options.order = order_named(arguments.order);
  options.drop_outside =
      arguments.drop_outside || arguments.repair_ways.unite;  // a union leaves the vertices of what it drops
  options.seed = arguments.seed;
  options.threads = arguments.threads;
  options.time_limit = time_limit_of(arguments.time_limit);
  options.memory_limit = memory_limit_of(arguments.memory_limit);
  if (arguments.paste && !arguments.paste->empty())
    static_cast<void>(tolerance_of(*arguments.paste, "--paste"));
  static_cast<void>(overlap_named(arguments.overlap));
  refuse_idle_options(arguments);
  return options;
}

Json to_json(const MeshArguments& arguments) {
  Json surfaces = Json::array();
  for (const std::filesystem::path& path : arguments.surfaces) surfaces.push_back(path.string());
  return {{"surfaces", surfaces},
          {"surface_of", arguments.surface_of},
          {"output", arguments.output.path.string()},
          {"fill", arguments.fill},
          {"size", arguments.size.value_or(0)},
          {"gradation", arguments.gradation ? Json(*arguments.gradation) : Json()},
          {"no_growth", arguments.no_growth},
          {"size_field", arguments.size_field.string()},
          {"max_volume", arguments.bounds.max_volumes},
          {"max_ratio", arguments.bounds.max_ratio.value_or(0)},
          {"layers", arguments.bounds.layers.value_or(0)},
          {"element_order", arguments.elements.order.value_or(1)},
          {"curved", arguments.elements.curved.string()},
          {"curved_tolerance", arguments.elements.tolerance.value_or(0)},
          {"quality", arguments.quality.value_or("good")},
          {"repair", arguments.repair.has_value()},
          {"fill_holes", sides_to_json(arguments.repair_ways.fill_holes)},
          {"union", arguments.repair_ways.unite},
          {"repaired", arguments.repaired.string()},
          {"keep", arguments.keep.value_or("auto")},
          {"holes", arguments.holes},
          {"regions", arguments.regions},
          {"names", arguments.names},
          {"paste", arguments.paste ? Json(*arguments.paste) : Json(nullptr)},
          {"overlap", arguments.overlap ? Json(*arguments.overlap) : Json(nullptr)},
          {"markers_by_angle", arguments.markers_by_angle ? Json(*arguments.markers_by_angle) : Json()},
          {"drop_outside", arguments.drop_outside || arguments.repair_ways.unite},
          {"drop_unused", arguments.drop_unused},
          {"without", arguments.without},
          {"stop_after", arguments.stop_after},
          {"order", arguments.order.empty() ? name(LayingOrder::random) : arguments.order},
          {"tolerance", arguments.tolerance},
          {"seed", arguments.seed},
          {"threads", arguments.threads},
          {"time_limit", arguments.time_limit.value_or(0)},
          {"memory_limit", arguments.memory_limit.value_or(0)}};
}

}  // namespace holdfast::cli
