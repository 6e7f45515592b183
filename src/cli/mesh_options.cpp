#include "mesh_options.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "command.h"
#include "holdfast/io.h"
#include "number.h"

namespace holdfast::cli {
namespace {

constexpr double bytes_per_gigabyte = 1e9;

/// Splits at commas into exactly `count` finite numbers. Throws UsageError that says `what` is expected.
std::vector<double> numbers(const char* option, const std::string& text, std::size_t count,
                            const char* what) {
  std::vector<double> values;
  const char* at = text.data();
  const char* const end = at + text.size();
  for (;;) {
    double value = 0;
    const auto [stop, error] = parse_double(at, end, value);
    if (error != std::errc() || !std::isfinite(value)) break;
    values.push_back(value);
    at = stop;
    if (at == end || *at != ',') break;
    ++at;
  }
  if (at != end || values.size() != count)
    throw UsageError(fmt::format("{}{}: {} expected", option, text, what));
  return values;
}

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
    if (options.box_margin <= 0)
      throw UsageError("--keep " + keep + ": the margin, a part of the largest extent, must be positive");
  } else {
    throw UsageError("--keep " + keep + ": auto, bounded, winding, box or box=MARGIN is expected");
  }
}

Stage stage_named(const std::string& text) {
  std::string known;
  for (int i = 0; i <= static_cast<int>(Stage::optimise); ++i) {
    const auto stage = static_cast<Stage>(i);
    if (text == holdfast::name(stage)) return stage;
    known += std::string(i == 0 ? "" : ", ") + holdfast::name(stage);
  }
  throw UsageError("--stop-after " + text + ": there is no such stage; there are " + known);
}

Sizes to_sizes(const MeshArguments& arguments) {
  if (!(arguments.size >= 0)) throw UsageError("--size: the length must be positive");
  if (!(arguments.gradation >= 0 && arguments.gradation <= 1))
    throw UsageError("--gradation: a number from 0 to 1 is expected");
  Sizes sizes;
  sizes.size = arguments.size;
  sizes.gradation = arguments.gradation;
  sizes.grow = !arguments.no_growth;
  if (!arguments.size_field.empty()) {
    SizeField field = read_size_field(arguments.size_field);
    if (field.vertices.empty())
      sizes.vertex_sizes = std::move(field.sizes);
    else if (!field.metrics.empty())
      sizes.metric = metric_function(std::move(field));
    else
      sizes.field = size_function(std::move(field));
  }
  return sizes;
}

Quality quality_named(const std::string& text) {
  if (text == "fast") return Quality::fast;
  if (text == "good") return Quality::good;
  if (text == "best") return Quality::best;
  throw UsageError("--quality " + text + ": fast, good or best is expected");
}

}  // namespace

Options to_options(const MeshArguments& arguments) {
  Options options;
  set_keep(options, arguments.keep);
  for (const std::string& hole : arguments.holes) {
    const std::vector<double> x = numbers("--hole ", hole, 3, "three numbers x,y,z are");
    options.holes.push_back({x[0], x[1], x[2]});
  }
  for (const std::string& region : arguments.regions) {
    const bool with_size = std::count(region.begin(), region.end(), ',') == 4;
    const std::vector<double> x = numbers("--region ", region, with_size ? 5 : 4,
                                          "three numbers and an id x,y,z,ID, and perhaps a size ,H, are");
    if (x[3] != std::floor(x[3]) || std::abs(x[3]) > INT32_MAX)
      throw UsageError("--region " + region + ": the region id must be an integer");
    if (with_size && !(x[4] > 0)) throw UsageError("--region " + region + ": the size must be positive");
    options.regions.push_back({{x[0], x[1], x[2]}, static_cast<int>(x[3]), with_size ? x[4] : 0});
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
  options.quality = quality_named(arguments.quality);
  if (!arguments.stop_after.empty()) options.stop_after = stage_named(arguments.stop_after);
  if (!(arguments.time_limit >= 0)) throw UsageError("--time-limit: seconds must not be negative");
  if (!(arguments.memory_limit >= 0 && arguments.memory_limit < 1e9))
    throw UsageError("--memory-limit: gigabytes must not be negative");
  options.drop_outside = arguments.drop_outside;
  options.seed = arguments.seed;
  options.threads = arguments.threads;
  options.time_limit = arguments.time_limit;
  options.memory_limit = static_cast<std::uint64_t>(arguments.memory_limit * bytes_per_gigabyte);
  return options;
}

Json to_json(const MeshArguments& arguments) {
  Json surfaces = Json::array();
  for (const std::filesystem::path& path : arguments.surfaces) surfaces.push_back(path.string());
  return {{"surfaces", surfaces},
          {"output", arguments.output.string()},
          {"fill", arguments.fill},
          {"size", arguments.size},
          {"gradation", arguments.gradation},
          {"no_growth", arguments.no_growth},
          {"size_field", arguments.size_field.string()},
          {"quality", arguments.quality},
          {"keep", arguments.keep},
          {"holes", arguments.holes},
          {"regions", arguments.regions},
          {"drop_outside", arguments.drop_outside},
          {"without", arguments.without},
          {"stop_after", arguments.stop_after},
          {"seed", arguments.seed},
          {"threads", arguments.threads},
          {"time_limit", arguments.time_limit},
          {"memory_limit", arguments.memory_limit}};
}

}  // namespace holdfast::cli
