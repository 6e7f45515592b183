// `holdfast delaunay`: the Delaunay tetrahedra of points.
#include <fmt/core.h>

#include <chrono>
#include <fstream>
#include <memory>

#include "command.h"
#include "common_options.h"
#include "files_of_run.h"
#include "limits.h"
#include "report.h"
#include "signals.h"
#include "summary.h"

namespace holdfast::cli {
namespace {

struct DelaunayArguments {
  std::filesystem::path points, output, report;
  std::string input_format, format;
  LimitArguments limits;
  std::uint64_t seed = 1;
  unsigned threads = 1;
  bool quiet = false;
};

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

Json options_of(const DelaunayArguments& arguments) {
  return {{"points", arguments.points.string()}, {"seed", arguments.seed}, {"threads", arguments.threads}};
}

/// Peak memory of this program alone, because getrusage would include the process that started it. 0 if
/// unknown.
std::uint64_t peak_memory_bytes() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    if (word != "VmHWM:") continue;
    std::uint64_t kilobytes = 0;
    status >> kilobytes;
    return kilobytes * 1024;
  }
  return 0;
}

int join_points(const DelaunayArguments& arguments, const DelaunayOptions& options,
                const VolumeTarget& target) {
  const auto whole = *options.started;
  Volume volume;
  volume.vertices = read_points(arguments.points, reading(options, arguments.input_format));
  const double reading = seconds_since(whole);

  const auto start = std::chrono::steady_clock::now();
  try {
    volume.tetrahedra = delaunay(volume.vertices, options);
  } catch (const std::invalid_argument& error) {
    say("holdfast: {}: {}\n", arguments.points.string(), error.what());
    return exit_invalid_surface;
  }
  const double seconds = seconds_since(start);
  if (volume.tetrahedra.empty())
    say("holdfast: {}: the points, {}, lie in one plane, so there is no tetrahedron\n",
        arguments.points.string(), volume.vertices.size());

  volume.regions.assign(volume.tetrahedra.size(), 1);
  const auto writing = std::chrono::steady_clock::now();
  write_volume(target.path, volume, target.options);
  write_json(arguments.report,
             {{"input", {{"vertices", volume.vertices.size()}}},
              {"mesh", {{"vertices", volume.vertices.size()}, {"tetrahedra", volume.tetrahedra.size()}}},
              {"seconds",
               {{"read", reading},
                {"delaunay", seconds},
                {"write", seconds_since(writing)},
                {"total", seconds_since(whole)}}},
              {"peak_memory_bytes", peak_memory_bytes()},
              {"version", version()},
              {"options", options_of(arguments)},
              {"outcome", "done"}});
  if (!arguments.quiet)
    say("{}: {}, {}, {:.2f} s ({:.2f} s Delaunay)\n", target.path.string(),
        counted(volume.vertices.size(), "point"),
        counted(volume.tetrahedra.size(), "tetrahedron", "tetrahedra"), seconds_since(whole), seconds);
  return exit_done;
}

int run(const DelaunayArguments& arguments) {
  DelaunayOptions options;
  static_cast<Limits&>(options) = limits_of(arguments.limits);
  options.seed = arguments.seed;
  options.threads = arguments.threads;
  FilesOfRun files;
  files.read_points(arguments.points, arguments.input_format);
  VolumeTarget target = files.write_volume("-o", arguments.output, arguments.format);
  target.options.threads = arguments.threads;
  watch_writing(target.options, options);
  files.write("--report", arguments.report);
  cancel_by_flag();
  return work_or_report(
      options, [&] { return join_points(arguments, options, target); },
      [&](Outcome outcome, const std::string& message) {
        write_json(arguments.report, {{"message", message},
                                      {"version", version()},
                                      {"options", options_of(arguments)},
                                      {"outcome", name(outcome)}});
      });
}

}  // namespace

void add_delaunay(CLI::App& app, Command& chosen) {
  const auto arguments = std::make_shared<DelaunayArguments>();
  CLI::App* command = app.add_subcommand("delaunay", "Delaunay tetrahedra of the convex hull of points");
  command
      ->add_option("POINTS", arguments->points,
                   "Points: .xyz (three numbers per line), .node (TetGen), or the vertices of a surface file")
      ->transform(or_standard_input)
      ->required();
  add_volume_output(*command, arguments->output);
  add_seed(*command, arguments->seed, "Seed of the random order (default 1)");
  add_threads(*command, arguments->threads);
  add_report(*command, arguments->report, "Write counts and times as JSON");
  add_volume_format(*command, arguments->format);
  add_input_format(*command, arguments->input_format, "Format of the points");
  add_limits(*command, arguments->limits);
  add_quiet(*command, arguments->quiet);
  command->callback([arguments, &chosen] { chosen = [arguments] { return run(*arguments); }; });
}

}  // namespace holdfast::cli
