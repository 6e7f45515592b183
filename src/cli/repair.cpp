// `holdfast repair`: makes a valid surface of any surface.
#include "holdfast/repair.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "command.h"
#include "common_options.h"
#include "files.h"
#include "files_of_run.h"
#include "holdfast/surface_io.h"
#include "limits.h"
#include "page.h"
#include "repair_hints.h"
#include "repair_options.h"
#include "repair_result.h"
#include "report.h"
#include "signals.h"
#include "summary.h"
#include "surface_output.h"
#include "unused_vertices.h"

namespace holdfast::cli {
namespace {

struct RepairArguments : SurfaceOutput {
  std::vector<std::filesystem::path> surfaces;
  std::filesystem::path exact, html;
  std::string input_format;
  double tolerance = 0;
  LimitArguments limits;
  double weld = 0, join = 0;
  RepairWays ways;
  unsigned threads = 1;
  bool quiet = false;
};

RepairOptions to_options(const RepairArguments& arguments) {
  RepairOptions options;
  static_cast<Limits&>(options) = limits_of(arguments.limits);
  options.weld = arguments.weld;
  options.join = arguments.join;
  take_repair_ways(arguments.ways, options);
  options.exact = !arguments.exact.empty();
  options.threads = arguments.threads;
  options.progress = goes_on;
  return options;
}

Json options_of(const RepairArguments& arguments) {
  Json inputs = Json::array();
  for (const auto& path : arguments.surfaces) inputs.push_back(path.string());
  return {{"surfaces", inputs},
          {"output", arguments.output.string()},
          {"weld", arguments.weld},
          {"join", arguments.join},
          {"fill_holes", sides_to_json(arguments.ways.fill_holes)},
          {"union", arguments.ways.unite},
          {"tolerance", arguments.tolerance},
          {"threads", arguments.threads},
          {"time_limit", arguments.limits.time_limit.value_or(0)},
          {"memory_limit", arguments.limits.memory_limit.value_or(0)}};
}

/// Reports how the run ended and what the user can do; returns the exit code.
int conclude(const RepairArguments& arguments, const Surface& given, const RepairResult& result) {
  switch (result.outcome) {
    case Outcome::done:
      if (!arguments.quiet) say("{}: {}\n", arguments.output.string(), summary_of(result));
      return exit_done;
    case Outcome::time_limit:
    case Outcome::memory_limit:
    case Outcome::cancelled:
      return tell_limit(result.outcome, result.message);
    case Outcome::not_representable:
      say("holdfast: {}; {} was not written\n", result.message, arguments.output.string());
      say("{}\n", what_may_help(given, to_options(arguments)));
      if (!arguments.exact.empty())
        say("the exact arrangement is in {}\n", arguments.exact.string());
      else if (arguments.join == 0)
        say("--exact FILE writes the exact arrangement\n");
      return exit_not_representable;
    case Outcome::invalid_input:
      break;
  }
  return exit_internal_error;
}

/// Shows the given surface, with its defects, and the repaired one.
void write_html(const RepairArguments& arguments, const Limits& limits, const Surface& before,
                const RepairResult& result, const Json& report) {
  if (arguments.html.empty()) return;
  const bool done = result.outcome == Outcome::done;
  if (!done && result.outcome != Outcome::not_representable) return;
  DiagnoseOptions options;
  static_cast<Limits&>(options) = limits_of_page(limits, result.outcome);
  options.progress = goes_on;
  PageOfRun page(arguments.html, limits_of_page(limits, result.outcome));
  const std::string name = arguments.surfaces.front().filename().string();
  page.set_title(name);
  page.add(name + ", before", before, diagnose(before.view(), options));
  if (done) page.add(arguments.output.filename().string() + ", after", result.surface);
  page.set_verdict(done ? summary_of(result) : result.message, done);
  page.set_report(report);
  page.write();
}

/// Reports a union that drops most triangles, as of a part with a hole, and vertices of the input that are
/// kept although it drops everything on them.
void tell_what_union_leaves(const Surface& before, const RepairResult& result) {
  const Surface& after = result.surface;
  const auto dropped = static_cast<std::size_t>(
      std::count_if(result.dropped.begin(), result.dropped.end(),
                    [](const RepairResult::Dropped& d) { return d.reason == DropReason::inner; }));
  if (after.facets.empty() && !before.facets.empty())
    say("note: no triangle is left, as no connected part of the input encloses anything; `holdfast diagnose` "
        "proposes what closes gaps and holes, without --union\n");
  else if (dropped > before.facets.size() / 2)
    say("note: {} of {} triangles have material on both sides or, as those of an open part, on neither; "
        "`holdfast diagnose` proposes what closes gaps and holes, without --union\n",
        dropped, before.facets.size());
  const std::vector<bool> was = in_use(before), is = in_use(after);
  std::size_t alone = 0;
  for (std::size_t v = 0; v < was.size(); ++v) alone += static_cast<std::size_t>(was[v] && !is[v]);
  if (alone > 0)
    say("note: {} to nothing any more; `mesh --drop-outside` leaves out those that lie outside, and "
        "--drop-unused all\n",
        counted(alone, "vertex belongs", "vertices belong"));
}

/// `result` has what is known if a limit ends the run.
int repair_files(const RepairArguments& arguments, const RepairOptions& options, const WriteOptions& writing,
                 RepairResult& result) {
  const Surface surface =
      read_surfaces(arguments.surfaces, reading(options, arguments.input_format, arguments.tolerance));
  if (!arguments.quiet) {
    tell(surface.remarks);
    if (const std::string told = told_below_last_bit(surface, arguments.weld); !told.empty())
      say("note: {}\n", told);
  }

  result = repair(surface.view(), options);
  result.surface.regions = surface.regions;
  result.surface.holes = surface.holes;
  if (result.outcome == Outcome::done) {
    write_and_tell(arguments, result.surface, writing, arguments.quiet);
    if (!arguments.quiet && options.unite) tell_what_union_leaves(surface, result);
    if (!arguments.quiet && !result.message.empty()) say("note: {}\n", result.message);
    write_parents(arguments.parents, surface.facets.size(), result);
  }
  write_exact(arguments.exact, surface, result);
  if (!arguments.report.empty() || !arguments.html.empty()) {  // the page shows the parents of each triangle
    const Json report = to_json(result, options_of(arguments));
    write_json(arguments.report, report);
    write_html(arguments, options, surface, result, report);
  }
  return conclude(arguments, surface, result);
}

int run(const RepairArguments& arguments) {
  const RepairOptions options = to_options(arguments);
  FilesOfRun files;
  files.read_surfaces(arguments.surfaces, arguments.input_format);
  WriteOptions writing = files.write_surface("-o", arguments.output, arguments.format);
  files.write("--parents", arguments.parents);
  files.write("--report", arguments.report);
  files.write("--exact", arguments.exact);
  files.write("--html", arguments.html);
  cancel_by_flag();
  watch_writing(writing, options);
  RepairResult result;  // until the end
  return work_or_report(
      options, [&] { return repair_files(arguments, options, writing, result); },
      [&](Outcome outcome, const std::string& message) {
        result.outcome = outcome;
        result.message = message;
        write_json(arguments.report, to_json(result, options_of(arguments)));
      });
}

}  // namespace

void add_repair(CLI::App& app, Command& chosen) {
  const auto arguments = std::make_shared<RepairArguments>();
  CLI::App* command = app.add_subcommand(
      "repair",
      "Make a surface valid: triangles are cut where they cross, touch or overlap, and nothing else changes");
  command
      ->add_option("SURFACE", arguments->surfaces,
                   "Surface files, as for `mesh`; several files are numbered one after the other")
      ->transform(or_standard_input)
      ->required();
  add_surface_output(*command, *arguments);
  command
      ->add_option(
          "--weld", arguments->weld,
          "First merge vertices that are this near to each other, put vertices that are this near to a "
          "side or facet on it, and give edges of two bodies that pass each other this near a "
          "common vertex (default 0)")
      ->option_text("T");
  command
      ->add_option("--join", arguments->join,
                   "Triangles that overlap within T of each other, as faces of bodies that touch, become the "
                   "same where they overlap (default 0)")
      ->option_text("T");
  add_repair_ways(*command, arguments->ways);
  add_account(*command, *arguments);
  command
      ->add_option("--exact", arguments->exact,
                   "Write the exact arrangement, its points as quotients, as JSON lines")
      ->transform(or_standard_output)
      ->option_text("FILE");
  add_html_option(*command, arguments->html);
  add_surface_format(*command, *arguments);
  add_tolerance(*command, arguments->tolerance);
  add_input_format(*command, arguments->input_format, "Format of the input");
  add_threads(*command, arguments->threads);
  add_limits(*command, arguments->limits);
  add_quiet(*command, arguments->quiet);
  command->callback([arguments, &chosen] { chosen = [arguments] { return run(*arguments); }; });
}

}  // namespace holdfast::cli
