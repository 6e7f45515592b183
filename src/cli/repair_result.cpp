#include "repair_result.h"

#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>

#include "holdfast/io.h"
#include "holdfast/names.h"
#include "summary.h"
#include "unused_vertices.h"

namespace holdfast::cli {
namespace {

const char* explanation(OpenReason reason) {
  switch (reason) {
    case OpenReason::too_many_sides:
      return "more sides than --fill-holes allows";
    case OpenReason::meets_surface:
      return "a filling would meet the surface";
    case OpenReason::no_filling:
      return "not plane, and more than 600 sides or no area";
  }
  return "";
}

/// The number of holes left open for each reason, with a vertex of the first.
std::string open_holes_of(const RepairResult& result) {
  std::string text;
  for (const OpenReason reason : values_of<OpenReason>()) {
    const auto is_so = [&](const RepairResult::LeftOpen& hole) { return hole.reason == reason; };
    const auto count = std::count_if(result.left_open.begin(), result.left_open.end(), is_so);
    if (count == 0) continue;
    const auto is_seen = [&](const auto& hole) { return is_so(hole) && !hole.border.empty(); };
    const auto seen = std::find_if(result.left_open.begin(), result.left_open.end(), is_seen);
    text += count == 1 ? "; 1 hole stays open" : fmt::format("; {} holes stay open", count);
    if (seen != result.left_open.end()) {
      const Point& p = result.surface.vertices[seen->border.front()];
      text += fmt::format(" ({}{} from ({:.10g}, {:.10g}, {:.10g}))", count == 1 ? "" : "one of ",
                          counted(seen->border.size(), "side"), p[0], p[1], p[2]);
    }
    text += fmt::format(": {}", explanation(reason));
  }
  return text;
}

}  // namespace

std::string summary_of(const RepairResult& result) {
  const RepairReport& report = result.report;
  if (report.rung == Rung::none && report.rounds == 0 && report.changed_facets == 0 && result.moved.empty() &&
      result.filled.empty() && result.dropped.empty())
    return "the surface is valid as it is" + open_holes_of(result);
  std::string text =
      fmt::format("{}, {} ({} cut or joined)", counted(result.surface.vertices.size(), "vertex", "vertices"),
                  counted(result.surface.facets.size(), "triangle"), report.changed_facets);
  const auto tell = [&](std::size_t count, const char* what) {
    if (count > 0) text += fmt::format(", {} {}", count, what);
  };
  tell(result.moved.size(), "moved");
  tell(result.dropped.size(), "dropped");
  tell(result.merged.size(), "merged");
  tell(result.filled.size(), "filled");
  return text +
         fmt::format("; at most {:.3g} from the input, {:.2f} s", result.max_displacement,
                     report.seconds.at("total")) +
         open_holes_of(result);
}

void write_parents(const std::filesystem::path& path, std::size_t input_facets, const RepairResult& result) {
  if (path.empty()) return;
  std::string text = fmt::format("# max_displacement {:.17g}\n", result.max_displacement);
  for (const auto& [vertex, distance] : result.moved)
    text += fmt::format("# moved {} {:.17g}\n", vertex, distance);
  for (const auto& [facet, reason] : result.dropped)
    text += fmt::format("# dropped {} {}\n", facet, name(reason));
  for (const auto& [marker, set] : result.marker_sets)
    text += fmt::format("# marker_set {} {}\n", marker, fmt::join(set, " "));
  for (std::size_t f = 0; f < result.parents.size(); ++f) {
    const auto parents = result.parents[f];
    text += parents.empty() ? "-\n" : fmt::format("{}\n", fmt::join(parents.begin(), parents.end(), " "));
  }
  for (std::size_t s = 0; s < result.segment_parents.size(); ++s) {
    std::vector<std::size_t> parents;
    for (const Index parent : result.segment_parents[s]) parents.push_back(input_facets + parent);
    text += fmt::format("{}\n", fmt::join(parents, " "));
  }
  for (std::size_t v = isolated_vertices(result.surface); v > 0; --v) text += "-\n";
  write_bytes(path, text);
}

void write_exact(const std::filesystem::path& path, const Surface& input, const RepairResult& result) {
  if (path.empty()) return;
  std::string text;
  const auto vertex = [&](std::size_t i, const Json& coordinates) {
    text += Json{{"vertex", i}, {"coordinates", coordinates}}.dump() + "\n";
  };
  const std::size_t before = input.vertices.size();
  for (std::size_t i = 0; i < before; ++i) vertex(i, input.vertices[i]);
  for (std::size_t i = 0; i < result.exact.points.size(); ++i) vertex(before + i, result.exact.points[i]);
  for (std::size_t f = 0; f < result.exact.facets.size(); ++f) {
    Json parents = Json::array();
    for (const Index p : result.exact.parents[f]) parents.push_back(p);
    text += Json{{"facet", result.exact.facets[f]}, {"parents", parents}}.dump() + "\n";
  }
  write_bytes(path, text);
}

}  // namespace holdfast::cli
