// `holdfast diagnose`: the defects of a surface, and where they are.
#include <fmt/core.h>

#include <algorithm>
#include <memory>

#include "command.h"
#include "common_options.h"
#include "cures.h"
#include "defects.h"
#include "files.h"
#include "files_of_run.h"
#include "limits.h"
#include "page.h"
#include "report.h"
#include "signals.h"
#include "summary.h"

namespace holdfast::cli {
namespace {

struct DiagnoseArguments {
  std::vector<std::filesystem::path> surfaces;
  std::filesystem::path marks, report, html;
  std::string input_format;
  double tolerance = 0;
  LimitArguments limits;
  unsigned threads = 1;
  bool all = false, json = false, quiet = false;
};

/// What is reported about a surface.
struct Findings {
  std::vector<Defect> defects;
  std::vector<Defect> outside;  ///< of a valid surface: what `mesh` refuses unless told to keep or drop it
  DefectSummary summary;
  Cures cures;
  bool in_time = true;  ///< false: the time limit ended the search for cures, or for what lies outside
};

Json report_of(const Surface& surface, const Report::Input& input, const Findings& found) {
  return {{"valid", found.defects.empty()},
          {"input",
           {{"vertices", input.vertices},
            {"merged_vertices", input.merged_vertices},
            {"left_out_vertices", input.left_out_vertices},
            {"segments", input.segments},
            {"facets", input.facets}}},
          {"version", version()},
          {"summary", to_json(found.summary)},
          {"cures", to_json(found.cures)},
          {"in_time", found.in_time},
          {"remarks", to_json(surface.remarks)},
          {"outside", to_json(found.outside)},
          {"defects", to_json(found.defects)}};
}

constexpr const char* listed_elsewhere = "--all lists them, --report FILE.json, too";

std::string outside_text(const std::vector<Defect>& outside, std::size_t most) {
  std::string text = "`mesh` needs to be told what to do with what lies outside every region:\n";
  for (std::size_t i = 0; i < std::min(most, outside.size()); ++i)
    text += fmt::format("  {}\n", message_of(outside[i]));
  if (outside.size() > most)
    text += fmt::format("  ... and {} more like these; {}\n", outside.size() - most, listed_elsewhere);
  return text;
}

/// The summary, then the list of defects.
std::string listing_of(const Report::Input& counts, const Findings& found, std::size_t most) {
  const auto& [defects, outside, summary, cures, in_time] = found;
  const std::string input = fmt::format("{}, {}, {} in {}", counted(counts.vertices, "vertex", "vertices"),
                                        counted(counts.segments, "segment"), counted(counts.facets, "facet"),
                                        counted(summary.parts, "part"));
  std::string text;
  if (!defects.empty())
    text = fmt::format("not valid: {}; {}\n", input, counted(defects.size(), "defect"));
  else if (summary.enclosed == std::size_t{0})
    text = fmt::format("valid, encloses nothing: needs `--keep box` to be filled; {}\n", input);
  else
    text = fmt::format("valid: {}; encloses {}\n", input, counted(summary.enclosed.value_or(0), "region"));
  text += summary_text(summary) + cures_text(cures);
  if (!in_time)
    text += fmt::format("the time limit ended the search for cures{}\n",
                        defects.empty() ? ", and for what lies outside every region" : "");
  if (!outside.empty()) text += outside_text(outside, most);
  const std::string list = list_text(summary, defects, most, listed_elsewhere);
  return list.empty() ? text : text + "\n" + list;
}

void write_html(const DiagnoseArguments& arguments, const Limits& limits, const Surface& surface,
                const std::vector<Defect>& defects, const Json& report) {
  PageOfRun page(arguments.html, limits);
  const std::string name = arguments.surfaces.front().filename().string();
  page.set_title(name);
  page.add(name, surface, defects);
  page.set_verdict(defects.empty()
                       ? "The surface is valid"
                       : fmt::format("The surface is not valid: {}", counted(defects.size(), "defect")),
                   defects.empty());
  page.set_report(report);
  page.write();
}

RepairOptions trials(const DiagnoseOptions& options) {
  RepairOptions trial;
  static_cast<Limits&>(trial) = options;
  trial.threads = options.threads;
  trial.progress = goes_on;
  return trial;
}

/// Whether some element encloses nothing, and may therefore lie outside every region.
bool has_loose_elements(const Surface& surface, const DefectSummary& summary) {
  if (!surface.segments.empty() || !summary.groups.empty()) return true;
  std::vector<bool> used(surface.vertices.size(), false);
  for (const Triangle& facet : surface.facets)
    for (const Index v : facet) used[v] = true;
  return std::find(used.begin(), used.end(), false) != used.end();
}

/// The defects that `mesh` reports for a valid surface by default; the regions are found in the same way.
std::vector<Defect> find_outside(const Surface& surface, const DefectSummary& summary,
                                 const DiagnoseOptions& options) {
  if (summary.enclosed.value_or(0) == 0 || !has_loose_elements(surface, summary)) return {};
  Options meshing;
  static_cast<Limits&>(meshing) = options;
  meshing.threads = options.threads;
  meshing.stop_after = Stage::classify;
  meshing.progress = [](const Progress& at) { return goes_on(at.fraction); };
  Result result = mesh(surface.view(), meshing);
  if (result.outcome != Outcome::done && result.outcome != Outcome::invalid_input)
    throw Interrupted(result.outcome);
  std::erase_if(result.defects, [](const Defect& d) { return d.kind != DefectKind::outside_region; });
  return std::move(result.defects);
}

/// Trying cures takes many times as long as the diagnosis; the time limit ends only that search.
Findings examine(const Surface& surface, const DiagnoseOptions& options) {
  Findings found;
  found.defects = diagnose(surface.view(), options);
  found.summary = summarise(surface.view(), found.defects);
  try {
    found.cures = propose_cures(surface.view(), found.defects, found.summary, trials(options));
    if (found.defects.empty()) found.outside = find_outside(surface, found.summary, options);
  } catch (const Interrupted& limit) {
    if (limit.outcome() != Outcome::time_limit) throw;
    found.in_time = false;
  }
  return found;
}

int diagnose_files(const DiagnoseArguments& arguments, DiagnoseOptions options,
                   const std::filesystem::path& json, const FilesOfRun& files) {
  const Surface surface =
      read_surfaces(arguments.surfaces, reading(options, arguments.input_format, arguments.tolerance));
  if (!arguments.quiet) tell(surface.remarks);
  const Findings found = examine(surface, options);
  if (!found.in_time) options.time_limit = 0;  // writing is not limited
  const std::vector<Defect>& defects = found.defects;

  if (!arguments.marks.empty()) write_marks(arguments.marks, surface.view(), defects);
  const Report::Input input = count_vertices(surface);
  if (!arguments.quiet) print_merged(input);
  if (!arguments.report.empty() || !json.empty() || !arguments.html.empty()) {  // else not worth its memory
    const Json report = report_of(surface, input, found);
    write_json(arguments.report, report);
    write_json(json, report);
    write_html(arguments, options, surface, defects, report);
  }
  if (!arguments.quiet && !arguments.json) {
    const std::size_t most = files.list_is_on_terminal() ? shown_on_terminal : shown_elsewhere;
    files.list(listing_of(input, found, arguments.all ? SIZE_MAX : most));
  }
  if (defects.empty()) return exit_done;
  say("holdfast: the surface is not valid: {}{}\n", counted(defects.size(), "defect"),
      arguments.marks.empty() ? "; --marks FILE.vtu writes the places for a viewer" : "");
  return exit_invalid_surface;
}

int run(const DiagnoseArguments& arguments) {
  DiagnoseOptions options;
  static_cast<Limits&>(options) = limits_of(arguments.limits);
  options.threads = arguments.threads;
  FilesOfRun files;
  files.read_surfaces(arguments.surfaces, arguments.input_format);
  files.write("--marks", arguments.marks);
  files.write("--report", arguments.report);
  files.write("--html", arguments.html);
  const std::filesystem::path json = arguments.json ? or_standard_output("-") : "";
  files.write("--json", json);
  cancel_by_flag();
  return work_or_write_end(options, [&] { return diagnose_files(arguments, options, json, files); },
                           {arguments.report, json});
}

}  // namespace

void add_diagnose(CLI::App& app, Command& chosen) {
  const auto arguments = std::make_shared<DiagnoseArguments>();
  CLI::App* command = app.add_subcommand(
      "diagnose", "Report the defects of a surface (exit 4), by cause and one by one, and what it encloses");
  command
      ->add_option(
          "SURFACE", arguments->surfaces,
          "Surface files (.stl .off .obj .ply .3mf .amf .gltf .glb .wrl .x3d .dae .ts .gts .dxf .ac .3ds "
          ".gii .mesh "
          ".meshb .poly .smesh .node .msh .vtu .vtp .vtk, each also .gz); several files are numbered one "
          "after "
          "the other; vertices with identical coordinates are one")
      ->transform(or_standard_input)
      ->required();
  command->add_option("--marks", arguments->marks, "Write the places of the defects for a viewer")
      ->transform(or_standard_output)
      ->option_text("FILE.vtu");
  add_report(*command, arguments->report, "Write the defects as JSON");
  add_html_option(*command, arguments->html);
  command->add_flag("--all", arguments->all,
                    "List every defect, not only 1,000 of a kind (100 on a terminal)");
  command->add_flag("--json", arguments->json, "Print the defects as JSON");
  add_tolerance(*command, arguments->tolerance);
  add_input_format(*command, arguments->input_format, "Surface format");
  add_threads(*command, arguments->threads);
  add_limits(*command, arguments->limits);
  command->add_flag("-q,--quiet", arguments->quiet, "Only the exit code and a closing line");
  command->callback([arguments, &chosen] { chosen = [arguments] { return run(*arguments); }; });
}

}  // namespace holdfast::cli
