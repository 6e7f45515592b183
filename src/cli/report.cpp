#include "report.h"

#include <fmt/core.h>

#include <algorithm>

#include "command.h"
#include "defects.h"
#include "holdfast/io.h"

namespace holdfast::cli {

Json to_json(const Defect& defect) {
  return {{"rule", static_cast<int>(defect.kind)},
          {"name", name(defect.kind)},
          {"vertices", defect.vertices},
          {"facets", defect.facets},
          {"segments", defect.segments},
          {"where", defect.where},
          {"message", defect.message}};
}

Json to_json(const std::vector<Defect>& defects) {
  Json list = Json::array();
  for (const Defect& defect : defects) list.push_back(to_json(defect));
  return list;
}

Json to_json(const std::vector<Remark>& remarks) {
  Json list = Json::array();
  for (const Remark& remark : remarks)
    list.push_back(
        {{"kind", static_cast<int>(remark.kind)}, {"count", remark.count}, {"message", remark.message}});
  return list;
}

namespace {

Json to_json(const std::vector<Warning>& warnings) {
  Json list = Json::array();
  for (const Warning& warning : warnings)
    list.push_back({{"kind", static_cast<int>(warning.kind)},
                    {"name", name(warning.kind)},
                    {"facets", warning.facets},
                    {"border", warning.border},
                    {"where", warning.where},
                    {"message", warning.message}});
  return list;
}

Json to_json(const Report::Shape& shape) {
  return {{"min_dihedral_deg", shape.min_dihedral_deg},
          {"max_dihedral_deg", shape.max_dihedral_deg},
          {"least_dihedral_histogram", shape.least_dihedral},
          {"quality_bins", Report::quality_bins},
          {"quality_histogram", shape.quality}};
}

Json to_json(const Report::Field& field) {
  Json forced = Json::array();
  for (const Report::Forced& f : field.worst_forced)
    forced.push_back(
        {{"tetrahedron", f.tetrahedron}, {"min_dihedral_deg", f.min_dihedral_deg}, {"facets", f.facets}});
  return {{"before", to_json(field.before)},
          {"after", to_json(field.after)},
          {"edge_length_histogram", field.edge_lengths},
          {"moves", field.moves},
          {"swaps", field.swaps},
          {"contractions", field.contractions},
          {"insertions", field.insertions},
          {"below_10_deg", field.below_10_deg},
          {"forced", field.forced},
          {"across", field.across},
          {"stopped_early", field.stopped_early},
          {"worst_forced", forced}};
}

}  // namespace

Report::Input count_vertices(const Surface& surface) {
  Report::Input input;
  input.vertices = surface.vertices.size();
  input.segments = surface.segments.size();
  input.facets = surface.facets.size();
  const std::vector<std::int64_t> map = vertex_map(surface.view());
  if (map.empty()) return input;
  input.vertices = static_cast<std::size_t>(*std::max_element(map.begin(), map.end()) + 1);
  input.left_out_vertices = static_cast<std::size_t>(std::count(map.begin(), map.end(), -1));
  input.merged_vertices = map.size() - input.left_out_vertices - input.vertices;
  return input;
}

void print_merged(const Report::Input& input) {
  if (input.merged_vertices + input.left_out_vertices == 0) return;
  const std::size_t all = input.vertices + input.merged_vertices + input.left_out_vertices;
  say("{} vertices at {} places:{}{}{}\n", all, input.vertices,
      input.merged_vertices == 0 ? "" : fmt::format(" {} merged", input.merged_vertices),
      input.merged_vertices > 0 && input.left_out_vertices > 0 ? "," : "",
      input.left_out_vertices == 0
          ? ""
          : fmt::format(" {} unused (repeated or not finite) left out", input.left_out_vertices));
}

Json to_json(const Result& result, Json options) {
  const Report& report = result.report;
  const auto missing = [](const Report::Missing& m) {
    return Json{{"missing_segments", m.segments}, {"missing_facets", m.facets}};
  };
  return {
      {"input",
       {{"vertices", report.input.vertices},
        {"merged_vertices", report.input.merged_vertices},
        {"left_out_vertices", report.input.left_out_vertices},
        {"segments", report.input.segments},
        {"facets", report.input.facets},
        {"components", report.input.components},
        {"closed", report.input.closed},
        {"nonmanifold_segments", report.input.nonmanifold_segments},
        {"dangling_facets", report.input.dangling_facets}}},
      {"delaunay", missing(report.delaunay)},
      {"flips", missing(report.flips)},
      {"partition", {{"segment_points", report.segment_points}, {"facet_points", report.facet_points}}},
      {"steiner",
       {{"count", report.steiner_points},
        {"forced", report.forced_points},
        {"unrounded", report.unrounded_points}}},
      {"field_points", report.field.points},
      {"field", to_json(report.field)},
      {"optimise",
       {{"exchanges", report.optimised.exchanges},
        {"moves", report.optimised.moves},
        {"points", report.optimised.points}}},
      {"mesh",
       {{"vertices", report.vertices}, {"tetrahedra", report.tetrahedra}, {"regions", report.regions}}},
      {"quality",
       {{"target", report.elements.target},
        {"worst", report.elements.worst},
        {"min_dihedral_deg", report.elements.min_dihedral_deg},
        {"max_dihedral_deg", report.elements.max_dihedral_deg},
        {"below_10_deg", report.elements.below_10_deg},
        {"histogram", report.elements.histogram}}},
      {"seconds", report.seconds},
      {"peak_memory_bytes", report.peak_memory_bytes},
      {"version", version()},
      {"options", std::move(options)},
      {"outcome", name(result.outcome)},
      {"attempts", report.attempts},
      {"keep", {{"rule", name(report.keep)}, {"turned_facets", report.turned_facets}}},
      {"message", result.message},
      {"warnings", to_json(result.warnings)},
      {"defects", to_json(result.defects)},
      {"vertex_map", result.vertex_map},
  };
}

void write_json(const std::filesystem::path& path, const Json& json) {
  // Paths on the command line need not be UTF-8, so bytes that are not are replaced.
  if (!path.empty()) write_bytes(path, json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

void print_defects(const std::vector<Defect>& defects, std::size_t most) {
  const std::size_t shown = std::min(most, defects.size());
  for (std::size_t i = 0; i < shown; ++i) say("{}: {}\n", name(defects[i].kind), message_of(defects[i]));
}

}  // namespace holdfast::cli
