// `holdfast untangle`: makes a tangled volume positive and keeps its boundary.
#include "holdfast/untangle.h"

#include <fmt/core.h>

#include <memory>
#include <tuple>

#include "command.h"
#include "common_options.h"
#include "defects.h"
#include "files.h"
#include "files_of_run.h"
#include "limits.h"
#include "mesh_options.h"
#include "page.h"
#include "progress.h"
#include "report.h"
#include "signals.h"
#include "summary.h"
#include "write_options.h"

namespace holdfast::cli {
namespace {

struct UntangleArguments {
  std::filesystem::path input, output, report, html;
  std::string input_format, format;
  bool no_refill = false, improve = false, quiet = false, verbose = false;
  std::uint64_t seed = 1;
  std::optional<double> time_limit, memory_limit;
  WriteArguments writing;
};

UntangleOptions to_options(const UntangleArguments& arguments) {
  UntangleOptions options;
  options.refill = !arguments.no_refill;
  options.improve = arguments.improve;
  options.seed = arguments.seed;
  options.time_limit = time_limit_of(arguments.time_limit);
  options.memory_limit = memory_limit_of(arguments.memory_limit);
  return options;
}

Json report_of(const UntangleArguments& arguments, const UntangleResult& result) {
  return to_json(result, {{"input", arguments.input.string()},
                          {"output", arguments.output.string()},
                          {"refill", !arguments.no_refill},
                          {"improve", arguments.improve},
                          {"seed", arguments.seed},
                          {"time_limit", arguments.time_limit.value_or(0)},
                          {"memory_limit", arguments.memory_limit.value_or(0)}});
}

/// Reports how the run ended and what the user can do; returns the exit code.
int conclude(const UntangleArguments& arguments, const UntangleResult& result) {
  switch (result.outcome) {
    case Outcome::done:
      return exit_done;
    case Outcome::invalid_input:
      say("holdfast: {}; nothing was written\n", result.message);
      print_defects(result.defects, shown_in_passing);
      if (result.defects.size() > shown_in_passing)
        say("... and {} more\n", result.defects.size() - shown_in_passing);
      return exit_invalid_surface;
    case Outcome::time_limit:
    case Outcome::memory_limit:
    case Outcome::cancelled:
      return tell_limit(result.outcome, result.message);
    case Outcome::not_representable:
      say("holdfast: {} ({} negative and {} null tetrahedra are left); {} was not written{}\n",
          result.message, result.report.negative_after, result.report.null_after, arguments.output.string(),
          arguments.no_refill ? "; without --no-refill cavities are filled again" : "");
      return exit_not_representable;
  }
  return exit_internal_error;
}

void print_summary(const UntangleArguments& arguments, const UntangleResult& result) {
  const UntangleReport& report = result.report;
  if (arguments.verbose)
    for (const auto& [step, seconds] : report.seconds) say("seconds    {} {:.3f}\n", step, seconds);
  if (result.outcome != Outcome::done) return;
  say("{}: {} negative and {} null of {} untangled: {} moved, {}, {} "
      "refilled, {} added, {} removed, {:.2f} s\n",
      arguments.output.string(), report.negative, report.null,
      counted(report.tetrahedra, "tetrahedron", "tetrahedra"), counted(report.moved, "vertex", "vertices"),
      counted(report.swapped, "swap"), counted(report.cavities, "cavity", "cavities"),
      counted(report.added, "vertex", "vertices"), report.removed, report.seconds.at("total"));
  if (!arguments.improve) return;
  const auto& [before, after] = std::tie(report.improved.before, report.improved.after);
  say("improved: least dihedral angle {:.4g} to {:.4g} degrees, {} to {} of the elements below 10, mean Q "
      "{:.4g} to "
      "{:.4g}, {} to {}\n",
      before.min_dihedral_deg, after.min_dihedral_deg, before.below_10_deg, after.below_10_deg,
      before.mean_quality, after.mean_quality, before.tetrahedra,
      counted(after.tetrahedra, "tetrahedron", "tetrahedra"));
}

/// Shows the untangled volume and the given one.
void write_html(const UntangleArguments& arguments, const Limits& limits, const Volume& before,
                const UntangleResult& result, const Json& report) {
  const bool done = result.outcome == Outcome::done;
  if (!done && result.outcome != Outcome::not_representable && result.outcome != Outcome::invalid_input)
    return;
  PageOfRun page(arguments.html, limits_of_page(limits, result.outcome));
  const std::string name = arguments.input.filename().string();
  page.set_title(name);
  if (done) page.add(arguments.output.filename().string() + ", after", result.volume);
  page.add(name + ", before", before);
  page.set_verdict(
      done ? fmt::format("{} negative and {} null of {} untangled", result.report.negative,
                         result.report.null, counted(result.report.tetrahedra, "tetrahedron", "tetrahedra"))
           : result.message,
      done);
  page.set_report(report);
  page.write();
}

/// `result` has what is known if a limit ends the run.
int untangle_file(const UntangleArguments& arguments, UntangleOptions options, const VolumeTarget& target,
                  UntangleResult& result) {
  std::vector<Remark> remarks;
  const Volume volume = read_volume(arguments.input, reading(options, arguments.input_format), &remarks);
  if (!arguments.quiet) tell(remarks, arguments.input);
  const std::chrono::duration<double> reading = std::chrono::steady_clock::now() - *options.started;
  ProgressView progress(how_to_show(arguments.quiet, arguments.verbose));
  options.progress = std::ref(progress);
  result = untangle(volume, options);
  progress.finish();

  if (result.outcome == Outcome::done) {
    write_volume(target.path, result.volume, target.options);
    if (!arguments.quiet) tell(not_held(target.path, result.volume, target.options), target.path);
  }
  const std::chrono::duration<double> total = std::chrono::steady_clock::now() - *options.started;
  result.report.seconds["read"] = reading.count();
  result.report.seconds["total"] = total.count();
  const Json report = report_of(arguments, result);
  write_json(arguments.report, report);
  write_html(arguments, options, volume, result, report);
  if (!arguments.quiet) print_summary(arguments, result);
  return conclude(arguments, result);
}

int run(const UntangleArguments& arguments) {
  const auto start = std::chrono::steady_clock::now();
  UntangleOptions options = to_options(arguments);
  options.started = start;  // the limit covers the whole command
  FilesOfRun files;
  files.read_volume(arguments.input, arguments.input_format);
  VolumeTarget target = files.write_volume("-o", arguments.output, arguments.format);
  apply(arguments.writing, target);
  watch_writing(target.options, options);
  files.write("--report", arguments.report);
  files.write("--html", arguments.html);
  cancel_by_flag();

  UntangleResult result;  // until the end
  return work_or_report(
      options, [&] { return untangle_file(arguments, options, target, result); },
      [&](Outcome outcome, const std::string& message) {
        result.outcome = outcome;
        result.message = message;
        write_json(arguments.report, report_of(arguments, result));
      });
}

}  // namespace

void add_untangle(CLI::App& app, Command& chosen) {
  const auto arguments = std::make_shared<UntangleArguments>();
  CLI::App* command = app.add_subcommand(
      "untangle", "Make every tetrahedron of a tangled volume positive and keep its boundary");
  command
      ->add_option(
          "VOLUME", arguments->input,
          "Tangled volume file (.vtu .pvtu .pvd .vtm .vtk .mesh .meshb .msh .inp .unv .bdf .su2 .mfem .vol "
          ".xdmf .med .exo .cgns .fluent .k .cdb .feb .xml .case .cas .avs .node, "
          "or OpenFOAM's constant/polyMesh)")
      ->transform(or_standard_input)
      ->required();
  add_volume_output(*command, arguments->output);
  CLI::Option* no_refill =
      command->add_flag("--no-refill", arguments->no_refill,
                        "Only move vertices and swap tetrahedra: neither add nor remove vertices");
  command
      ->add_flag("--improve", arguments->improve,
                 "Then improve elements and keep the boundary; adds and removes inner vertices")
      ->excludes(no_refill);
  add_seed(*command, arguments->seed);
  command->add_option("--time-limit", arguments->time_limit, "Give up after this many seconds (exit 5)")
      ->option_text("S");
  command->add_option("--memory-limit", arguments->memory_limit, "Give up above this much memory (exit 5)")
      ->option_text("GB");
  add_report(*command, arguments->report, "Write counts and times as JSON");
  add_html_option(*command, arguments->html);
  add_volume_format(*command, arguments->format);
  add_write_options(*command, arguments->writing);
  add_input_format(*command, arguments->input_format, "Format of the tangled volume");
  CLI::Option* quiet = add_quiet(*command, arguments->quiet);
  command->add_flag("-v,--verbose", arguments->verbose, "Report every step")->excludes(quiet);
  command->callback([arguments, &chosen] { chosen = [arguments] { return run(*arguments); }; });
}

}  // namespace holdfast::cli
