// `holdfast info`: the contents of a file.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "any_mesh.h"
#include "command.h"
#include "common_options.h"
#include "files.h"
#include "files_of_run.h"
#include "holdfast/statistics.h"
#include "limits.h"
#include "report.h"
#include "signals.h"
#include "summary.h"

namespace holdfast::cli {
namespace {

struct InfoArguments {
  std::filesystem::path file, report;
  std::string format;
  LimitArguments limits;
  double tolerance = 0;
  bool json = false, quiet = false;
};

/// A name safe to print: without control bytes that a terminal would obey.
std::string shown(const std::string& name) {
  std::string text = name;
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c == 0x7f; }, '?');
  return text;
}

std::string table_of(const std::string& title, const std::vector<Statistics::Group>& groups, const char* what,
                     const char* measure, const char* area) {
  const bool only_unnamed = groups.size() == 1 && groups[0].id == 0 && groups[0].name.empty();
  if (groups.empty() || (only_unnamed && area[0] == 0)) return {};
  std::string text = fmt::format("{:<18}{:>10} {:>12}", title, "id", what);
  if (measure[0] != 0) text += fmt::format(" {:>14}", measure);
  if (area[0] != 0) text += fmt::format(" {:>14}", area);
  text += "  name\n";
  for (const Statistics::Group& group : groups) {
    text += fmt::format("{:<18}{:>10} {:>12}", "", group.id, group.count);
    if (measure[0] != 0) text += fmt::format(" {:>14.8g}", group.measure);
    if (area[0] != 0) text += fmt::format(" {:>14.8g}", group.area);
    text += "  " + shown(group.name);
    while (text.back() == ' ') text.pop_back();
    text += '\n';
  }
  return text;
}

/// One line per bin, with a bar of at most 40 characters.
std::string histogram_of(const Statistics& s) {
  constexpr std::size_t longest = 40;
  const std::size_t most = *std::max_element(s.least_dihedral.begin(), s.least_dihedral.end());
  std::string text = fmt::format("{:<18}tetrahedra by their least dihedral angle\n", "quality");
  for (std::size_t bin = 0; bin < s.least_dihedral.size(); ++bin) {
    const std::size_t count = s.least_dihedral[bin];
    // Rounded up, so that every nonempty bin shows.
    const std::size_t bar = most == 0 ? 0 : (count * longest + most - 1) / most;
    std::string line =
        fmt::format("{:<10}{:>2} - {:>2} {:>12}  {}", "", 5 * bin, 5 * bin + 5, count, std::string(bar, '#'));
    while (line.back() == ' ') line.pop_back();
    text += line + '\n';
  }
  return text + fmt::format("{:<18}dihedral angles {:.4g} to {:.4g} degrees, worst Q {:.4g}\n", "",
                            s.min_dihedral_deg, s.max_dihedral_deg, s.worst_quality);
}

std::string text_of(const std::filesystem::path& file, bool is_volume, const Statistics& s) {
  std::string text = fmt::format("{:<17} {} of {} order\n", file.string(), is_volume ? "volume" : "surface",
                                 s.mid_nodes > 0 ? "second" : "first");
  const auto line = [&](const char* title, const std::string& values) {
    text += fmt::format("{:<18}{}\n", title, values);
  };
  line("vertices", fmt::format("{}{}", s.vertices,
                               s.unused_vertices > 0 ? fmt::format(" ({} unused)", s.unused_vertices) : ""));
  if (s.mid_nodes > 0)
    line("mid-edge nodes",
         fmt::format("{}; sizes and shapes below are those of the straight elements", s.mid_nodes));
  if (is_volume) line("tetrahedra", fmt::format("{}", s.tetrahedra));
  line("triangles", fmt::format("{}", s.facets));
  line("segments", fmt::format("{}", s.segments));
  line("edges", fmt::format("{}, of length {:.6g} to {:.6g}, mean {:.6g}", s.edges, s.shortest_edge,
                            s.longest_edge, s.mean_edge));
  line("box", fmt::format("({:g}, {:g}, {:g}) to ({:g}, {:g}, {:g})", s.low[0], s.low[1], s.low[2], s.high[0],
                          s.high[1], s.high[2]));
  line("area", is_volume
                   ? fmt::format("{:.10g} of triangles, {:.10g} of the boundary", s.area, s.boundary_area)
                   : fmt::format("{:.10g}", s.area));
  if (is_volume || s.closed)
    line("volume", fmt::format("{:.10g}{}", s.volume, is_volume ? "" : ", bounded by the triangles"));
  if (!is_volume && !s.closed) line("volume", "none: not closed, or not consistently oriented");
  if (s.negative + s.null > 0)
    line("not positive", fmt::format("{} of negative volume, {} of none",
                                     counted(s.negative, "tetrahedron", "tetrahedra"), s.null));
  if (is_volume)
    text += table_of("regions", s.regions, "tetrahedra", "volume", "area");
  else
    text += table_of("region seeds", s.regions, "", "", "");
  text += table_of("markers", s.facet_markers, "triangles", "area", "");
  text += table_of("segment markers", s.segment_markers, "segments", "length", "");
  text += table_of("vertex markers", s.vertex_markers, "vertices", "", "");
  if (is_volume) text += histogram_of(s);
  return text;
}

int tell_of_file(const InfoArguments& arguments, const Limits& limits, const std::filesystem::path& json,
                 const FilesOfRun& files) {
  const AnyMesh mesh = read_any(arguments.file, reading(limits, arguments.format, arguments.tolerance));
  if (!arguments.quiet) tell(mesh.remarks);
  const Statistics counts =
      mesh.is_volume ? statistics(mesh.volume, limits) : statistics(mesh.surface, limits);
  Json report{{"file", arguments.file.string()}, {"kind", mesh.is_volume ? "volume" : "surface"}};
  report.update(to_json(counts));
  report["remarks"] = to_json(mesh.remarks);
  write_json(arguments.report, report);
  write_json(json, report);
  if (!arguments.json) files.list(text_of(arguments.file, mesh.is_volume, counts));
  return exit_done;
}

int run(const InfoArguments& arguments) {
  const Limits limits = limits_of(arguments.limits);
  FilesOfRun files;
  read_any(files, arguments.file, arguments.format);
  files.write("--report", arguments.report);
  const std::filesystem::path json = arguments.json ? or_standard_output("-") : "";
  files.write("--json", json);
  cancel_by_flag();
  return work_or_write_end(limits, [&] { return tell_of_file(arguments, limits, json, files); },
                           {arguments.report, json});
}

}  // namespace

void add_info(CLI::App& app, Command& chosen) {
  const auto arguments = std::make_shared<InfoArguments>();
  CLI::App* command = app.add_subcommand(
      "info", "Report the contents of a surface or volume file: counts, regions, markers, sizes, shapes");
  command->add_option("FILE", arguments->file, "Surface or volume file, -: standard input")
      ->transform(or_standard_input)
      ->required();
  command->add_flag("--json", arguments->json, "Write it to standard output as JSON");
  add_report(*command, arguments->report, "Write it as JSON to a file");
  command->add_option("--input-format,--format", arguments->format, "Format, instead of by ending")
      ->option_text("FORMAT");
  add_tolerance(*command, arguments->tolerance);
  add_limits(*command, arguments->limits);
  command->add_flag("-q,--quiet", arguments->quiet, "Do not report what the reader left out");
  command->callback([arguments, &chosen] { chosen = [arguments] { return run(*arguments); }; });
}

}  // namespace holdfast::cli
