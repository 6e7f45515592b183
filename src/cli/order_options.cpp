#include "order_options.h"

#include <fmt/core.h>

#include <cmath>

#include "command.h"
#include "holdfast/second_order.h"
#include "limits.h"
#include "summary.h"

namespace holdfast::cli {

void add_curved(CLI::App& command, OrderArguments& arguments) {
  command
      .add_option(
          "--curved", arguments.curved,
          "With --order 2: put the nodes on edges of triangles on this smooth surface, given by finer "
          "triangles, where every element stays positive")
      ->option_text("SURFACE");
  command
      .add_option("--curved-tolerance", arguments.tolerance,
                  "How far --curved moves a node at most (default: a tenth of its edge)")
      ->option_text("D");
}

void add_order(CLI::App& command, OrderArguments& arguments) {
  command
      .add_option("--order", arguments.order,
                  "Order of the elements: 1, without mid-edge nodes, or 2 (default: as it is)")
      ->option_text("1|2");
  add_curved(command, arguments);
}

void take_order(const OrderArguments& arguments, FilesOfRun& files) {
  if (arguments.order && arguments.order != 1 && arguments.order != 2)
    throw UsageError("--order: 1 or 2 is expected");
  if (!arguments.curved.empty() && arguments.order != 2)
    throw UsageError("--curved does nothing without --order 2: it is for mid-edge nodes");
  if (arguments.tolerance && arguments.curved.empty())
    throw UsageError("--curved-tolerance does nothing without --curved");
  if (arguments.tolerance && !(*arguments.tolerance > 0 && std::isfinite(*arguments.tolerance)))
    throw UsageError(
        fmt::format("--curved-tolerance {}: a positive and finite length is expected", *arguments.tolerance));
  if (!arguments.curved.empty()) files.read_surfaces({arguments.curved}, {});
}

std::optional<Surface> read_curved(const OrderArguments& arguments, const Limits& limits) {
  if (arguments.curved.empty()) return {};
  return read_surface(arguments.curved, reading(limits, {}));
}

std::size_t tell_not_positive(const Volume& volume, const Limits& limits, bool quiet) {
  const std::vector<Index> elements = not_positive_elements(volume, limits);
  if (quiet || elements.empty()) return elements.size();
  const Point& at = volume.vertices[volume.tetrahedra[elements[0]][0]];
  const bool is_one = elements.size() == 1;
  say("holdfast: warning: {} not positive everywhere with nodes in the middle of edges, since {} flat to the "
      "last bits, or inverted; first tetrahedron {} at ({:.10g}, {:.10g}, {:.10g}). Most solvers refuse {}: "
      "use --order 1, or repair what is so thin\n",
      counted(elements.size(), "element is", "elements are"), is_one ? "it is" : "they are", elements[0],
      at[0], at[1], at[2], is_one ? "it" : "them");
  return elements.size();
}

Json set_order(Volume& volume, const OrderArguments& arguments, const std::optional<Surface>& smooth,
               const Limits& limits, bool quiet) {
  if (arguments.order != 2) {
    if (arguments.order == 1) volume.mid_nodes = {};
    return {{"order", volume.mid_nodes.empty() ? 1 : 2}};
  }
  if (!smooth) {
    // Nodes from a file are kept.
    if (volume.mid_nodes.empty()) add_mid_nodes(volume, limits);
    const std::size_t not_positive = tell_not_positive(volume, limits, quiet);
    return {{"order", 2}, {"nodes", volume.mid_nodes.points.size()}, {"not_positive", not_positive}};
  }
  CurveOptions options;
  static_cast<Limits&>(options) = limits;
  options.tolerance = arguments.tolerance.value_or(0);
  add_mid_nodes(volume, limits);
  const CurveReport report = curve_mid_nodes(volume, smooth->view(), options);
  if (!quiet) {
    say("holdfast: {} of {} on triangles are on {}, moved by {:.4g} at most\n", report.moved,
        counted(report.on_facets, "node"), arguments.curved.string(), report.farthest);
    if (report.beyond > 0)
      say("holdfast: {} farther from it than allowed, and straight\n",
          counted(report.beyond, "node is", "nodes are"));
    if (report.straightened > 0)
      say("holdfast: {} straight, or an element would not be positive everywhere\n",
          counted(report.straightened, "node stays", "nodes stay"));
  }
  if (report.not_positive > 0) tell_not_positive(volume, limits, quiet);
  return {{"order", 2},
          {"nodes", volume.mid_nodes.points.size()},
          {"on_triangles", report.on_facets},
          {"moved", report.moved},
          {"beyond_tolerance", report.beyond},
          {"straightened", report.straightened},
          {"not_positive", report.not_positive},
          {"farthest", report.farthest}};
}

}  // namespace holdfast::cli
