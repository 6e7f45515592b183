// The report of a repair.
#include "holdfast/repair.h"

#include "holdfast/names.h"
#include "repair_check.h"
#include "reports.h"

namespace holdfast::reports {

Json to_json(const RepairResult& result, Json options) {
  const RepairReport& report = result.report;
  Json moved = Json::array(), dropped = Json::array(), merged = Json::array(), filled = Json::array(),
       left_open = Json::array(), parents = Json::array(), segment_parents = Json::array(),
       sets = Json::object();
  for (const auto& [vertex, distance] : result.moved)
    moved.push_back({{"vertex", vertex}, {"distance", distance}});
  for (const auto& [facet, reason] : result.dropped)
    dropped.push_back({{"facet", facet}, {"reason", name(reason)}});
  for (const auto& [facet, into] : result.merged) merged.push_back({{"facet", facet}, {"into", into}});
  for (const auto& [border, facets, is_plane] : result.filled)
    filled.push_back({{"border", border}, {"facets", facets}, {"plane", is_plane}});
  for (const auto& [border, reason] : result.left_open)
    left_open.push_back({{"border", border}, {"reason", name(reason)}});
  const auto list = [](Json& to, const IndexLists& lists) {
    for (std::size_t i = 0; i < lists.size(); ++i)
      to.push_back(Json::array_t(lists[i].begin(), lists[i].end()));
  };
  list(parents, result.parents);
  list(segment_parents, result.segment_parents);
  for (const auto& [marker, set] : result.marker_sets) sets[std::to_string(marker)] = set;
  return {
      {"input", {{"vertices", report.vertices}, {"facets", report.facets}, {"segments", report.segments}}},
      {"pairs", report.pairs},
      {"sheets", report.sheets},
      {"points", report.points},
      {"rounds", report.rounds},
      {"rung", name(report.rung)},
      {"changed_facets", report.changed_facets},
      {"output",
       {{"vertices", result.surface.vertices.size()},
        {"facets", result.surface.facets.size()},
        {"segments", result.surface.segments.size()}}},
      {"max_displacement", result.max_displacement},
      {"moved", std::move(moved)},
      {"dropped", std::move(dropped)},
      {"merged", std::move(merged)},
      {"filled", std::move(filled)},
      {"left_open", std::move(left_open)},
      {"marker_sets", std::move(sets)},
      {"parents", std::move(parents)},
      {"segment_parents", std::move(segment_parents)},
      {"seconds", report.seconds},
      {"peak_memory_bytes", report.peak_memory_bytes},
      {"version", version()},
      {"options", std::move(options)},
      {"outcome", name(result.outcome)},
      {"message", result.message}};
}

Json to_json(const RepairCheckResult& result) {
  Json rules = Json::array();
  for (const RepairRule& rule : result.rules)
    rules.push_back({{"name", name(rule.kind)},
                     {"holds", rule.holds()},
                     {"violations", rule.violations},
                     {"first", rule.first},
                     {"detail", rule.detail}});
  return {{"holds", result.holds()}, {"rules", rules}, {"version", version()}};
}

}  // namespace holdfast::reports
