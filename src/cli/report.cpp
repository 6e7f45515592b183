#include "report.h"

#include <fmt/core.h>

#include <algorithm>

#include "command.h"
#include "defects.h"
#include "holdfast/io.h"
#include "summary.h"

namespace holdfast::cli {

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
  say("{} at {}:{}{}{}\n", counted(all, "vertex", "vertices"), counted(input.vertices, "place"),
      input.merged_vertices == 0 ? "" : fmt::format(" {} merged", input.merged_vertices),
      input.merged_vertices > 0 && input.left_out_vertices > 0 ? "," : "",
      input.left_out_vertices == 0 ? "" : fmt::format(" {} unused left out", input.left_out_vertices));
}

void write_json(const std::filesystem::path& path, const Json& json) {
  if (!path.empty()) write_bytes(path, reports::text_of(json, 2) + "\n");
}

void print_defects(const std::vector<Defect>& defects, std::size_t most) {
  const std::size_t shown = std::min(most, defects.size());
  for (std::size_t i = 0; i < shown; ++i) say("{}: {}\n", name(defects[i].kind), message_of(defects[i]));
}

}  // namespace holdfast::cli
