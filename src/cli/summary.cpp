#include "summary.h"

#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>

#include "command.h"

namespace holdfast::cli {
namespace {

const char* rule_of(Keep keep) {
  switch (keep) {
    case Keep::bounded:
      return "every bounded one";
    case Keep::winding:
      return "by winding number";
    case Keep::box:
      return "out to a box";
    case Keep::automatic:
      break;
  }
  return "not chosen yet";
}

void print_field(const Report::Field& field) {
  say("field      {}, least dihedral angle {:.3g} degrees before optimisation, {:.3g} after\n",
      counted(field.points, "point"), field.before.min_dihedral_deg, field.after.min_dihedral_deg);
  if (!field.limiting.empty())
    say("           triangles limit sizes on {:.3g} % of the volume, {} most: {:.3g} in place of {:.3g}\n",
        100 * field.limited_volume, field.limiting[0].facet, field.limiting[0].bearable,
        field.limiting[0].wanted);
  for (const Report::Field::SmallerSize& s : field.smaller_sizes)
    say("           size {:.3g} in region {} in place of {:.3g}, which gives too few elements\n", s.used,
        s.region, s.asked);
  if (field.below_10_deg == 0) return;
  say("           {} below 10 degrees, {} of them forced by the surface",
      counted(field.below_10_deg, "element"), field.forced);
  if (!field.worst_forced.empty())
    say(": the worst, of {:.3g} degrees, by triangles {}", field.worst_forced[0].min_dihedral_deg,
        fmt::join(field.worst_forced[0].facets, " and "));
  say("\n");
}

/// The angles that judge elements; with a metric, measured in it.
struct Angles {
  double least;
  std::size_t below_10_deg;
  bool in_metric;
};

Angles angles_of(const Report& report, bool with_metric) {
  if (!with_metric) return {report.elements.min_dihedral_deg, report.elements.below_10_deg, false};
  const auto& bins = report.field.after.least_dihedral;  // bins of 5 degrees
  return {report.field.after.min_dihedral_deg, bins[0] + bins[1], true};
}

/// The reason for flat elements.
std::string reason_for(const Report& report, const Options& options, const Angles& angles) {
  if (options.stop_after) return "the run stops before elements are improved";
  if (!options.sizes) return "without field points, elements span what lies between the surface's vertices";
  if (angles.in_metric) return "the metric and the surface's triangles differ too much";
  const Report::Field& field = report.field;
  const std::size_t others = field.below_10_deg - field.forced - field.across;
  const std::string of_all = fmt::format(" of {} below 10 degrees", field.below_10_deg);
  if (field.forced >= field.across && field.forced >= others)
    return fmt::format("small angles of the surface force {}{}", field.forced, of_all);
  if (field.across >= others)
    return fmt::format("the surface's triangles are larger than it is thick at {}{}", field.across, of_all);
  return fmt::format("the sizes and the surface's triangles differ too much at {}{}", others, of_all);
}

std::string quality_of(const Result& result, const Options& options) {
  constexpr double least_good = 1, most_below = 0.05;  // in degrees, and as a share of the elements
  const Angles angles = angles_of(result.report, options.sizes && options.sizes->metric);
  const double below = static_cast<double>(angles.below_10_deg) /
                       static_cast<double>(std::max<std::size_t>(1, result.report.tetrahedra));
  std::string text = fmt::format("least dihedral angle {:.3g} degrees{}, {:.3g} % of elements below 10",
                                 angles.least, angles.in_metric ? " as the metric sees it" : "", 100 * below);
  if (angles.least < least_good || below > most_below)
    text += ": poor, as " + reason_for(result.report, options, angles);
  return text;
}

/// The rule that --keep auto chose. If triangles are turned, a warning says why there are no winding numbers.
std::string decided_rule(const Result& result) {
  const Report& report = result.report;
  if (report.keep == Keep::automatic) return {};
  const bool is_told = std::any_of(result.warnings.begin(), result.warnings.end(),
                                   [](const Warning& w) { return w.kind == WarningKind::orientation; });
  std::string why;
  if (!report.turned_facets.empty() && !is_told)
    why = fmt::format(", as triangles {} and {} leave no winding number", report.turned_facets.front(),
                      report.turned_facets.back());
  return fmt::format(" ({}{})", rule_of(report.keep), why);
}

}  // namespace

std::string counted(std::size_t count, const std::string& one, const std::string& many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

void print_details(const Report& report) {
  say("input      {}, {}, {} in {}, {}\n", counted(report.input.vertices, "vertex", "vertices"),
      counted(report.input.segments, "segment"), counted(report.input.facets, "facet"),
      counted(report.input.components, "component"), report.input.closed ? "closed" : "not closed");
  say("delaunay   missing: {}, {}\n", counted(report.delaunay.segments, "segment"),
      counted(report.delaunay.facets, "facet"));
  say("flips      missing: {}, {}\n", counted(report.flips.segments, "segment"),
      counted(report.flips.facets, "facet"));
  say("partition  {} on segments, {} in facets\n", counted(report.segment_points, "point"),
      counted(report.facet_points, "point"));
  say("regions    {} kept, {}\n", report.regions, rule_of(report.keep));
  say("steiner    {} left by suppression, {} in the end, {} of them without doubles\n",
      counted(report.forced_points, "point"), report.steiner_points, report.unrounded_points);
  if (report.field.points > 0) print_field(report.field);
  say("quality    worst {:.4g}, dihedral angles {:.3g} to {:.3g} degrees\n", report.elements.worst,
      report.elements.min_dihedral_deg, report.elements.max_dihedral_deg);
  say("attempts   {}\n", report.attempts);
  for (const auto& [stage, seconds] : report.seconds) say("seconds    {} {:.3f}\n", stage, seconds);
}

void print_decisions(const Result& result) {
  for (const Warning& warning : result.warnings) say("holdfast: warning: {}\n", warning.message);
  if (result.report.attempts > 1)
    say("holdfast: {} attempts with other random orders were made, for points without doubles\n",
        result.report.attempts);
}

void print_summary(const MeshArguments& arguments, const Options& options, const Result& result,
                   double seconds) {
  say("{}: {} ({} added), {} in {}{}, {:.2f} s{}\n",
      arguments.output.each_region ? "all regions" : arguments.output.path.string(),
      counted(result.volume.vertices.size(), "vertex", "vertices"), result.report.steiner_points,
      counted(result.volume.tetrahedra.size(), "tetrahedron", "tetrahedra"),
      counted(result.report.regions, "region"), options.keep == Keep::automatic ? decided_rule(result) : "",
      seconds, result.report.tetrahedra > 0 ? "; " + quality_of(result, options) : "");
  if (const std::string bounds = bounds_text(options, result.report); !bounds.empty())
    say("bounds: {}\n", bounds);
}

}  // namespace holdfast::cli
